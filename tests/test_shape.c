/* Edits of shapes: what a corner, an edge or the whole is told, and what follows it: marks, seams,
 * the other half of a symmetric piece, evenly sewn edges. Then rows of edits at random. */
#include "edits.h"
#include "scene.h"
#include "test.h"

enum { ROWS = 60, ROW_EDITS = 40 };

static struct scene *scene;
static struct session *session;

static const struct piece *piece_at(int piece)
{
	return &session->document.pattern.piece[piece];
}

static const struct seam *seam_at(int seam)
{
	return &session->document.pattern.seam[seam];
}

static bool say(const char *line)
{
	return scene_line(scene, line);
}

/* Two boxes of 400 x 600 side by side, the right one's left edge sewn to the left one's right. */
static void begin(void)
{
	memset(&session->document, 0, sizeof session->document);
	CHECK(say("piece left 0 0 0 0 0 -200 -300 1 200 -300 1 200 300 1 -200 300 1"));
	CHECK(say("piece right 0 0 500 0 0 -200 -300 1 200 -300 1 200 300 1 -200 300 1"));
	CHECK(say("mark-cloth 1 0 0 100 0 -100"));
	CHECK(say("sew 0 1 1 3 0"));
}

static float length(int piece, int edge)
{
	return piece_edge_length_mm(piece_at(piece), edge);
}

static bool corner_is(int piece, int corner, float x, float y)
{
	struct v2 at = piece_corner_mm(piece_at(piece), corner);
	return v2_distance(at, (struct v2){x, y}) < 0.02f;
}

static void test_scale(void)
{
	begin();
	CHECK(say("scale 0 0.5 1.5 -200 -300"));
	CHECK(corner_is(0, 0, -200, -300) && corner_is(0, 2, 0, 600));
	CHECK_NEAR(session->document.marks.cloth[0].point_mm[0].x, -100, 0.01);
	CHECK_NEAR(session->document.marks.cloth[0].point_mm[0].y, 300, 0.01);
	CHECK(seam_at(0)->used && seam_at(0)->a.edge == 1);
	uint64_t before = session_hash(session);
	CHECK(!say("scale 0 0.01 1 0 0") && !say("scale 7 1 1 0 0"));
	CHECK(!say("scale 0 19 19 0 -5000")); /* leaves the sheet */
	CHECK(session_hash(session) == before);
}

static void test_corners(void)
{
	begin();
	CHECK(say("point 0 2 260 340"));
	CHECK(corner_is(0, 2, 260, 340) && corner_is(0, 1, 200, -300) &&
	      corner_is(0, 3, -200, 300));
	CHECK(piece_at(0)->point_count == 4); /* straight edges stay straight */
	uint64_t before = session_hash(session);
	CHECK(!say("point 0 2 -400 -700")); /* would cross itself */
	CHECK(!say("point 0 4 0 0") && !say("point 0 -1 0 0"));
	CHECK(session_hash(session) == before);
}

static void test_bends(void)
{
	begin();
	CHECK(say("bend 0 2 0 380"));
	struct v2 middle = piece_edge_point(piece_at(0), 2, 0.5f);
	CHECK_NEAR(middle.x, 0, 1);
	CHECK_NEAR(middle.y, 380, 1);
	CHECK(piece_edge_count(piece_at(0)) == 4 && piece_at(0)->point_count > 10);
	CHECK(corner_is(0, 2, 200, 300) && corner_is(0, 3, -200, 300));
	/* Its corner takes the curve along. */
	CHECK(say("point 0 3 -200 400"));
	middle = piece_edge_point(piece_at(0), 2, 0.5f);
	CHECK(middle.y > 400 && middle.y < 460);
	CHECK(say("bend 0 2 0 350.4"));
	CHECK(piece_at(0)->point_count == 4); /* straight again */
}

static void test_splits(void)
{
	begin();
	CHECK(say("split 0 1 0.25"));
	CHECK(piece_edge_count(piece_at(0)) == 5 && piece_edge_count(piece_at(1)) == 5);
	CHECK(corner_is(0, 2, 200, -150) && corner_is(1, 4, -200, -150));
	CHECK(seam_at(0)->used && seam_at(1)->used);
	for (int s = 0; s < 2; s++)
		CHECK_NEAR(length(0, seam_at(s)->a.edge), length(1, seam_at(s)->b.edge), 0.01);
	CHECK(!say("split 0 1 0.001"));
	/* And back: both corners go, one seam is left. */
	CHECK(say("join 0 2"));
	CHECK(piece_edge_count(piece_at(0)) == 4 && piece_edge_count(piece_at(1)) == 4);
	CHECK(seam_at(0)->used + seam_at(1)->used == 1);
	const struct seam *seam = seam_at(seam_at(0)->used ? 0 : 1);
	CHECK_NEAR(length(0, seam->a.edge), 600, 0.01);
	CHECK_NEAR(length(1, seam->b.edge), 600, 0.01);
	/* Corner 0, whose place in the count others take. */
	CHECK(say("join 0 0") && piece_edge_count(piece_at(0)) == 3);
	CHECK(seam->used && seam->a.edge == 0);
	CHECK(corner_is(0, 0, 200, -300));
	CHECK(!say("join 0 0")); /* nothing would be left */
	begin();
	CHECK(say("split 0 0 0.5") && seam_at(0)->a.edge == 2 && !seam_at(1)->used);
	CHECK(say("join 0 1") && seam_at(0)->a.edge == 1);
}

