/* The card at the station, from the pen on the button to files in a folder and on a stick: raw
 * reports, the page, the thread, sticks of all kinds. KITSUKE_PICTURES=DIR keeps pictures. */
#include "leaks.h"
#include "picture.h"
#include "scene.h"
#include "snapshot.h"
#include "station.h"
#include "test.h"
#include "text.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <time.h>
#include <unistd.h>

enum { WIDTH = 1920, HEIGHT = 1080, WAIT_FRAMES = 3000 };

struct bench {
	struct station station;
	struct snapshot shot;
	struct stick_places places;
	char folder[TEST_FOLDER_BYTES], data[TEST_FOLDER_BYTES + 20], stick[TEST_FOLDER_BYTES + 20],
		mounts[TEST_FOLDER_BYTES + 20], devices[TEST_FOLDER_BYTES + 20];
};

/* ---- storage that fails: the linker sends our calls here ---- */

static atomic_int open_fault, write_fault, sync_fault; /* errno for what lies on the stick */
static char stick_path[220];

ssize_t __real_write(int fd, const void *bytes, size_t size);
ssize_t __wrap_write(int fd, const void *bytes, size_t size);
int __real_open(const char *path, int flags, ...);
int __wrap_open(const char *path, int flags, ...);
int __real_fsync(int fd);
int __wrap_fsync(int fd);

static bool on_stick(int fd)
{
	char link[64], path[300];
	snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
	ssize_t size = readlink(link, path, sizeof path - 1);
	path[size > 0 ? size : 0] = 0;
	return stick_path[0] && strncmp(path, stick_path, strlen(stick_path)) == 0;
}

/* Half of it is written before the fault. */
ssize_t __wrap_write(int fd, const void *bytes, size_t size)
{
	int fault = write_fault;
	if (!fault || !on_stick(fd))
		return __real_write(fd, bytes, size);
	if (size > 64)
		return __real_write(fd, bytes, size / 2 > 4096 ? 4096 : 64);
	errno = fault;
	return -1;
}

int __wrap_open(const char *path, int flags, ...)
{
	va_list list;
	va_start(list, flags);
	int mode = flags & O_CREAT ? va_arg(list, int) : 0;
	va_end(list);
	int fault = open_fault;
	if (fault && (flags & O_CREAT) && strncmp(path, stick_path, strlen(stick_path)) == 0) {
		errno = fault;
		return -1;
	}
	return __real_open(path, flags, mode);
}

int __wrap_fsync(int fd)
{
	int fault = sync_fault;
	if (!fault || !on_stick(fd))
		return __real_fsync(fd);
	errno = fault;
	return -1;
}

/* ---- a stick that the kernel is said to have mounted ---- */

static void write_text(const char *path, const char *text)
{
	FILE *file = fopen(path, "w");
	CHECK(file);
	if (file) {
		fputs(text, file);
		fclose(file);
	}
}

static void plug(struct bench *bench, bool in)
{
	char text[1024];
	struct stat status;
	stat(bench->stick, &status);
	snprintf(text, sizeof text,
		 "20 1 8:2 / / rw,relatime shared:1 - ext4 /dev/sda2 rw\n"
		 "25 20 0:22 / /proc rw - proc proc rw\n"
		 "30 20 8:3 / /var rw - ext4 /dev/sda3 rw\n");
	if (in)
		snprintf(text + strlen(text), sizeof text - strlen(text),
			 "31 20 %u:%u / %s rw,nosuid - vfat /dev/sdb1 rw\n", major(status.st_dev),
			 minor(status.st_dev), bench->stick);
	char part[260];
	snprintf(part, sizeof part, "%s.part", bench->mounts);
	write_text(part, text);
	rename(part, bench->mounts);
}

/* sysfs: sda is the system's own and removable too (a station that runs from a card), sdb the
 * stick. */
