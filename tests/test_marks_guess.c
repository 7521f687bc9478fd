/* Marks guessed from what a garment's file says of its pieces and from its seams. */
#include "format_garment.h"
#include "format_marks.h"
#include "format_marks_guess.h"
#include "test.h"

static struct pattern pattern;
static char out[GUESS_BYTES_MAX];
static char fault[200];

static int guess(const char *text)
{
	CHECK(format_garment_read(&pattern, text, strlen(text), fault));
	int size = format_marks_guess(out, &pattern, text, strlen(text));
	CHECK(size == (int)strlen(out));
	static struct design_marks marks;
	static struct garment_places places;
	CHECK(size == 0 || format_marks_read(&marks, &pattern, &places, out, (size_t)size, fault));
	return size;
}

#define FILE_OF(instances, seams)                                                                  \
	"{\"format\":\"garment-seams/1\",\"units\":\"mm\",\"instances\":[" instances               \
	"],\"seams\":[" seams "]}"
#define SEAM(id, a, a0, a1, ad, b, b0, b1, bd)                                                     \
	"{\"id\":\"" id "\",\"kind\":\"plain\",\"a\":{\"instance\":\"" a "\",\"start\":" a0        \
	",\"end\":" a1 ",\"dir\":" ad "},\"b\":{\"instance\":\"" b "\",\"start\":" b0              \
	",\"end\":" b1 ",\"dir\":" bd "}}"

/* A vest: a neck 100 mm wide and 90 deep, shoulders of 100 mm, sides below the arms. */
#define VEST                                                                                       \
	"\"outline\":[[-200,600],[200,600],[200,250],[150,20],[50,0],[0,90],[-50,0],[-150,20],"    \
	"[-200,250]]"

static void test_top(void)
{
	CHECK(guess(FILE_OF("{\"id\":\"front\",\"wear\":\"front; right is left\"," VEST "},"
			    "{\"id\":\"rear\",\"wear\":\"back\"," VEST "},"
			    "{\"id\":\"sleeve.L\",\"outline\":[[-100,300],[100,300],[120,50],[0,0],"
			    "[-120,50]]}",
			    SEAM("s", "front", "3", "4", "1", "rear", "7", "6", "-1"))) > 0);
	/* pit and nape: 0.26 and 0.08 of the way to the shoulder point below its inner end */
	CHECK(strstr(out, "front @0.00,-39.00 @0.00,-600.00 on front-centre\n"));
	CHECK(strstr(out, "rear @0.00,-12.00 @0.00,-600.00 on back-centre\n"));
	CHECK(strstr(out, "sleeve.L @0.00,0.00 @0.00,-300.00 on arm-left-top\n"));
}

/* A front in two pieces, one below the other: the mark goes on in the lower one. */
static void test_chain(void)
{
	CHECK(guess(FILE_OF("{\"id\":\"front\"," VEST "},{\"id\":\"back\"," VEST "},"
			    "{\"id\":\"front "
			    "lower\",\"outline\":[[-200,0],[-200,300],[200,300],[200,0]]}",
			    SEAM("s", "front", "3", "4", "1", "back", "7", "6", "-1") "," SEAM(
				    "w", "front", "0", "1", "1", "front lower", "0", "3", "-1"))) >
	      0);
	CHECK(strstr(out, "-600.00 + front_lower @0.00,-0.00 @0.00,-300.00 on front-centre\n") ||
	      strstr(out, "-600.00 + front_lower @0.00,0.00 @0.00,-300.00 on front-centre\n"));
}

/* Nothing high up joins front and back: a skirt, which hangs from its waistband's upper edge. */
static void test_skirt(void)
{
	CHECK(guess(FILE_OF(
		      "{\"id\":\"front\",\"outline\":[[-200,0],[-200,600],[200,600],[200,0]]},"
		      "{\"id\":\"back\",\"outline\":[[-200,0],[-200,600],[200,600],[200,0]]},"
		      "{\"id\":\"waistband\",\"outline\":[[-200,0],[-200,60],[200,60],[200,0]]}",
		      SEAM("s", "front", "2", "3", "1", "back", "1", "0", "-1") "," SEAM(
			      "w", "front", "3", "0", "1", "waistband", "2", "1", "-1"))) > 0);
	CHECK(strstr(out, "waistband @0.00,-60.00:up @0.00,-60.00 + front @0.00,0.00 @0.00,-600.00 "
			  "on front-centre 1 1.7\n"));
	CHECK(strstr(out, "front @200.00,0.00 .. @200.00,-600.00 on side-left 1 2\n"));
	CHECK(strstr(out, "back @0.00,0.00 @0.00,-600.00 on back-centre 1 1.7\n"));
}

static void test_nothing(void)
{
	CHECK(guess(FILE_OF("{\"id\":\"rag\",\"outline\":[[0,0],[0,100],[100,100],[100,0]]}",
			    "")) == 0);
	CHECK(guess(FILE_OF(
		      "{\"id\":\"collar front\",\"outline\":[[0,0],[0,100],[100,100],[100,0]]}",
		      "")) == 0);
	CHECK(format_marks_guess(out, &pattern, "{", 1) == 0);
}

int main(void)
{
	test_top();
	test_chain();
	test_skirt();
	test_nothing();
	return test_end();
}
