/* Board files: the documented text gives the defaults, every key is read, faults name their line.
 */
#include "board.h"
#include "test.h"

static bool read_text(struct board *board, const char *text, char fault[200])
{
	return board_read(board, text, strlen(text), fault);
}

static bool same(const struct board *a, const struct board *b)
{
	bool lines = true;
	for (int i = 0; i < BUTTON_COUNT; i++)
		lines &= !strcmp(a->button_line[i], b->button_line[i]);
	return lines && a->display_width_mm == b->display_width_mm &&
	       a->display_height_mm == b->display_height_mm && a->rotation == b->rotation &&
	       a->button_active_low == b->button_active_low && a->budget_units == b->budget_units &&
	       a->threads == b->threads && a->thread_cpus == b->thread_cpus &&
	       !memcmp(a->thread_cpu, b->thread_cpu, sizeof a->thread_cpu) &&
	       a->idle_s == b->idle_s && a->language == b->language &&
	       a->tablet_vendor == b->tablet_vendor && a->tablet_product == b->tablet_product &&
	       a->tablet_width_mm == b->tablet_width_mm &&
	       a->tablet_height_mm == b->tablet_height_mm && a->mount.degrees == b->mount.degrees &&
	       a->mount.display == b->mount.display && a->display_auto == b->display_auto &&
	       a->mount.cross_count == b->mount.cross_count;
}

static void check_defaults(void)
{
	struct board board;
	char fault[200];
	CHECK(read_text(&board, board_text, fault) && same(&board, &board_default));
	CHECK(read_text(&board, "", fault) && same(&board, &board_default));
}

static void check_keys(void)
{
	struct board board;
	char fault[200];
	CHECK(read_text(
		&board,
		"display_mm = 344.2 194\r\n\trotation=270 # turned\nwrap = GPIO17\npin=none\n"
		"relax = GPIO 27\nactive_low = no\nbudget = 250000\nidle_s = 0\n"
		"threads = 4\nthread_cpus = 5 6 7\n"
		"language = ja\ntablet = 256C:006d\ntablet_mm = 254 158.75\n"
		"tablet_rotation = 180\npen_display = yes\n"
		"calibration = 102.5 51 100 50 1797 52 1800 50 101 1049 100 1050 1799 1052.25 1800 "
		"1050",
		fault));
	CHECK_NEAR(board.display_width_mm, 344.2, 1e-3);
	CHECK_NEAR(board.display_height_mm, 194.0, 0.0);
	CHECK(board.rotation == 270 && !board.button_active_low && board.budget_units == 250000);
	CHECK(!strcmp(board.button_line[BUTTON_WRAP], "GPIO17"));
	CHECK(!strcmp(board.button_line[BUTTON_PIN], ""));
	CHECK(!strcmp(board.button_line[BUTTON_RELAX], "GPIO 27"));
	CHECK(board.threads == 4 && board.thread_cpus == 3 && board.thread_cpu[2] == 7);
	CHECK(board.idle_s == 0 && board.language == BOARD_JAPANESE);
	CHECK(board.tablet_vendor == 0x256c && board.tablet_product == 0x6d);
	CHECK_NEAR(board.tablet_height_mm, 158.75, 1e-3);
	CHECK(board.mount.degrees == 180 && board.mount.display && board.mount.cross_count == 4);
	CHECK(!board.display_auto);
	CHECK(board.mount.cross[0].seen_x == 10250 && board.mount.cross[3].seen_y == 105225);
	CHECK(board.mount.cross[3].meant_y == 105000 && board.calibration_worst_px < 0.1f);
	CHECK(read_text(&board, "pen_display = no\n", fault) && !board.display_auto);
	CHECK(!board.mount.display);
	CHECK(board.crosses_asked == 9);
	CHECK(read_text(&board, "calibration_crosses = 16\n", fault) && board.crosses_asked == 16);
}