static void make_devices(struct bench *bench)
{
	char command[2000];
	struct stat status;
	stat(bench->stick, &status);
	snprintf(command, sizeof command,
		 "cd %s && mkdir -p dev/block block/sda/sda2 block/sda/sda3 block/sdb/sdb1 && "
		 "for p in sda/sda2 sda/sda3 sdb/sdb1; do echo 1 > block/$p/partition; done && "
		 "echo 1 > block/sda/removable && echo 1 > block/sdb/removable && "
		 "ln -s ../../block/sda/sda2 dev/block/8:2 && "
		 "ln -s ../../block/sda/sda3 dev/block/8:3 && "
		 "ln -s ../../block/sdb/sdb1 dev/block/%u:%u",
		 bench->folder, major(status.st_dev), minor(status.st_dev));
	CHECK(system(command) == 0);
}

/* ---- the station ---- */

static void report(struct station *station, struct v2 px, bool tip)
{
	struct raw_report *r = &station->reports->report[station->reports->count++];
	int x = (int)(px.x / (float)(WIDTH - 1) * 32767.0f + 0.5f);
	int y = (int)(px.y / (float)(HEIGHT - 1) * 32767.0f + 0.5f);
	memset(r, 0, sizeof *r);
	r->device = LIVE_MOUSE;
	r->time_us = (int64_t)station->kiosk->frame * 1000000 / FRAME_RATE_HZ;
	r->size = 7;
	r->bytes[0] = (uint8_t)(tip | 4);
	r->bytes[1] = (uint8_t)x;
	r->bytes[2] = (uint8_t)(x >> 8);
	r->bytes[3] = (uint8_t)y;
	r->bytes[4] = (uint8_t)(y >> 8);
	r->bytes[6] = tip ? 8 : 0;
}

static bool frame(struct bench *bench)
{
	struct station *station = &bench->station;
	kiosk_frame(station->kiosk, station->reports, 0);
	bool done = station_run_card(station);
	if (!station_draw_card(station))
		draw_frame(station->draw, &station->kiosk->ui, &station->kiosk->session);
	station->reports->count = 0;
	return done;
}

static bool tap(struct bench *bench, struct rect rect)
{
	struct v2 px = {(float)rect.x + 0.5f * (float)rect.w, (float)rect.y + 0.5f * (float)rect.h};
	bool done = false;
	CHECK(rect.w > 0);
	for (int i = 0; i < 9; i++) {
		report(&bench->station, px, i >= 2 && i < 7);
		done |= frame(bench);
	}
	return done;
}

static void picture(struct bench *bench, const char *name)
{
	const char *folder = getenv("KITSUKE_PICTURES");
	char path[PATH_BYTES_MAX], fault[FAULT_BYTES];
	display_read(bench->shot.display, bench->shot.rgba);
	if (folder && store_join(path, sizeof path, folder, name, fault))
		CHECK(picture_write_png(path, WIDTH, HEIGHT, bench->shot.rgba, fault));
}

static struct take_home_page *page_of(struct bench *bench)
{
	return &bench->station.card.page;
}

/* Frames until the place says so; the thread works meanwhile. */
static bool wait_for(struct bench *bench, const enum kept *place, enum kept kept)
{
	static const struct timespec rest = {0, 5000000};
	for (int i = 0; i < WAIT_FRAMES && (*place != kept || !page_of(bench)->ready); i++) {
		frame(bench);
		nanosleep(&rest, NULL);
	}
	if (*place != kept)
		fprintf(stderr, "the page says %d, not %d\n", *place, kept);
	return *place == kept;
}

static void press_finish(struct bench *bench)
{
	tap(bench, bench->station.kiosk->ui.layout.target[TARGET_FINISH]);
	CHECK(bench->station.kiosk->ui.take_home.open);
}

static void press_key(struct bench *bench, enum take_home_key key, bool *done)
{
	struct take_home_layout layout;
	take_home_layout(&layout, &bench->station.kiosk->ui.layout);
	*done = tap(bench, layout.key[key]);
}

static void back_to_play(struct bench *bench)
{
	static const struct timespec rest = {0, 5000000};
	bool done;
	press_key(bench, TAKE_HOME_BACK, &done);
	CHECK(!done && !bench->station.kiosk->ui.take_home.open);
	for (int i = 0; i < WAIT_FRAMES && bench->station.card.home; i++) {
		frame(bench);
		nanosleep(&rest, NULL);
	}
	CHECK(!bench->station.card.home);
}

