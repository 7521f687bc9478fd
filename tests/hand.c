/* Writes the bundled tapes: visits, each from an empty sheet to a garment as the paper's examples
 * show it (S21).
 *
 *   hand VISIT TAPE [SEED]
 *
 * Everything goes through the pen and the three buttons, as a visitor would; the hand knows where
 * to draw because it sees the running program's state, as a visitor sees the screen. */
#include "hand_visit.h"

#include <inttypes.h>
#include <stdlib.h>

enum { WIDTH_PX = 1280, HEIGHT_PX = 720 };

static const float careful_px_s = 220.0f, brisk_px_s = 420.0f; /* along outlines */

/* ---- T-shirts ---- */

/* From the pit of the neck, y up. */
static const struct v2 half_shirt_mm[] = {
	{82.0f, 0.0f},     /* neck side */
	{426.0f, -264.0f}, /* sleeve end, above */
	{318.0f, -404.0f}, /* sleeve end, below */
	{242.0f, -344.0f}, /* underarm */
	{250.0f, -680.0f}, /* hem */
};

static void make_shirt(struct hand *hand, struct sketch *shirt, float speed)
{
	sketch_make(shirt, half_shirt_mm, COUNT_OF(half_shirt_mm), 92.0f);
	visit_draw(hand, shirt, (struct v2){-110.0f, 600.0f}, speed);
	visit_say(hand, "front");
	visit_copy(hand);
	visit_dip(hand, shirt, BACK, half_shirt_mm[0].x, 30.0f, 0.7f * speed);
	visit_say(hand, "back");
	hand_tap_target(hand, TARGET_STEP_SEW);
	for (int run = 0; run < 4; run++) /* shoulder, underarm, side */
		if (run != 1)
			visit_sew(hand, shirt,
				  v2_lerp(half_shirt_mm[run], half_shirt_mm[run + 1], 0.5f));
	visit_say(hand, "sewn");
}

/* A line down the middle, on both sides. */
static void mark_middle(struct hand *hand, const struct sketch *sketch, struct v2 cloth_y_mm,
			struct v2 body_y_m)
{
	struct v2 from = {0.0f, cloth_y_mm.x}, to = {0.0f, cloth_y_mm.y};
	hand_tap_target(hand, TARGET_STEP_MARK);
	hand_tap_target(hand, TARGET_LASER);
	visit_mark_body(hand, (struct v2){0.0f, body_y_m.x}, (struct v2){0.0f, body_y_m.y}, 1.0f);
	hand_tap_target(hand, TARGET_LASER);
	visit_mark_cloth(hand, sketch, FRONT, from, to);
	visit_mark_cloth(hand, sketch, BACK, from, to);
	visit_say(hand, "marked");
}

static void wear_shirt(struct hand *hand, struct sketch *shirt, float speed)
{
	make_shirt(hand, shirt, speed);
	mark_middle(hand, shirt, (struct v2){-140.0f, -560.0f}, (struct v2){1.32f, 0.90f});
	visit_wrap(hand);
	visit_say(hand, "wrapped");
	hand_tap_target(hand, TARGET_STEP_ADJUST);
}

/* The hem is pulled, a sleeve rolled against two pins, all of it relaxed. */
static void visit_tshirt(struct hand *hand)
{
	struct sketch shirt;
	wear_shirt(hand, &shirt, careful_px_s);
	visit_pull_by(hand, visit_place(hand, &shirt, FRONT, (struct v2){60.0f, -640.0f}),
		      (struct v2){24.0f, 5.0f});
	hand_wait(hand, 0.3f);
	visit_say(hand, "hem pulled");
	visit_pin(hand, visit_place(hand, &shirt, FRONT, (struct v2){190.0f, -115.0f}));
	visit_pin(hand, visit_place(hand, &shirt, FRONT, (struct v2){200.0f, -240.0f}));
	visit_pull_by(hand, visit_place(hand, &shirt, FRONT, (struct v2){362.0f, -340.0f}),
		      (struct v2){-16.0f, -24.0f});
	hand_wait(hand, 0.3f);
	visit_say(hand, "sleeve rolled");
	hand_leave(hand);
	hand_button(hand, BUTTON_RELAX, 1.2f);
	hand_wait(hand, 1.5f);
	visit_say(hand, "relaxed");
}