static void check_faults(void)
{
	static const struct {
		const char *text, *fault;
	} cases[] = {
		{"rotation = 45", "line 1: rotation = 45; give 0, 90"},
		{"\n# a\nrotate = 90", "line 3: rotate = 90; unknown key"},
		{"rotation", "line 1: a line reads like"},
		{"= 90", "line 1:  = 90; unknown key"},
		{"rotation =", "line 1: a line reads like"},
		{"rotation = 0\nrotation = 90", "line 2: rotation = 90; this key stands above"},
		{"display_mm = 344", "line 1: display_mm = 344; give width"},
		{"display_mm = 344 194 3", "line 1: display_mm"},
		{"display_mm = -344 194", "line 1: display_mm"},
		{"display_mm = 9 9", "line 1: display_mm"},
		{"display_mm = nan nan", "line 1: display_mm"},
		{"idle_s = 1.5", "line 1: idle_s = 1.5; give a whole number from 0 to 86400"},
		{"idle_s = 99999999999", "line 1: idle_s"},
		{"budget = lots", "line 1: budget"},
		{"threads = 0", "line 1: threads = 0; give a whole number from 1 to 8"},
		{"thread_cpus = 1 2.5", "line 1: thread_cpus = 1 2.5; give processors' numbers"},
		{"thread_cpus = 1 2 3 4 5 6 7 8", "line 1: thread_cpus"},
		{"thread_cpus = 1 any", "line 1: thread_cpus"},
		{"active_low = maybe", "line 1: active_low = maybe; give yes or no"},
		{"language = de", "line 1: language = de; give both, ja or en"},
		{"service_pin = 123", "line 1: service_pin = 123; give 4 to 8 digits"},
		{"service_pin = 123456789", "line 1: service_pin"},
		{"service_pin = 12a4", "line 1: service_pin"},
		{"tablet = 256c", "line 1: tablet = 256c; give vendor"},
		{"tablet = 256c:006dx", "line 1: tablet"},
		{"tablet_rotation = 45", "line 1: tablet_rotation = 45; give 0, 90"},
		{"calibration_crosses = 10", "line 1: calibration_crosses = 10; give 4, 9, 16"},
		{"calibration_crosses = 04", "line 1: calibration_crosses"},
		{"calibration = 1 1 1 1", "line 1: calibration = 1 1 1 1; 1 points: give 4"},
		{"calibration = 1 1 1", "line 1: calibration = 1 1 1; give four numbers"},
		{"calibration = 0 0 0 0 1 1 1 1 2 2 2 2 3 3 3 3", "line 1: calibration"},
		{"pin = wrap", "line 1: wrap and pin have the same GPIO line"},
		{"pin = a\001b", "line 1: a line reads like"},
		{"pin = 1234567890123456789012345678901234567890123456789012345678901234567890",
		 "line 1: pin"},
	};
	for (int i = 0; i < COUNT_OF(cases); i++) {
		struct board board;
		char fault[200];
		bool sound = read_text(&board, cases[i].text, fault);
		if (sound || strncmp(fault, cases[i].fault, strlen(cases[i].fault))) {
			fprintf(stderr, "case %d: %s, expected \"%s\"\n", i,
				sound ? "was read" : fault, cases[i].fault);
			test_failures++;
		}
		CHECK(same(&board, &board_default));
	}
}

/* What is set at the station lies over the file, all 25 crosses of it, and a fault changes nothing.
 */
static void check_over(void)
{
	struct board base, now, again;
	char text[BOARD_OVER_MAX], fault[200];
	CHECK(read_text(&base, "service_pin = 00420\nidle_s = 90\nbudget = 250000", fault));
	CHECK(!strcmp(base.service_pin, "00420"));
	now = again = base;
	now.idle_s = 0;
	now.language = BOARD_JAPANESE;
	now.mount.degrees = 180;
	now.mount.cross_count = PLANE_MAP_POINTS_MAX;
	for (int i = 0; i < PLANE_MAP_POINTS_MAX; i++) {
		int x = 1638399 - 300000 * (i % 5), y = 1638305 - 300000 * (i / 5);
		now.mount.cross[i] = (struct pen_cross){x, y, x - 105, y - 7};
	}
	int size = board_write_over(&base, &now, text);
	CHECK(size > 0 && size < BOARD_OVER_MAX && !text[size]);
	CHECK(board_read_over(&again, text, (size_t)size, fault));
	CHECK(again.idle_s == 0 && again.language == BOARD_JAPANESE && again.mount.degrees == 180);
	CHECK(again.budget_units == 250000 && !strcmp(again.service_pin, "00420"));
	CHECK(again.mount.cross_count == PLANE_MAP_POINTS_MAX &&
	      !memcmp(again.mount.cross, now.mount.cross, sizeof now.mount.cross));
	again = base;
	CHECK(!board_read_over(&again, "idle_s = 7\nidle_s = x", 21, fault));
	CHECK(again.idle_s == 90);
}

int main(void)
{
	check_defaults();
	check_keys();
	check_faults();
	check_over();
	return test_end();
}
