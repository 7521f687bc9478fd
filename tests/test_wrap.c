/* Wrap on the mannequin: a T-shirt lies right, whatever the quota, the hand or the marks do. */
#include "journal.h"
#include "measure.h"
#include "session.h"
#include "test.h"

static struct session session;
static struct measure measure;
static struct measure_scratch *scratch;
static struct scatter hand = {1u};
static float tremble_mm, off_m;

/* -1 .. 1 */
static float shake(void)
{
	return (float)scatter_below(&hand, 2001) * 0.001f - 1.0f;
}

/* The hand's faults: corners of outlines a few mm off, marks on the body shifted as a whole. */
static void spoil(struct edit *edit)
{
	float shift[3] = {shake() * off_m, shake() * off_m, shake() * off_m};
	for (int i = 0; i < edit->point_count; i++) {
		struct v3 *p = &edit->point[i];
		if (edit->kind == EDIT_PIECE && edit->corner[i]) {
			p->x += shake() * tremble_mm;
			p->y += shake() * tremble_mm;
		}
		if (edit->kind == EDIT_MARK_BODY)
			*p = v3_add(*p, (struct v3){shift[0], shift[1], shift[2]});
	}
}

static void apply(struct edit *edit)
{
	bool taken = session_apply(&session, edit);
	if (!taken)
		fprintf(stderr, "%s\n", session.notice);
	CHECK(taken);
}

static void apply_kind(enum edit_kind kind)
{
	static struct edit edit;
	memset(&edit, 0, sizeof edit);
	edit.kind = kind;
	apply(&edit);
}

/* The document of a journal without its wrap and what follows. */
static void read_document(const char *path)
{
	static char line[JOURNAL_LINE_MAX];
	static struct edit edit;
	char fault[160];
	FILE *file = fopen(path, "r");
	CHECK(file != NULL);
	apply_kind(EDIT_CLEAR);
	while (file && fgets(line, sizeof line, file)) {
		enum journal_result result = journal_read(line, (int)strlen(line), &edit, fault);
		CHECK(result != JOURNAL_FAULT);
		if (result != JOURNAL_EDIT || edit.kind == EDIT_STEP || edit.kind == EDIT_SETTLE ||
		    edit.kind == EDIT_WRAP)
			continue;
		spoil(&edit);
		apply(&edit);
	}
	if (file)
		fclose(file);
}

static void dress(int frames)
{
	apply_kind(EDIT_WRAP);
	for (int i = 0; i < 2000 && session.job != JOB_NONE; i++)
		session_advance(&session);
	CHECK(session.job == JOB_NONE);
	for (int i = 0; i < frames; i++)
		session_advance(&session);
	measure_garment(&measure, &session.cloth, scratch);
}

static bool found(const char *kind, int mark_1, int mark_2)
{
	for (int i = 0; i < session.wrap.diagnoses.count; i++) {
		const struct diagnosis *d = &session.wrap.diagnoses.item[i];
		if (strcmp(d->kind, kind) == 0 && d->mark[0] == mark_1 && d->mark[1] == mark_2)
			return true;
	}
	return false;
}

static void check_worn_right(void)
{
	CHECK(session.cloth.worn);
	CHECK(measure.vertices_inside == 0);
	CHECK(measure.midpoints_inside == 0);
	CHECK(measure.centres_inside == 0);
	CHECK(measure.edge_crossings_body == 0);
	CHECK(measure.inverted_triangles == 0);
	CHECK(measure.strain_p95 < 0.10f);
	CHECK(measure.seam_gap_mm_max == 0.0f);
	CHECK(measure.head_through_collar);
	CHECK(measure.arms_in_sleeves == 2);
}

/* Marks drawn low and askew: the shoulder seams have farther to go, and still close over the
 * shoulders. */
static void test_tshirt_low(void)
{
	static const struct v3 aside_m[] = {{0.0f, -0.03f, 0.0f},
					    {0.0f, -0.05f, 0.0f},
					    {0.03f, -0.04f, 0.0f},
					    {-0.03f, 0.0f, 0.0f}};
	for (int i = 0; i < COUNT_OF(aside_m); i++) {
		read_document("tests/journals/tshirt.kitsuke");
		for (int m = 0; m < MARKS_MAX; m++)
			for (int k = 0; k < session.document.marks.body[m].point_count; k++) {
				struct v3 *p = &session.document.marks.body[m].point_m[k];
				*p = v3_add(*p, aside_m[i]);
			}
		dress(360);
		printf("marks off by %.0f, %.0f mm:\n", 1e3 * (double)aside_m[i].x,
		       1e3 * (double)aside_m[i].y);
		check_worn_right();
	}
}