/* From a place of a sleeve towards one nearer to the shoulder, a share of the way. */
static void roll(struct hand *hand, const struct sketch *shirt, int piece, struct v2 from_mm,
		 struct v2 to_mm, float share)
{
	struct v3 from = visit_place(hand, shirt, piece, from_mm);
	struct v3 to = visit_place(hand, shirt, piece, to_mm);
	struct v3 way[2] = {from, v3_lerp(from, to, share)};
	visit_pull(hand, way, 2);
}

/* A fence of pins round each shoulder's half that is seen. */
static void pin_shoulders(struct hand *hand, const struct sketch *shirt, int piece)
{
	static const struct v2 pin_mm[] = {
		{172.0f, -90.0f}, {188.0f, -160.0f}, {205.0f, -230.0f}, {222.0f, -300.0f}};
	for (float side = -1.0f; side < 2.0f; side += 2.0f)
		for (int i = 0; i < COUNT_OF(pin_mm); i++)
			visit_pin(hand, visit_place(hand, shirt, piece,
						    (struct v2){side * pin_mm[i].x, pin_mm[i].y}));
}

static void roll_both(struct hand *hand, const struct sketch *shirt, int piece)
{
	for (float side = -1.0f; side < 2.0f; side += 2.0f) {
		roll(hand, shirt, piece, (struct v2){side * 395.0f, -290.0f},
		     (struct v2){side * 188.0f, -130.0f}, 0.5f);
		roll(hand, shirt, piece, (struct v2){side * 340.0f, -360.0f},
		     (struct v2){side * 210.0f, -240.0f}, 0.5f);
	}
}

/* Both sleeves rolled up: pins round the shoulders, then hems pulled up, behind and in front. */
static void visit_sleeves(struct hand *hand)
{
	struct sketch shirt;
	wear_shirt(hand, &shirt, brisk_px_s);
	pin_shoulders(hand, &shirt, FRONT);
	hand_tap_target(hand, TARGET_VIEW_BACK);
	pin_shoulders(hand, &shirt, BACK);
	visit_say(hand, "pinned");
	roll_both(hand, &shirt, BACK);
	hand_tap_target(hand, TARGET_VIEW_FRONT);
	roll_both(hand, &shirt, FRONT);
	visit_say(hand, "rolled");
	hand_leave(hand);
	hand_button(hand, BUTTON_RELAX, 1.0f);
	visit_rest(hand, 3.0f);
	visit_say(hand, "relaxed");
}

/* ---- the others ---- */

/* What lies in front is pulled round until a place that lay in the middle has gone so far. Each
 * stroke aims a little too far, as a hand does that has seen cloth give way. */
static void turn(struct hand *hand, const struct sketch *sketch, struct v2 watched_mm, float y_m,
		 float degrees)
{
	for (int stroke = 0; stroke < 5; stroke++) {
		struct v3 watched = visit_place(hand, sketch, FRONT, watched_mm);
		float left = degrees - visit_angle(watched);
		if (left < 4.0f)
			break;
		float by = float_clamp(1.2f * left, 40.0f, 100.0f);
		visit_pull_round(hand, y_m, -0.45f * by, 0.55f * by);
	}
}