/* Files of a folder whose names end so; *last: one of them. */
static int files(const char *folder, const char *ending, char last[600])
{
	int count = 0;
	DIR *all = opendir(folder);
	for (struct dirent *entry; all && (entry = readdir(all));) {
		size_t size = strlen(entry->d_name), end = strlen(ending);
		if (size < end || strcmp(entry->d_name + size - end, ending) != 0)
			continue;
		snprintf(last, 600, "%s/%s", folder, entry->d_name);
		count++;
	}
	if (all)
		closedir(all);
	return count;
}

/* What lies on the stick but the finished cards. */
static int leftovers(const struct bench *bench)
{
	char folder[300], last[600];
	snprintf(folder, sizeof folder, "%s/kitsuke", bench->stick);
	int part = 0;
	DIR *all = opendir(folder);
	for (struct dirent *entry; all && (entry = readdir(all));)
		part += strstr(entry->d_name, ".part") != NULL;
	if (all)
		closedir(all);
	return part + (files(folder, ".png", last) != files(folder, ".kitsuke", last));
}

/* ---- the cases ---- */

static void nothing_to_take(struct bench *bench)
{
	struct ui *ui = &bench->station.kiosk->ui;
	tap(bench, ui->layout.target[TARGET_FINISH]);
	CHECK(!ui->take_home.open && ui->notice == TEXT_NOTHING);
}

static void wear(struct bench *bench)
{
	static struct scene scene; /* only its journal reader */
	static char line[JOURNAL_LINE_MAX];
	struct session *session = &bench->station.kiosk->session;
	char fault[160];
	FILE *file = fopen("tests/journals/tank-top.kitsuke", "r");
	CHECK(file);
	while (file && fgets(line, sizeof line, file))
		if (journal_read(line, (int)strlen(line), &scene.edit, fault) == JOURNAL_EDIT &&
		    scene.edit.kind != EDIT_STEP)
			session_apply(session, &scene.edit);
	fclose(file);
	for (int i = 0; i < 2000 && session->job != JOB_NONE; i++)
		session_advance(session);
	CHECK(session->cloth.worn);
}

static bool same_file(const char *a, const char *b)
{
	size_t one, other;
	char fault[FAULT_BYTES], *x = store_read(a, &one, fault), *y = store_read(b, &other, fault);
	bool same = x && y && one == other && !memcmp(x, y, one);
	free(x);
	free(y);
	return same;
}

/* The card's PNG carries the very content that the session has. */
static void card_is_the_visit(struct bench *bench, const char *path)
{
	static struct code_content content, read;
	char fault[FAULT_BYTES], wrong[CODE_FAULT_BYTES];
	size_t size, text_size = 0;
	char *png = store_read(path, &size, fault);
	const char *text = png ? code_in_png(png, size, &text_size, wrong) : NULL;
	CHECK(text && code_read(&read, text, text_size, wrong));
	content_take(&content, &bench->station.kiosk->session.document, true, "mannequin");
	CHECK(read.piece_count == content.piece_count && read.seam_count == content.seam_count &&
	      read.cloth_count == content.cloth_count && read.wrapped);
	for (int p = 0; p < content.piece_count; p++)
		CHECK(!memcmp(content.pattern.piece[p].point_mm, read.pattern.piece[p].point_mm,
			      (size_t)content.pattern.piece[p].point_count * sizeof(struct v2)));
	free(png);
}

