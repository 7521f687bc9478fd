/* Bones from a file: reading with clear faults, writing, and the body's parts that follow them. */
#include "format_bones.h"
#include "shapes.h"
#include "test.h"

static struct body body;
static struct bone_list bones;
static char fault[200];

static bool reads(const char *text)
{
	return format_bones_read(&bones, text, strlen(text), fault);
}

static void check_fault(const char *text, const char *words)
{
	bool as_expected = !reads(text) && strstr(fault, words);
	if (!as_expected)
		fprintf(stderr, "\"%s\": fault \"%s\"\n", text, fault);
	CHECK(as_expected);
}

static void test_faults(void)
{
	check_fault("", "line 1: the file is empty");
	check_fault("spine 0 0 0 0 1 0\n", "line 1: a bones file begins");
	check_fault(BONES_HEADER "# nothing\n", "line 2: there is no spine");
	check_fault(BONES_HEADER "neck 0 0 0 0 1 0\n", "no spine");
	check_fault(BONES_HEADER "\nrib 0 0 0 0 1 0\n", "line 3: a bone begins with spine");
	check_fault(BONES_HEADER "spine 0 0 0 0 1\n", "line 2: a bone has two ends");
	check_fault(BONES_HEADER "spine 0 0 0 0 1 0 0.1 7\n", "follows");
	check_fault(BONES_HEADER "spine 0 0 0 0 1,5 0\n", "a number is wanted");
	check_fault(BONES_HEADER "spine 0 0 0 0 1 0x\n", "a number is wanted");
	check_fault(BONES_HEADER "spine 0 0 0 0 1500 0\n", "100 m");
	check_fault(BONES_HEADER "spine 0 1 0 0 1 0\n", "same place");
	check_fault(BONES_HEADER "spine 0 0 0 0 1 0 -1\n", "negative");
	char many[4096] = BONES_HEADER;
	for (int i = 0; i <= BODY_BONES_MAX; i++)
		strcat(many, "spine 0 0 0 0 1 0\n");
	check_fault(many, "line 34: more than 32 bones");
}

static void test_order(void)
{
	CHECK(reads(BONES_HEADER
		    "girdle 0 1 0 0.2 1 0 # collar-bone\r\n"
		    "arm-left 0.2 1 0 0.4 1 0\n  arm-left 0.4 1 0 0.6 1 0 0.03\n"
		    "\thead 0 1.2 0 0 1.4 0\nneck 0 1 0 0 1.2 0\nspine 0 0.5 0 0 1 0"));
	CHECK(bones.count == 6);
	static const enum body_part part[] = {PART_TRUNK,    PART_HEAD,     PART_HEAD,
					      PART_ARM_LEFT, PART_ARM_LEFT, PART_TRUNK};
	static const int line[] = {7, 6, 5, 3, 4, 2};
	for (int b = 0; b < 6; b++)
		CHECK(bones.bone[b].part == part[b] && bones.line[b] == line[b]);
	CHECK(bones.bone[3].radius_m == 0.0f && bones.bone[4].radius_m == 0.03f);
	CHECK(bones.bone[4].b_m.x == 0.6f);
}

/* What was found, written and read, gives nearly the same parts and lines again. */
static void test_found(void)
{
	static uint8_t part[BODY_TRIANGLES_MAX];
	static struct landmark_line waist;
	struct bone_list found, again;
	size_t size;
	int at, differing = 0;
	CHECK(!body_build_mannequin(&body));
	CHECK(body_find_parts(&body));
	memcpy(part, body.part, sizeof part);
	waist = body.landmark[LANDMARK_ROUND_WAIST];
	found.count = body.bone_count;
	memcpy(found.bone, body.bone, sizeof found.bone);
	char *text = format_bones_write(&found, &size);
	CHECK(text && format_bones_read(&again, text, size, fault));
	free(text);
	CHECK(again.count == found.count);
	for (int b = 0; b < found.count; b++)
		CHECK(!memcmp(&again.bone[b], &found.bone[b], sizeof found.bone[b]));
	CHECK(!body_give_bones(&body, &again, &at));
	for (int t = 0; t < body.triangle_count; t++)
		differing += part[t] != body.part[t];
	CHECK(differing < body.triangle_count / 12);
	CHECK_NEAR(body.landmark[LANDMARK_ROUND_WAIST].girth_m, waist.girth_m, 1e-3);
}