/* A skirt, moved up by new marks, then turned a quarter of the way round by hand. */
static void visit_skirt(struct hand *hand)
{
	static const struct v2 half_mm[] = {{185.0f, 0.0f}, {340.0f, -450.0f}};
	struct sketch skirt;
	sketch_make(&skirt, half_mm, COUNT_OF(half_mm), 0.0f);
	visit_draw(hand, &skirt, (struct v2){-400.0f, 300.0f}, brisk_px_s);
	visit_copy(hand);
	hand_tap_target(hand, TARGET_STEP_SEW);
	visit_sew(hand, &skirt, (struct v2){262.0f, -225.0f});
	mark_middle(hand, &skirt, (struct v2){-20.0f, -220.0f}, (struct v2){0.98f, 0.78f});
	visit_wrap(hand);
	visit_say(hand, "wrapped");
	hand_tap_target(hand, TARGET_STEP_MARK);
	struct v3 worn[2] = {visit_place(hand, &skirt, FRONT, (struct v2){-80.0f, -15.0f}),
			     visit_place(hand, &skirt, FRONT, (struct v2){80.0f, -15.0f})};
	struct v2 line[2] = {visit_px(hand, worn[0]), visit_px(hand, worn[1])};
	hand_stroke(hand, line, 2, 200.0f);
	hand_wait(hand, 0.2f);
	visit_mark_body(hand, (struct v2){worn[0].x, worn[0].y + 0.06f},
			(struct v2){worn[1].x, worn[1].y + 0.06f}, 1.0f);
	visit_say(hand, "marked anew");
	visit_wrap(hand);
	visit_say(hand, "moved");
	hand_tap_target(hand, TARGET_STEP_ADJUST);
	turn(hand, &skirt, (struct v2){0.0f, -230.0f}, 0.80f, 90.0f);
	hand_leave(hand);
	visit_rest(hand, 3.0f);
	visit_say(hand, "turned");
}

/* A poncho, pulled round by its front and by its back. */
static void visit_poncho(struct hand *hand)
{
	static const struct v2 half_mm[] = {{105.0f, 0.0f}, {420.0f, 0.0f}, {420.0f, -520.0f}};
	struct sketch poncho;
	sketch_make(&poncho, half_mm, COUNT_OF(half_mm), 82.0f);
	visit_draw(hand, &poncho, (struct v2){-110.0f, 600.0f}, brisk_px_s);
	visit_copy(hand);
	visit_dip(hand, &poncho, BACK, half_mm[0].x, 30.0f, brisk_px_s);
	hand_tap_target(hand, TARGET_STEP_SEW);
	visit_sew(hand, &poncho, (struct v2){262.0f, 0.0f});
	mark_middle(hand, &poncho, (struct v2){-100.0f, -320.0f}, (struct v2){1.36f, 1.14f});
	visit_wrap(hand);
	visit_say(hand, "wrapped");
	hand_tap_target(hand, TARGET_STEP_ADJUST);
	visit_pull_round(hand, 1.25f, 0.0f, 40.0f);
	hand_tap_target(hand, TARGET_VIEW_BACK);
	visit_pull_round(hand, 1.27f, 180.0f, 220.0f);
	hand_tap_target(hand, TARGET_VIEW_FRONT);
	visit_pull_round(hand, 1.25f, 0.0f, 30.0f);
	hand_leave(hand);
	visit_rest(hand, 3.0f);
	visit_say(hand, "turned");
}