static void test_tshirt(void)
{
	read_document("tests/journals/tshirt.kitsuke");
	dress(0);
	CHECK(session.cloth.sweep < 450);
	CHECK(session.wrap.mark_error_rms_m < 0.005f);
	dress(360);
	check_worn_right();
}

/* A mark drawn on the worn shirt and 30 mm beside its place on the body: the shirt itself moves
 * there, and wears as well as before (S9). */
static void test_move(void)
{
	static struct edit edit;
	memset(&edit, 0, sizeof edit);
	edit.kind = EDIT_MARK_CLOTH;
	edit.i[0] = 9;
	edit.point_count = 12;
	for (int i = 0; i < edit.point_count; i++)
		edit.point[i] = (struct v3){0.0f, -150.0f - 20.0f * (float)i, 0.0f};
	apply(&edit);
	for (int i = 0; i < edit.point_count; i++) {
		float weight[3];
		struct v2 at_mm = {0.0f, -150.0f - 20.0f * (float)i};
		int at = garment_locate(&session.garment, 0, at_mm, weight);
		CHECK(at >= 0);
		int v = session.garment.triangle[at].v[0];
		edit.point[i] = session.cloth.position_m[v];
		edit.point[i].x += 0.03f;
	}
	edit.kind = EDIT_MARK_BODY;
	apply(&edit);
	apply_kind(EDIT_WRAP);
	CHECK(session.job == JOB_WRAP && session.cloth.worn && session.wrap.stage == WRAP_MOVE);
	for (int i = 0; i < 2000 && session.wrap.stage == WRAP_MOVE; i++)
		session_advance(&session);
	CHECK(session.wrap.mark_error_rms_m < 0.01f);
	for (int i = 0; i < 2000 && session.job != JOB_NONE; i++)
		session_advance(&session);
	CHECK(session.job == JOB_NONE);
	for (int i = 0; i < 360; i++)
		session_advance(&session);
	measure_garment(&measure, &session.cloth, scratch);
	check_worn_right();
	/* nothing new: the next wrap begins anew */
	apply_kind(EDIT_WRAP);
	CHECK(session.job == JOB_MESH);
}

/* Ten seconds kept awake: the garment neither creeps nor tangles, and hardly moves in the end. */
static void test_holds(void)
{
	static struct v3 early[GARMENT_VERTICES_MAX], late[GARMENT_VERTICES_MAX];
	struct cloth *cloth = &session.cloth;
	size_t size = (size_t)session.garment.vertex_count * sizeof(struct v3);
	cloth->settings = cloth_settings_worn();
	for (int frame = 0; frame < 600; frame++) {
		if (frame == 180)
			memcpy(early, cloth->position_m, size);
		if (frame == 599)
			memcpy(late, cloth->position_m, size);
		for (int sweep = 0; sweep < 10; sweep++)
			cloth_sweep(cloth);
		cloth_finish(cloth);
	}
	float crept = 0.0f, moved = 0.0f;
	for (int v = 0; v < session.garment.vertex_count; v++) {
		crept += v3_distance(cloth->position_m[v], early[v]);
		moved += v3_distance(cloth->position_m[v], late[v]);
	}
	CHECK(crept / (float)session.garment.vertex_count < 0.003f);
	CHECK(moved / (float)session.garment.vertex_count < 0.05e-3f);
	measure_garment(&measure, cloth, scratch);
	CHECK(measure.vertices_inside == 0 && measure.edge_crossings_body == 0);
	CHECK(measure.strain_p95 < 0.10f);
	CHECK(measure.head_through_collar && measure.arms_in_sleeves == 2);
}

static void test_unsteady_hands(void)
{
	for (uint32_t seed = 1; seed <= 2; seed++) {
		hand.state = seed * 2654435761u;
		tremble_mm = 5.0f;
		off_m = 0.02f;
		read_document("tests/journals/tshirt.kitsuke");
		tremble_mm = off_m = 0.0f;
		dress(360);
		check_worn_right();
	}
}

