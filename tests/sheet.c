/* sheet FOLDER: what a visitor and the operator see, state by state, in Japanese and English, as
 * PNGs and on one sheet (sheet.png). The bundled T-shirt's tape is played once; a state is
 * recognised by what the program is doing, not by the number of a frame. */
#include "picture.h"
#include "replay.h"
#include "station.h"

#include <stdlib.h>
#include <time.h>
#include <unistd.h>

enum { WIDTH = 1920, HEIGHT = 1080, CELL_WIDTH = 640, WAIT_FRAMES = 3000 };

static const char tape_path[] = "tests/tapes/tshirt.hid";
static const char *const language_name[] = {"both", "ja", "en"};
static const struct stick_places no_sticks = {"/nowhere", "/nowhere"};

struct sheet {
	struct station station;
	struct snapshot shot;
	struct contact_sheet contact;
	struct replay replay;
	const char *folder;
	char fault[FAULT_BYTES];
};

static void must(struct sheet *sheet, bool good, const char *what)
{
	if (good)
		return;
	fprintf(stderr, "sheet: %s: %s\n", what, sheet->fault);
	exit(EXIT_FAILURE);
}

/* ---- pictures ---- */

/* What was just drawn. */
static void keep(struct sheet *sheet, const char *state, enum language language)
{
	char path[PATH_BYTES_MAX], name[64], caption[CAPTION_BYTES_MAX];
	struct snapshot *shot = &sheet->shot;
	snprintf(name, sizeof name, "%s-%s.png", state, language_name[language]);
	snprintf(caption, sizeof caption, "%s, %s", state, language_name[language]);
	display_read(shot->display, shot->rgba);
	contact_add(&sheet->contact, shot->width, shot->height, shot->rgba, caption);
	must(sheet,
	     store_join(path, sizeof path, sheet->folder, name, sheet->fault) &&
		     picture_write_png(path, shot->width, shot->height, shot->rgba, sheet->fault),
	     name);
	puts(path);
}

/* The visit as it stands, in each language; what the document is does not depend on that. */
static void keep_frame(struct sheet *sheet, const char *state)
{
	struct kiosk *kiosk = sheet->station.kiosk;
	enum language before = kiosk->ui.language;
	for (int l = LANGUAGE_JAPANESE; l <= LANGUAGE_ENGLISH; l++) {
		kiosk->ui.language = (enum language)l;
		draw_frame(sheet->shot.draw, &kiosk->ui, &kiosk->session);
		keep(sheet, state, (enum language)l);
	}
	kiosk->ui.language = before;
}

static void keep_attract(struct sheet *sheet)
{
	struct kiosk *kiosk = sheet->station.kiosk;
	for (int l = LANGUAGE_JAPANESE; l <= LANGUAGE_ENGLISH; l++) {
		kiosk->ui.language = (enum language)l;
		draw_frame(sheet->shot.draw, &kiosk->ui, &kiosk->session);
		must(sheet, draw_notice(sheet->shot.draw, kiosk->ui.language, 0, 15, sheet->fault),
		     "attract");
		keep(sheet, "attract", kiosk->ui.language);
	}
	draw_notice_end(sheet->shot.draw);
	kiosk->ui.language = LANGUAGE_BOTH;
}

/* ---- the visit ---- */

static bool hints(const struct kiosk *k)
{
	return k->frame > FRAME_RATE_HZ;
}

static bool draws(const struct kiosk *k)
{
	return k->ui.gesture == GESTURE_PIECE;
}

static bool sews(const struct kiosk *k)
{
	return k->ui.gesture == GESTURE_SEW && k->ui.sew_from.piece >= 0;
}

static bool marks(const struct kiosk *k)
{
	return k->ui.gesture == GESTURE_MARK_CLOTH;
}

static bool grows(const struct kiosk *k)
{
	return k->session.job == JOB_WRAP;
}

static bool drags(const struct kiosk *k)
{
	bool pinned = false;
	for (int i = 0; i < PINS_MAX; i++)
		pinned |= k->session.document.pin[i].used;
	return k->ui.gesture == GESTURE_DRAG && pinned;
}

/* In the order of the tape; each is drawn when it has lasted so many frames. */
static const struct {
	const char *name;
	bool (*holds)(const struct kiosk *kiosk);
	int frames;
} states[] = {{"hint", hints, 1},   {"outline", draws, 100}, {"sewing", sews, 15},
	      {"marks", marks, 30}, {"growing", grows, 60},  {"drag-with-pins", drags, 25}};