static void kept_here_and_there(struct bench *bench)
{
	char here[600], there[600], folder[300], drawn[600] = "";
	uint64_t pieces = bench->station.kiosk->session.document.worn_as.pattern;
	press_finish(bench);
	picture(bench, "making.png");
	CHECK(wait_for(bench, &page_of(bench)->station, KEPT));
	CHECK(page_of(bench)->stick == KEPT_NOT && page_of(bench)->qr_modules > 0);
	frame(bench);
	picture(bench, "no-stick.png");
	CHECK(files(bench->data, ".png", here) == 1);
	card_is_the_visit(bench, here);
	plug(bench, true); /* while the page is open */
	CHECK(wait_for(bench, &page_of(bench)->stick, KEPT));
	frame(bench);
	picture(bench, "saved.png");
	snprintf(folder, sizeof folder, "%s/kitsuke", bench->stick);
	CHECK(files(folder, ".png", there) == 1 && same_file(here, there));
	CHECK(files(folder, ".kitsuke", there) == 1 && leftovers(bench) == 0);
	CHECK(files(bench->data, ".kitsuke", drawn) == 1 && same_file(drawn, there));
	back_to_play(bench);
	CHECK(bench->station.kiosk->session.document.worn_as.pattern == pieces);
	frame(bench);
	picture(bench, "back.png");
}

/* The visit's journal comes along to its last frame, those included that it does not say yet. */
static void journal_is_whole(struct bench *bench)
{
	static const char begun[] = "kitsuke-journal 1\nbody mannequin\n";
	struct station *station = &bench->station;
	char fault[FAULT_BYTES], line[64], name[KEPT_NAME_BYTES], path[600];
	size_t size = 0;
	snprintf(station->journal_path, sizeof station->journal_path, "%s/visit.kitsuke",
		 bench->folder);
	write_text(station->journal_path, begun);
	station->journal = 0; /* there is one; nobody writes to it here */
	press_finish(bench);
	int before = station->kiosk->steps;
	CHECK(wait_for(bench, &page_of(bench)->station, KEPT));
	snprintf(name, sizeof name, "%s", page_of(bench)->name);
	strcpy(strrchr(name, '.'), ".kitsuke");
	snprintf(path, sizeof path, "%s/%.63s", bench->data, name);
	char *text = store_read(path, &size, fault);
	int steps = 0;
	CHECK(text && strncmp(text, begun, strlen(begun)) == 0);
	CHECK(text && sscanf(text + strlen(begun), "%63s %d", line, &steps) == 2);
	CHECK(strcmp(line, "step") == 0 && steps >= before && steps <= station->kiosk->steps);
	free(text);
	station->journal = -1;
	back_to_play(bench);
}

/* Each fault of a stick: its word on the page, nothing half on it, and what was there is there. */
static void sticks_fail(struct bench *bench)
{
	static const struct {
		atomic_int *fault;
		int number;
		enum kept says;
		const char *name;
	} cases[] = {{&write_fault, ENOSPC, KEPT_FULL, "full.png"},
		     {&open_fault, EROFS, KEPT_READ_ONLY, "read-only.png"},
		     {&write_fault, EIO, KEPT_PULLED, "pulled.png"},
		     {&sync_fault, EIO, KEPT_PULLED, "pulled-late.png"}};
	char folder[300], last[600];
	snprintf(folder, sizeof folder, "%s/kitsuke", bench->stick);
	for (int i = 0; i < COUNT_OF(cases); i++) {
		int before = files(folder, ".png", last), here = files(bench->data, ".png", last);
		*cases[i].fault = cases[i].number;
		press_finish(bench);
		CHECK(wait_for(bench, &page_of(bench)->stick, cases[i].says));
		CHECK(page_of(bench)->station == KEPT);
		CHECK(files(bench->data, ".png", last) == here + 1);
		CHECK(files(folder, ".png", last) == before && leftovers(bench) == 0);
		frame(bench);
		picture(bench, cases[i].name);
		*cases[i].fault = 0; /* another one, or the same plugged in again */
		plug(bench, false);
		nanosleep(&(struct timespec){1, 0}, NULL);
		plug(bench, true);
		CHECK(wait_for(bench, &page_of(bench)->stick, KEPT));
		CHECK(files(folder, ".png", last) == before + 1 && leftovers(bench) == 0);
		back_to_play(bench);
	}
}