/* The wrap's result does not depend on how its work is spread over frames. */
static void test_any_quota(void)
{
	uint64_t hash[2];
	const long quota[2] = {1, 1000000};
	read_document("tests/journals/tshirt.kitsuke");
	apply_kind(EDIT_WRAP);
	for (int i = 0; i < 2000 && session.job == JOB_MESH; i++)
		session_advance(&session);
	for (int run = 0; run < 2; run++) {
		struct hash sum;
		hash_init(&sum);
		cloth_reset(&session.cloth, &session.garment, &session.body);
		CHECK(wrap_start(&session.wrap, &session.cloth, &session.document.marks));
		for (int i = 0; i < 2000 && session.wrap.stage != WRAP_DONE; i++)
			CHECK(wrap_advance(&session.wrap, quota[run]) > 0);
		CHECK(session.wrap.stage == WRAP_DONE);
		for (int v = 0; v < session.garment.vertex_count; v++) {
			hash_float(&sum, session.cloth.position_m[v].x);
			hash_float(&sum, session.cloth.position_m[v].y);
			hash_float(&sum, session.cloth.position_m[v].z);
		}
		hash[run] = sum.value;
	}
	CHECK(hash[0] == hash[1]);
	session.job = JOB_NONE;
}

static void check_sane(void)
{
	for (int v = 0; v < session.garment.vertex_count; v++) {
		struct v3 p = session.cloth.position_m[v];
		if (session.cloth.placed[v])
			CHECK(float_abs(p.x) < 3.0f && float_abs(p.y) < 4.0f &&
			      float_abs(p.z) < 3.0f);
	}
}

/* Both pieces laid on the chest, one of them upside down: a bad drape, said in words. */
static void test_contradiction(void)
{
	read_document("tests/journals/tshirt.kitsuke");
	struct body_mark *mark = session.document.marks.body;
	while (mark->number != 2)
		mark++;
	for (int i = 0; i < mark->point_count; i++)
		mark->point_m[i] = (struct v3){0.0f, 1.0f + 0.02f * (float)i, 0.2f};
	dress(120);
	CHECK(session.cloth.worn);
	CHECK(found("marks-disagree", 1, 2));
	check_sane();
}

static void test_lonely_and_short_marks(void)
{
	static struct edit edit;
	read_document("tests/journals/tshirt.kitsuke");
	memset(&edit, 0, sizeof edit);
	edit.kind = EDIT_MARK_CLOTH;
	edit.i[0] = 3;
	edit.point_count = 2;
	edit.point[0] = (struct v3){100.0f, -200.0f, 0.0f};
	edit.point[1] = (struct v3){100.0f, -260.0f, 0.0f};
	apply(&edit);
	dress(0);
	CHECK(found("no-partner", 3, 0));
	edit.kind = EDIT_MARK_BODY;
	edit.point[0] = (struct v3){0.10f, 1.05f, 0.2f};
	edit.point[1] = (struct v3){0.10f, 1.26f, 0.2f};
	apply(&edit);
	dress(60);
	CHECK(!found("no-partner", 3, 0));
	CHECK(found("lengths-differ", 3, 0));
	CHECK(found("directions-differ", 1, 3));
	check_sane();
}

static void test_no_marks(void)
{
	static const struct marks none;
	uint8_t placed = session.cloth.placed[0];
	CHECK(!wrap_start(&session.wrap, &session.cloth, &none));
	CHECK(found("no-marks", 0, 0));
	CHECK(session.cloth.placed[0] == placed);
}

int main(void)
{
	struct arena arena;
	size_t size = (size_t)256 << 20;
	void *memory = malloc(size);
	if (!memory)
		return 1;
	arena_init(&arena, memory, size);
	session_init(&session, &arena);
	scratch = measure_init(&arena);
	CHECK(!body_build_mannequin(&session.body));
	CHECK(body_find_parts(&session.body));
	test_tshirt();
	test_move();
	test_tshirt_low();
	test_holds();
	test_unsteady_hands();
	test_any_quota();
	test_contradiction();
	test_lonely_and_short_marks();
	test_no_marks();
	free(memory);
	return test_end();
}