static void play(struct sheet *sheet)
{
	struct kiosk *kiosk = sheet->station.kiosk;
	int next = 0, lasted = 0;
	for (int frame = 0; frame < sheet->replay.frame_count; frame++) {
		unsigned unplugged = replay_reports(&sheet->replay, frame);
		kiosk_frame(kiosk, sheet->replay.reports, unplugged);
		if (next == COUNT_OF(states))
			continue;
		lasted = states[next].holds(kiosk) ? lasted + 1 : 0;
		if (lasted < states[next].frames)
			continue;
		keep_frame(sheet, states[next++].name);
		lasted = 0;
	}
	snprintf(sheet->fault, FAULT_BYTES, "the tape does not come to it");
	must(sheet, next == COUNT_OF(states), next < COUNT_OF(states) ? states[next].name : "");
	keep_frame(sheet, "worn");
}

static void keep_left_handed(struct sheet *sheet)
{
	struct ui *ui = &sheet->station.kiosk->ui;
	for (int k = 1; k >= 0; k--) {
		ui->left_handed = k;
		layout_make(&ui->layout, WIDTH, HEIGHT, ui->step, ui->left_handed);
		if (k)
			keep_frame(sheet, "left-handed");
	}
}

/* ---- pages ---- */

static void keep_service(struct sheet *sheet)
{
	struct station *station = &sheet->station;
	for (int l = LANGUAGE_JAPANESE; l <= LANGUAGE_ENGLISH; l++) {
		station->kiosk->ui.language = (enum language)l;
		station->board.language = (enum board_language)l;
		station_open_desk(station);
		must(sheet, draw_service(sheet->shot.draw, &station->desk->page, sheet->fault),
		     "operator");
		keep(sheet, "operator", (enum language)l);
		station->desk->open = false;
		draw_service_end(sheet->shot.draw);
	}
	station->kiosk->ui.language = LANGUAGE_BOTH;
}

static void card_frame(struct station *station)
{
	kiosk_frame(station->kiosk, station->reports, 0);
	station_run_card(station);
	if (!station_draw_card(station))
		draw_frame(station->draw, &station->kiosk->ui, &station->kiosk->session);
	station->reports->count = 0;
}

/* The mouse as a pen (mouse_descriptor): a touch of five frames. */
static void tap(struct station *station, struct rect rect)
{
	int x = (2 * rect.x + rect.w) * 32767 / (2 * (WIDTH - 1));
	int y = (2 * rect.y + rect.h) * 32767 / (2 * (HEIGHT - 1));
	for (int i = 0; i < 9; i++) {
		struct raw_report *r = &station->reports->report[station->reports->count++];
		bool tip = i >= 2 && i < 7;
		*r = (struct raw_report){
			.device = LIVE_MOUSE,
			.time_us = (int64_t)station->kiosk->frame * 1000000 / FRAME_RATE_HZ,
			.size = 7,
			.bytes = {(uint8_t)(tip | 4), (uint8_t)x, (uint8_t)(x >> 8), (uint8_t)y,
				  (uint8_t)(y >> 8), 0, tip ? 8 : 0},
		};
		card_frame(station);
	}
}

static void keep_card(struct sheet *sheet)
{
	static const struct timespec rest = {0, 5000000};
	struct station *station = &sheet->station;
	struct take_home_layout layout;
	snprintf(sheet->fault, FAULT_BYTES, "no card came");
	for (int l = LANGUAGE_JAPANESE; l <= LANGUAGE_ENGLISH; l++) {
		station->kiosk->ui.language = (enum language)l;
		tap(station, station->kiosk->ui.layout.target[TARGET_FINISH]);
		for (int i = 0; i < WAIT_FRAMES && station->card.page.station != KEPT; i++) {
			card_frame(station);
			nanosleep(&rest, NULL);
		}
		must(sheet, station->card.page.station == KEPT, "take-home");
		card_frame(station);
		keep(sheet, "take-home", (enum language)l);
		take_home_layout(&layout, &station->kiosk->ui.layout);
		tap(station, layout.key[TAKE_HOME_BACK]);
		for (int i = 0; i < WAIT_FRAMES && station->card.home; i++) {
			card_frame(station);
			nanosleep(&rest, NULL);
		}
	}
	station->kiosk->ui.language = LANGUAGE_BOTH;
}

