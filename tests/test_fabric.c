/* Fabrics differ in ways that can be measured: how far a strip bends over, stretches, shears. */
#include "fabric.h"
#include "session.h"
#include "test.h"

static struct session session;
static struct garment_job *job;
static struct pattern pattern;

static const float strip_m = 0.3f, jut_m = 0.04f;

/* A strip of 0.3 m x 0.1 m beside the mannequin, `along` and `across` in space. */
static void lay_strip(const char *fabric, struct v3 along, struct v3 across)
{
	struct cloth *cloth = &session.cloth;
	struct garment *garment = &session.garment;
	bool done = false;
	memset(&pattern, 0, sizeof pattern);
	pattern.piece[0] = (struct piece){.used = true, .point_count = 4, .name = "strip"};
	const struct v2 corner[4] = {
		{0.0f, 0.0f}, {300.0f, 0.0f}, {300.0f, 100.0f}, {0.0f, 100.0f}};
	for (int i = 0; i < 4; i++) {
		pattern.piece[0].point_mm[i] = corner[i];
		pattern.piece[0].corner[i] = true;
	}
	CHECK(!garment_start(job, garment, &pattern, 300));
	for (int i = 0; !done && i < 100000; i++)
		garment_advance(job, 100000, &done);
	cloth_reset(cloth, garment, &session.body);
	for (int v = 0; v < garment->vertex_count; v++) {
		struct v2 p = garment->rest_m[v];
		struct v3 origin = {2.0f, 1.0f, 0.0f};
		cloth->position_m[v] = v3_mad(v3_mad(origin, along, p.x), across, p.y);
		cloth->previous_m[v] = cloth->position_m[v];
		cloth->goal_m[v] = cloth->position_m[v];
		cloth->placed[v] = 1;
	}
	cloth->worn = true;
	cloth->fabric = fabric_named(fabric);
	CHECK(cloth->fabric >= 0);
}

/* Holds what lies nearer to the start than `from_m`, lets the rest go; the mean of the free end. */
static struct v3 end_after(float from_m, int sweeps)
{
	struct cloth *cloth = &session.cloth;
	struct v3 sum = {0.0f, 0.0f, 0.0f};
	int count = 0;
	for (int v = 0; v < session.garment.vertex_count; v++)
		cloth->held[v] = session.garment.rest_m[v].x < from_m ? 2 : 0;
	for (int sweep = 0; sweep < sweeps; sweep++)
		cloth_sweep(cloth);
	for (int v = 0; v < session.garment.vertex_count; v++)
		if (session.garment.rest_m[v].x > strip_m - 0.001f) {
			sum = v3_add(sum, cloth->position_m[v]);
			count++;
		}
	return v3_scale(sum, 1.0f / (float)count);
}

/* How far the end of a strip that juts out hangs down. */
static float droop_m(const char *fabric)
{
	lay_strip(fabric, (struct v3){1.0f, 0.0f, 0.0f}, (struct v3){0.0f, 0.0f, -1.0f});
	float droop = 1.0f - end_after(strip_m - jut_m, 2000).y;
	printf("%-8s droops %.0f mm\n", fabric, (double)(1000.0f * droop));
	return droop;
}

/* How much longer a strip is that hangs. */
static float growth_m(const char *fabric)
{
	lay_strip(fabric, (struct v3){0.0f, -1.0f, 0.0f}, (struct v3){1.0f, 0.0f, 0.0f});
	float growth = 1.0f - end_after(0.03f, 2000).y - strip_m;
	printf("%-8s grows %.2f mm\n", fabric, (double)(1000.0f * growth));
	return growth;
}

static void test_bending(void)
{
	float leather = droop_m("leather"), denim = droop_m("denim");
	float jersey = droop_m("jersey"), silk = droop_m("silk");
	CHECK(leather + 0.005f < denim);
	CHECK(denim + 0.002f < jersey);
	CHECK(jersey + 0.001f < silk);
}

static void test_stretching(void)
{
	float elastic = growth_m("elastic"), jersey = growth_m("jersey");
	CHECK(elastic > 3.0f * jersey);
	CHECK(elastic > 0.002f);
}

static bool edit(const char *name)
{
	static struct edit fabric;
	fabric = (struct edit){.kind = EDIT_FABRIC};
	memcpy(fabric.name, name, strlen(name) + 1);
	return session_apply(&session, &fabric);
}

static void test_edit(void)
{
	static struct edit undo = {.kind = EDIT_UNDO};
	CHECK(edit("denim") && session.cloth.fabric == fabric_named("denim"));
	CHECK(!edit("tin") && session.cloth.fabric == fabric_named("denim"));
	CHECK(edit("silk"));
	CHECK(session_apply(&session, &undo));
	CHECK(session.cloth.fabric == fabric_named("denim"));
	CHECK(fabric_named("") < 0 && fabric_named("denims") < 0);
}

int main(void)
{
	static unsigned char memory[192u << 20];
	struct arena arena;
	arena_init(&arena, memory, sizeof memory);
	session_init(&session, &arena);
	job = garment_job_init(&arena);
	CHECK(!body_build_mannequin(&session.body));
	test_bending();
	test_stretching();
	test_edit();
	return test_end();
}
