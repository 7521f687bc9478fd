/* A collar, which no mark lays, goes round the neck: round the thin one of a slim body, and round
 * neck and chin as they grow. */
#include "dress_private.h"
#include "test.h"

enum { ROWS = 8, COLUMNS = 12, POINTS = ROWS * COLUMNS };

static struct body body;
static struct wrap wrap;
static struct cloth cloth;
static struct garment garment;
static struct v3 position_m[POINTS];
static int piece[POINTS], particle[POINTS];
static uint8_t placed[POINTS];

static const float edge_m = 0.03f;
static const float root_share = 0.15f; /* of head and neck, below which a slim neck widens */

/* The bone at the root of the neck. */
static const struct bone *neck(void)
{
	int b = 0;
	while (body.bone[b].part != PART_HEAD)
		b++;
	return &body.bone[b];
}

/* Upright cloth across the middle of the neck and the jaw, as where two ends of a collar have grown
 * over each other. */
static void lay_across(void)
{
	float rise_m = root_share * wrap.scratch->limb[PART_HEAD].end_m;
	struct v3 along = v3_normalize(v3_sub(neck()->b_m, neck()->a_m));
	struct v3 root_m = v3_mad(neck()->a_m, along, rise_m);
	for (int v = 0; v < POINTS; v++) {
		float x = ((float)(v % COLUMNS) - 0.5f * (float)(COLUMNS - 1)) * edge_m;
		float y = (float)(v / COLUMNS) * 0.5f * edge_m;
		position_m[v] = (struct v3){root_m.x + x, root_m.y + y, root_m.z + 0.002f};
		particle[v] = v;
		placed[v] = 1;
	}
	garment.vertex_count = POINTS;
	garment.piece = piece;
	garment.edge_m = edge_m;
	cloth.garment = &garment;
	cloth.position_m = position_m;
	cloth.particle = particle;
	cloth.placed = placed;
	cloth.settings.offset_m = 0.004f;
	wrap.cloth = &cloth;
}

static bool is_near(struct v3 a_m, struct v3 b_m)
{
	return v3_distance(a_m, b_m) <= 1.5f * edge_m;
}

/* Edges of cloth, of which there are some beside the neck, that pass through the body's head. */
static int count_crossings(const struct body *in, int *edges)
{
	int crossings = 0;
	*edges = 0;
	for (int v = 0; v < POINTS; v++) {
		struct body_hit hit;
		if (v % COLUMNS == COLUMNS - 1 || !is_near(position_m[v], position_m[v + 1]))
			continue;
		++*edges;
		crossings += body_segment_hits(in, position_m[v], position_m[v + 1], &hit) &&
			     in->part[hit.triangle] == PART_HEAD;
	}
	return crossings;
}

/* However far the body has grown, no point is left in the hull, nor an edge through the neck. */
static void test_round(void)
{
	struct wrap_scratch *s = wrap.scratch;
	CHECK(body_slim_make(&s->slim, &body, s->limb, 0, NULL));
	cloth.body = &s->slim.body;
	for (int step = 0; step < 5; step++) {
		float share = 0.25f * (float)step;
		int edges;
		body_slim_grow(&s->slim, &body, share);
		lay_across();
		CHECK(count_crossings(&s->slim.body, &edges) > 0);
		wrap_clear_hulls(&wrap, share);
		CHECK(count_crossings(&s->slim.body, &edges) == 0);
		CHECK(edges > POINTS / 4);
		for (int v = 0; v < POINTS; v++) {
			struct body_hit hit;
			body_nearest(&s->slim.body, position_m[v], 1u << PART_HEAD, &hit);
			CHECK(hit.distance_m > 0.0f);
		}
	}
}

/* A sleeve goes past, and cloth that marks lay stays there. */
static void test_others(void)
{
	struct wrap_scratch *s = wrap.scratch;
	struct v3 before_m[POINTS];
	CHECK(body_slim_make(&s->slim, &body, s->limb, 0, NULL));
	cloth.body = &s->slim.body;
	lay_across();
	memcpy(before_m, position_m, sizeof before_m);
	s->seeded[0] = 1;
	wrap_clear_hulls(&wrap, 0.0f);
	CHECK(memcmp(before_m, position_m, sizeof before_m) == 0);
	s->seeded[0] = 0;
	s->home[0] = PART_ARM_LEFT;
	wrap_clear_hulls(&wrap, 0.0f);
	CHECK(memcmp(before_m, position_m, sizeof before_m) == 0);
}

int main(void)
{
	enum { BYTES = 256 << 20 };
	struct arena arena;
	void *memory = malloc(BYTES);
	if (!memory)
		return 1;
	arena_init(&arena, memory, BYTES);
	body_init(&body, &arena);
	wrap_init(&wrap, &arena);
	CHECK(!body_build_mannequin(&body) && body_find_parts(&body));
	body_measure_limbs(&body, wrap.scratch->limb);
	wrap.scratch->home[0] = PART_TRUNK;
	test_round();
	test_others();
	free(memory);
	return test_end();
}