/* The line that the back's is to meet, on the chest and upside down: marks that the seams
 * contradict, dressed from the beginning. */
static void keep_diagnosis(struct sheet *sheet)
{
	struct kiosk *kiosk = sheet->station.kiosk;
	struct marks *marks = &kiosk->session.document.marks;
	for (int m = 0; m < MARKS_MAX; m++)
		for (int i = 0; marks->body[m].number == 2 && i < marks->body[m].point_count; i++)
			marks->body[m].point_m[i] = (struct v3){0, 1.0f + 0.02f * (float)i, 0.2f};
	kiosk->session.cloth.worn = false;
	tap(&sheet->station, kiosk->ui.layout.target[TARGET_WRAP]);
	must(sheet, kiosk->session.job != JOB_NONE, "diagnosis");
	for (int i = 0; i < WAIT_FRAMES && kiosk->session.job != JOB_NONE; i++)
		kiosk_frame(kiosk, sheet->replay.reports, 0);
	keep_frame(sheet, "diagnosis");
}

/* ---- the whole ---- */

static bool open_station(struct sheet *sheet)
{
	struct station *station = &sheet->station;
	struct replay *replay = &sheet->replay;
	station->journal = -1;
	station->kind = DISPLAY_WINDOW;
	station->board = station->base = board_default;
	station->width = WIDTH;
	station->height = HEIGHT;
	station->sticks = &no_sticks;
	station->memory = malloc(KIOSK_MEMORY_BYTES);
	station->kiosk = replay->kiosk = calloc(1, sizeof *station->kiosk);
	station->reports = replay->reports = calloc(1, sizeof *station->reports);
	station->desk = calloc(1, sizeof *station->desk);
	if (!station->memory || !station->kiosk || !station->reports || !station->desk)
		return false;
	kiosk_init(station->kiosk, station->memory, WIDTH, HEIGHT);
	if (body_build_mannequin(&station->kiosk->session.body))
		return false;
	body_find_parts(&station->kiosk->session.body);
	return true;
}

int main(int argc, char **argv)
{
	static struct sheet sheet;
	struct station *station = &sheet.station;
	char path[PATH_BYTES_MAX];
	if (argc != 2) {
		fputs("usage: sheet FOLDER\n", stderr);
		return 2;
	}
	sheet.folder = argv[1];
	sheet.replay.tape_path = tape_path;
	snprintf(sheet.fault, FAULT_BYTES, "not enough memory");
	must(&sheet, open_station(&sheet), "station");
	must(&sheet, store_make_folder(sheet.folder, sheet.fault), sheet.folder);
	must(&sheet, snapshot_open(&sheet.shot, WIDTH, HEIGHT, sheet.fault), "pictures");
	must(&sheet, replay_load(&sheet.replay), sheet.replay.fault);
	snprintf(station->folder, sizeof station->folder, "%s/cards", sheet.folder);
	station->display = sheet.shot.display;
	station->draw = sheet.shot.draw;
	display_ready(station->display);
	station->opened_us = live_clock_us();
	int cells = 2 * (COUNT_OF(states) + 5);
	must(&sheet, contact_open(&sheet.contact, cells, WIDTH, HEIGHT, CELL_WIDTH), "sheet.png");
	if (sheet.replay.tape.budget_units > 0)
		station->kiosk->session.budget_units = sheet.replay.tape.budget_units;
	replay_learn(&sheet.replay, &station->kiosk->pen);
	keep_attract(&sheet);
	play(&sheet);
	keep_left_handed(&sheet);
	keep_service(&sheet);
	pen_describe(&station->kiosk->pen, LIVE_MOUSE, mouse_descriptor, mouse_descriptor_size);
	keep_card(&sheet);
	keep_diagnosis(&sheet);
	must(&sheet,
	     store_join(path, sizeof path, sheet.folder, "sheet.png", sheet.fault) &&
		     contact_finish(&sheet.contact, path, sheet.fault),
	     "sheet.png");
	puts(path);
	snapshot_close(&sheet.shot);
	tape_free(&sheet.replay.tape);
	free(station->desk);
	free(station->reports);
	free(station->kiosk);
	free(station->memory);
	return 0;
}