static float radius_round(int ring, int column)
{
	(void)ring, (void)column;
	return 0.8f;
}

/* A ball that nobody would find an arm on: its bones are given. */
static void test_given(void)
{
	static struct shape shape;
	int at, left = 0;
	shape_globe(&shape, 20, 30, radius_round);
	CHECK(!body_build(&body, shape.position_m, shape.vertex_count, shape.triangle,
			  shape.triangle_count));
	CHECK(!body_find_parts(&body));
	CHECK(reads(BONES_HEADER "spine 0 -0.7 0 0 0.7 0\narm-left 0.3 0.3 0 0.65 0.3 0\n"));
	CHECK(!body_give_bones(&body, &bones, &at));
	CHECK(body.bone_count == 2 && body.bone[0].radius_m > 0.1f);
	for (int t = 0; t < body.triangle_count; t++)
		left += body.part[t] == PART_ARM_LEFT;
	CHECK(left > 0 && left < body.triangle_count);
	CHECK(reads(BONES_HEADER "spine 0 -0.7 0 0 0.7 0\nhead 0 0.2 0 0 20 0\n"));
	CHECK(strstr(body_give_bones(&body, &bones, &at), "outside the body") && at == 1);
	CHECK(body.bone_count == 2 && body.bone[1].part == PART_ARM_LEFT);
}

/* An edge through the forearm: pushed out on the side of its ends' normals, or the nearer one. */
static void test_crossed(void)
{
	struct v3 push = {0.0f, 0.0f, 0.0f};
	CHECK(!body_build_mannequin(&body));
	CHECK(body_find_parts(&body));
	const struct bone *arm = &body.bone[0];
	while (arm->part != PART_ARM_LEFT)
		arm++;
	arm++;
	struct v3 middle = v3_lerp(arm->a_m, arm->b_m, 0.5f);
	struct v3 axis = v3_normalize(v3_sub(arm->b_m, arm->a_m));
	struct v3 front = v3_normalize(v3_mad((struct v3){0.0f, 0.0f, 1.0f}, axis, -axis.z));
	struct v3 up = v3_cross(front, axis), back = v3_scale(front, -1.0f);
	/* across the limb, a little behind the bone, though it belongs in front */
	struct v3 at = v3_mad(middle, front, -0.1f * arm->radius_m);
	struct v3 a = v3_mad(at, up, 0.05f), b = v3_mad(at, up, -0.05f);
	CHECK(body_bone_crossed(&body, PART_ARM_LEFT, a, b, v3_scale(front, 1.6f), &push));
	CHECK_NEAR(v3_dot(push, front), 1.1 * (double)arm->radius_m, 1e-4);
	CHECK_NEAR(v3_length(push), v3_dot(push, front), 1e-4);
	CHECK(body_bone_crossed(&body, PART_ARM_LEFT, b, a, (struct v3){0.0f, 0.0f, 0.0f}, &push));
	CHECK_NEAR(v3_dot(push, back), 0.9 * (double)arm->radius_m, 1e-4);
	/* another limb's; on the skin; beyond the bone's end; no edge at all */
	CHECK(!body_bone_crossed(&body, PART_ARM_RIGHT, a, b, front, &push));
	CHECK(!body_bone_crossed(&body, PART_TRUNK, a, b, front, &push));
	at = v3_mad(middle, front, arm->radius_m);
	CHECK(!body_bone_crossed(&body, PART_ARM_LEFT, v3_mad(at, up, 0.05f),
				 v3_mad(at, up, -0.05f), front, &push));
	at = v3_mad(body.bone[0].a_m, axis, -0.2f);
	CHECK(!body_bone_crossed(&body, PART_ARM_LEFT, v3_mad(at, up, 0.05f),
				 v3_mad(at, up, -0.05f), front, &push));
	CHECK(!body_bone_crossed(&body, PART_ARM_LEFT, middle, middle, front, &push));
}

int main(void)
{
	enum { BYTES = 96 << 20 };
	struct arena arena;
	void *memory = malloc(BYTES);
	arena_init(&arena, memory, BYTES);
	body_init(&body, &arena);
	test_faults();
	test_order();
	test_found();
	test_given();
	test_crossed();
	free(memory);
	return test_end();
}
