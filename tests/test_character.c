/* Real bodies and nasty files through the whole way in: read, mend, build. What must not be
 * accepted is tested like what must. */
#include "character.h"
#include "test.h"

#include <sys/stat.h>

static const char bodies[] = "../shared/data/bodies";
static const char nasty[] = "../shared/data/bad/obj";

enum verdict {
	REFUSED,
	TAKEN,    /* with nothing to say about it, or only about its limbs */
	MENDED,   /* the note says how */
	NO_CRASH, /* either is right */
};

struct character_case {
	const char *name;
	enum verdict verdict;
	const char *words; /* in the fault or in the note */
};

static const struct character_case nasty_cases[] = {
	{"empty", REFUSED, "empty"},
	{"only_comments", REFUSED, "0 vertices"},
	{"only_vertices", REFUSED, "0 triangles"},
	{"truncated_mid_number", REFUSED, "line"},
	{"truncated_mid_face", REFUSED, NULL},
	{"index_out_of_range", REFUSED, "line"},
	{"index_zero", REFUSED, "line"},
	{"index_int_overflow", REFUSED, "line"},
	{"negative_indices_valid", TAKEN, NULL},
	{"faces_before_vertices", TAKEN, NULL},
	{"nan_inf_vertices", REFUSED, "line"},
	{"nan_words", REFUSED, "line"},
	{"huge_1e38", REFUSED, "metres"},
	{"overflow_1e400", REFUSED, "line"},
	{"denormal_1e-42", REFUSED, "metres"},
	{"far_from_origin", REFUSED, "origin"},
	{"millimetres", MENDED, "millimetres"},
	{"z_up", MENDED, "+Y up"},
	{"inverted_winding", MENDED, "outward"},
	{"half_inverted", MENDED, "outward"},
	{"random_winding", MENDED, "outward"},
	{"holes_5percent", REFUSED, "open"},
	{"headless_open", REFUSED, "open"},
	{"duplicate_faces", MENDED, "left out"},
	{"double_shell", REFUSED, "volume"},
	{"two_bodies_overlapping", NO_CRASH, NULL},
	{"fin_nonmanifold_edge", REFUSED, "edge"},
	{"bowtie_vertex", NO_CRASH, NULL},
	{"klein_strip_nonorientable", REFUSED, NULL},
	{"repeated_index_face", NO_CRASH, NULL},
	{"zero_area_triangle", NO_CRASH, NULL},
	{"triangle_soup_unwelded", MENDED, "joined"},
	{"flat_body", REFUSED, "volume"},
	{"crlf_tabs_continuation", TAKEN, NULL},
	{"cr_only_lineends", TAKEN, NULL},
	{"utf16le_bom", REFUSED, "UTF-16"},
	{"comma_decimals", REFUSED, "commas"},
	{"group_name_traversal", TAKEN, NULL},
	{"name_control_chars", TAKEN, NULL},
	{"ngon_1000", NO_CRASH, NULL},
	{"ngon_concave_selfcrossing", NO_CRASH, NULL},
	{"random_bytes", REFUSED, NULL},
};

/* What wears clothes must come in. The robot is 60 open parts. */
static const struct character_case body_cases[] = {
	{"mh_female_young_average", TAKEN, NULL},
	{"mh_male_old_heavy", TAKEN, NULL},
	{"mh_child_female", TAKEN, NULL},
	{"mh_base_androgynous", TAKEN, NULL},
	{"gc_mean_all", TAKEN, NULL},
	{"gc_mean_male", TAKEN, NULL},
	{"cesiumman", TAKEN, NULL},
	{"kenney_charactermedium", TAKEN, NULL},
	{"quaternius_robot", REFUSED, "edge"},
	{"bunny_28k", NO_CRASH, NULL},
	{"spot_cow", NO_CRASH, NULL},
	{"assimp_spider", NO_CRASH, NULL},
	{"kaykit_mage", NO_CRASH, NULL},
	{"kaykit_barbarian", NO_CRASH, NULL},
};

static bool right(const struct character_case *expected, bool loaded, const char *note,
		  const char *fault)
{
	const char *words = loaded ? note : fault;
	if (expected->words && !strstr(words, expected->words))
		return false;
	switch (expected->verdict) {
	case REFUSED:
		return !loaded && fault[0];
	case TAKEN:
		return loaded && !note[0];
	case MENDED:
		return loaded && note[0];
	default:
		return loaded || fault[0];
	}
}

static void test_case(struct body *body, const char *folder, const struct character_case *expected)
{
	char path[PATH_BYTES_MAX], note[FAULT_BYTES] = "", fault[FAULT_BYTES] = "";
	snprintf(path, sizeof path, "%s/%s.obj", folder, expected->name);
	bool loaded = character_load(body, path, NULL, note, fault);
	bool as_expected = right(expected, loaded, note, fault);
	if (!as_expected || getenv("TEST_VERBOSE"))
		fprintf(stderr, "%s: %s, note \"%s\", fault \"%s\"\n", expected->name,
			loaded ? "taken" : "refused", note, loaded ? "" : fault);
	CHECK(as_expected);
}

int main(void)
{
	struct stat status;
	struct body *body = calloc(1, sizeof *body);
	void *memory = malloc(KIOSK_MEMORY_BYTES);
	struct arena arena;
	char note[FAULT_BYTES], fault[FAULT_BYTES];
	CHECK(body && memory);
	arena_init(&arena, memory, KIOSK_MEMORY_BYTES);
	body_init(body, &arena);
	CHECK(character_load(body, CHARACTER_MANNEQUIN, NULL, note, fault));
	CHECK(body->bone_count > 0 && !note[0]);
	CHECK(!character_load(body, "/nowhere/body.obj", NULL, note, fault));
	CHECK(strstr(fault, "/nowhere/body.obj"));
	bool data = stat(nasty, &status) == 0;
	for (int i = 0; data && i < COUNT_OF(nasty_cases); i++)
		test_case(body, nasty, &nasty_cases[i]);
	for (int i = 0; data && i < COUNT_OF(body_cases); i++)
		test_case(body, bodies, &body_cases[i]);
	free(body);
	free(memory);
	if (test_failures == 0 && !data) {
		puts("skip: no bodies in ../shared/data");
		return 77;
	}
	return test_end();
}