/* A sleeveless top put on askew, its marks drawn aside of the middle, and righted by strokes. */
static void visit_askew(struct hand *hand)
{
	static const struct v2 half_mm[] = {{80.0f, 0.0f},     {170.0f, -20.0f},
					    {175.0f, -110.0f}, {192.0f, -190.0f},
					    {245.0f, -240.0f}, {240.0f, -610.0f}};
	struct sketch top;
	sketch_make(&top, half_mm, COUNT_OF(half_mm), 95.0f);
	visit_draw(hand, &top, (struct v2){-300.0f, 310.0f}, brisk_px_s);
	visit_copy(hand);
	visit_dip(hand, &top, BACK, half_mm[0].x, 25.0f, brisk_px_s);
	hand_tap_target(hand, TARGET_STEP_SEW);
	visit_sew(hand, &top, (struct v2){125.0f, -10.0f});
	visit_sew(hand, &top, (struct v2){240.0f, -430.0f});
	hand_tap_target(hand, TARGET_STEP_MARK);
	visit_mark_body(hand, (struct v2){0.04f, 1.31f}, (struct v2){0.13f, 0.92f}, 1.0f);
	hand_tap_target(hand, TARGET_VIEW_BACK);
	visit_mark_body(hand, (struct v2){-0.04f, 1.38f}, (struct v2){-0.11f, 0.92f}, -1.0f);
	hand_tap_target(hand, TARGET_VIEW_FRONT);
	visit_mark_cloth(hand, &top, FRONT, (struct v2){0.0f, -120.0f}, (struct v2){0.0f, -510.0f});
	visit_mark_cloth(hand, &top, BACK, (struct v2){0.0f, -50.0f}, (struct v2){0.0f, -510.0f});
	visit_say(hand, "marked");
	visit_wrap(hand);
	visit_say(hand, "askew");
	hand_tap_target(hand, TARGET_STEP_ADJUST);
	for (int piece = FRONT; piece <= BACK; piece++) {
		if (piece == BACK)
			hand_tap_target(hand, TARGET_VIEW_BACK);
		for (int stroke = 0; stroke < 2; stroke++) {
			struct v3 hem = visit_place(hand, &top, piece, (struct v2){0.0f, -540.0f});
			float from = visit_angle(hem), half_turn = from > 0.0f ? 180.0f : -180.0f;
			float off = piece == FRONT ? from : from - half_turn;
			if (float_abs(off) > 4.0f) /* a little too far: cloth gives way */
				visit_pull_round(hand, hem.y, from, from - 1.25f * off);
		}
	}
	hand_tap_target(hand, TARGET_VIEW_FRONT);
	hand_leave(hand);
	visit_rest(hand, 3.0f);
	visit_say(hand, "righted");
}

/* ---- */

static const struct {
	const char *name;
	int interval_us; /* between two reports of the tablet */
	void (*visit)(struct hand *hand);
} visits[] = {
	{"tshirt", 5000, visit_tshirt}, {"sleeves", 10000, visit_sleeves},
	{"skirt", 10000, visit_skirt},  {"poncho", 10000, visit_poncho},
	{"askew", 10000, visit_askew},
};

static int find_visit(const char *name)
{
	int at = 0;
	while (at < COUNT_OF(visits) && strcmp(visits[at].name, name) != 0)
		at++;
	return at;
}

int main(int argc, char **argv)
{
	struct kiosk *kiosk = malloc(sizeof *kiosk);
	struct hand *hand = malloc(sizeof *hand);
	void *memory = malloc(KIOSK_MEMORY_BYTES);
	int visit = argc > 2 ? find_visit(argv[1]) : COUNT_OF(visits);
	FILE *tape = visit < COUNT_OF(visits) ? fopen(argv[2], "wb") : NULL;
	if (!kiosk || !hand || !memory || !tape) {
		fprintf(stderr, "usage: hand tshirt|sleeves|skirt|poncho|askew TAPE [SEED]\n");
		return EXIT_FAILURE;
	}
	kiosk_init(kiosk, memory, WIDTH_PX, HEIGHT_PX);
	const char *fault = body_build_mannequin(&kiosk->session.body);
	MUST(!fault);
	body_find_parts(&kiosk->session.body);
	hand_begin(hand, kiosk, tape, visits[visit].interval_us,
		   argc > 3 ? (uint32_t)strtoul(argv[3], NULL, 10) : 1);
	hand_wait(hand, 0.3f);
	visits[visit].visit(hand);
	hand_end(hand);
	fprintf(stderr, "%d frames, hash %016" PRIx64 "\n", kiosk->frame,
		session_hash(&kiosk->session));
	return fclose(tape) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