/* Only what is mounted from a removable disk that the system does not run from is a stick. */
static void sticks_are_found(struct bench *bench)
{
	static struct stick stick[STICKS_MAX];
	plug(bench, true);
	CHECK(stick_find(&bench->places, stick) == 1 && !strcmp(stick[0].mount, bench->stick));
	CHECK(stick_present(&stick[0]));
	stick[0].minor++;
	CHECK(!stick_present(&stick[0])); /* the folder is there, the stick is another */
	plug(bench, false);
	CHECK(stick_find(&bench->places, stick) == 0);
	static const struct stick_places nowhere = {"/nowhere", "/nowhere"};
	CHECK(stick_find(&nowhere, stick) == 0);
	stick_find(&stick_places_kernel, stick); /* whatever is here: no fault */
}

static void the_next_one_comes(struct bench *bench)
{
	bool done;
	press_finish(bench);
	CHECK(wait_for(bench, &page_of(bench)->station, KEPT));
	press_key(bench, TAKE_HOME_LEAVE, &done);
	CHECK(done);
	/* as when nobody came back to it: a visit begins, and the page goes with the old one */
	press_finish(bench);
	for (int i = 0; i < 3; i++)
		frame(bench);
	kiosk_init(bench->station.kiosk, bench->station.memory, WIDTH, HEIGHT);
	CHECK(!station_run_card(&bench->station) && !station_draw_card(&bench->station));
	CHECK(bench->station.card.phase == CARD_NONE);
	station_close_card(&bench->station);
	CHECK(!bench->station.card.home);
}

static bool bench_open(struct bench *bench)
{
	struct station *station = &bench->station;
	char fault[FAULT_BYTES];
	test_folder(bench->folder);
	station->journal = -1;
	station->kind = DISPLAY_WINDOW;
	station->board = station->base = board_default;
	snprintf(station->board.station, sizeof station->board.station, "%s",
		 "着付けステーション 1");
	station->width = WIDTH;
	station->height = HEIGHT;
	station->memory = malloc(KIOSK_MEMORY_BYTES);
	station->kiosk = calloc(1, sizeof *station->kiosk);
	station->reports = calloc(1, sizeof *station->reports);
	station->desk = calloc(1, sizeof *station->desk);
	if (!station->memory || !station->kiosk || !station->reports || !station->desk ||
	    !snapshot_open(&bench->shot, WIDTH, HEIGHT, fault))
		return false;
	snprintf(bench->data, sizeof bench->data, "%s/data", bench->folder);
	snprintf(bench->stick, sizeof bench->stick, "%s/stick", bench->folder);
	snprintf(bench->mounts, sizeof bench->mounts, "%s/mountinfo", bench->folder);
	snprintf(bench->devices, sizeof bench->devices, "%s/dev/block", bench->folder);
	mkdir(bench->stick, 0777);
	snprintf(stick_path, sizeof stick_path, "%s", bench->stick);
	make_devices(bench);
	bench->places = (struct stick_places){bench->mounts, bench->devices};
	station->sticks = &bench->places;
	snprintf(station->folder, sizeof station->folder, "%s", bench->data);
	kiosk_init(station->kiosk, station->memory, WIDTH, HEIGHT);
	body_build_mannequin(&station->kiosk->session.body);
	body_find_parts(&station->kiosk->session.body);
	pen_describe(&station->kiosk->pen, LIVE_MOUSE, mouse_descriptor, mouse_descriptor_size);
	station->display = bench->shot.display;
	station->draw = bench->shot.draw;
	station->kiosk->ui.language = LANGUAGE_BOTH;
	return true;
}

int main(void)
{
	static struct bench bench;
	char command[300];
	if (!bench_open(&bench)) {
		printf("no pictures can be made here\n");
		return 77;
	}
	sticks_are_found(&bench);
	nothing_to_take(&bench);
	wear(&bench);
	kept_here_and_there(&bench);
	journal_is_whole(&bench);
	sticks_fail(&bench);
	the_next_one_comes(&bench);
	snprintf(command, sizeof command, "rm -rf %s", bench.folder);
	CHECK(system(command) == 0);
	snapshot_close(&bench.shot);
	free(bench.station.desk);
	free(bench.station.reports);
	free(bench.station.kiosk);
	free(bench.station.memory);
	return test_end();
}