static void test_fold(void)
{
	begin();
	CHECK(say("bend 0 2 40 240"));
	CHECK(say("point 0 2 260 340"));
	CHECK(say("fold 0 1 0 0 1.5707963"));
	const struct piece *piece = piece_at(0);
	CHECK(piece->symmetric && piece_edge_count(piece) == 4);
	for (int k = 0; k < 4; k++)
		CHECK(piece_other_corner(piece, k) >= 0 && piece_other_corner(piece, k) != k);
	CHECK(seam_at(0)->used);
	int corner = 0;
	while (corner < 3 && piece_corner_mm(piece, corner).y > -200.0f)
		corner++;
	int other = piece_other_corner(piece, corner);
	struct v2 to = piece_corner_mm(piece, corner);
	to.x *= 1.2f;
	to.y -= 50.0f;
	char line[80];
	snprintf(line, sizeof line, "point 0 %d %g %g", corner, (double)to.x, (double)to.y);
	CHECK(say(line) && corner_is(0, other, -to.x, to.y));
	/* An edge across the axis bends about it. */
	int edge = 0;
	while (edge < 3 && piece_other_edge(piece, edge) != edge)
		edge++;
	snprintf(line, sizeof line, "bend 0 %d 90 %g", edge,
		 (double)piece_edge_point(piece, edge, 0.5f).y + 60.0);
	CHECK(say(line));
	CHECK_NEAR(piece_edge_point(piece, edge, 0.5f).x, 0, 0.5);
	int edges = piece_edge_count(piece);
	edge = 0;
	while (piece_other_edge(piece, edge) == edge)
		edge++;
	snprintf(line, sizeof line, "split 0 %d 0.3", edge);
	CHECK(say(line) && piece_edge_count(piece) == edges + 2);
	/* Where the outline crosses the axis without a corner it crosses it squarely. */
	for (int i = 0; i < piece->point_count; i++) {
		struct v2 a = piece->point_mm[i];
		struct v2 b = piece->point_mm[(i + 1) % piece->point_count];
		if (a.x * b.x <= 0.0f && !piece->corner[i] &&
		    !piece->corner[(i + 1) % piece->point_count])
			CHECK(float_abs(a.y - b.y) < 0.06f * float_abs(a.x - b.x));
	}
	CHECK(say("fold 0 0 0 0 0") && !piece->symmetric);
	CHECK(!say("fold 0 1 900 0 1.5707963"));
}

static void test_even(void)
{
	begin();
	CHECK(say("even 0 1"));
	CHECK(say("point 0 1 200 -360")); /* the hem of the left one goes down */
	CHECK_NEAR(length(0, 1), 660, 0.05);
	CHECK_NEAR(length(1, 3), 660, 0.05);
	CHECK(corner_is(1, 3, -200, 300)); /* the shoulder stays */
	CHECK(corner_is(1, 0, -200, -360));
	CHECK(say("even 0 0") && say("point 0 1 200 -300"));
	CHECK_NEAR(length(1, 3), 660, 0.05);
	CHECK(say("even 0 1"));
	CHECK_NEAR(length(0, 1), length(1, 3), 0.05);
}

static void test_rows(void)
{
	struct scatter scatter = {4711};
	int taken = 0;
	for (int row = 0; row < ROWS; row++) {
		begin();
		for (int k = 0; k < ROW_EDITS; k++) {
			uint8_t byte[8];
			for (int i = 0; i < 8; i++)
				byte[i] = (uint8_t)scatter_below(&scatter, 256);
			struct edit edit = edit_of_bytes(byte);
			uint64_t before = session_hash(session);
			bool done = session_apply(session, &edit);
			taken += done;
			CHECK(done || session_hash(session) == before);
			CHECK(document_is_sound(&session->document));
		}
	}
	CHECK(taken > ROWS * ROW_EDITS / 5);
}

int main(void)
{
	scene = scene_open_empty();
	session = &scene->session;
	test_scale();
	test_corners();
	test_bends();
	test_splits();
	test_fold();
	test_even();
	test_rows();
	scene_close(scene);
	return test_end();
}
