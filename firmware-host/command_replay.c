/* kitsuke replay TAPE...: recorded raw input, headless, through the very code the station runs. */
#include "commands.h"

#include "character.h"
#include "garment_file.h"
#include "options.h"
#include "replay.h"
#include "threads.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum {
	PICTURES_WANTED = 24, /* where --pictures-every does not say */
	CELL_WIDTH = 480,
	PROGRESS_FRAMES = 30,
};

static const char usage[] =
	"usage: kitsuke replay TAPE... --out DIR [--no-pictures] [--pictures-every FRAMES]\n"
	"                      [--body FILE|mannequin] [--jitter-mm N] [--seed N] [--threads N]\n"
	"       kitsuke replay TAPE... --samples [--descriptor FILE]\n";

static int complain(const struct replay *replay, int status)
{
	fprintf(stderr, "kitsuke replay: %s\n", replay->fault);
	return status;
}

/* ---- start ---- */

static bool start_kiosk(struct replay *replay)
{
	char note[FAULT_BYTES];
	struct kiosk *kiosk = replay->kiosk;
	const char *name = replay->body ? replay->body : CHARACTER_MANNEQUIN;
	kiosk_init(kiosk, replay->memory, replay->tape.width_px, replay->tape.height_px);
	kiosk->session.cloth.crew = replay->crew;
	if (!character_load(&kiosk->session.body, name, NULL, note, replay->fault))
		return false;
	if (note[0])
		fprintf(stderr, "kitsuke replay: note: %s\n", note);
	if (replay->tape.budget_units > 0)
		kiosk->session.budget_units = replay->tape.budget_units;
	kiosk_body_named(kiosk, store_name(name));
	replay_learn(replay, &kiosk->pen);
	jitter_init(&replay->jitter, (float)replay->jitter_mm, (uint32_t)replay->seed);
	return true;
}

static bool open_pictures(struct replay *replay)
{
	if (replay->no_pictures)
		return true;
	if (replay->pictures_every == 0)
		replay->pictures_every = int_max(1, replay->frame_count / PICTURES_WANTED);
	long count = replay->frame_count / replay->pictures_every + 2;
	if (!snapshot_open(&replay->snapshot, replay->tape.width_px, replay->tape.height_px,
			   replay->fault))
		return false;
	int sheet = count < CONTACT_FRAMES_MAX ? (int)count : CONTACT_FRAMES_MAX;
	if (contact_open(&replay->contact, sheet, replay->snapshot.width, replay->snapshot.height,
			 CELL_WIDTH))
		return true;
	snprintf(replay->fault, FAULT_BYTES, "not enough memory for the contact sheet");
	return false;
}

/* ---- the run ---- */

static void show_progress(const struct replay *replay, int frame)
{
	bool last = frame == replay->frame_count;
	if (replay->progress && (last || frame % PROGRESS_FRAMES == 0))
		fprintf(stderr, "\r%s: frame %d of %d%s", store_name(replay->tape_path), frame,
			replay->frame_count, last ? "\n" : "");
}

static bool take_picture(struct replay *replay, int frame)
{
	char path[PATH_BYTES_MAX], name[64], caption[CAPTION_BYTES_MAX];
	struct snapshot *shot = &replay->snapshot;
	const struct session *session = &replay->kiosk->session;
	snprintf(name, sizeof name, "frame-%06d.png", frame);
	snprintf(caption, sizeof caption, "%d.%02d s  %s", frame / FRAME_RATE_HZ,
		 frame % FRAME_RATE_HZ * 100 / FRAME_RATE_HZ,
		 replay->last_word ? replay->last_word : "");
	snapshot_take(shot, &replay->kiosk->ui, session);
	contact_add(&replay->contact, shot->width, shot->height, shot->rgba, caption);
	return store_join(path, sizeof path, replay->out, name, replay->fault) &&
	       picture_write_png(path, shot->width, shot->height, shot->rgba, replay->fault);
}

static bool run_frame(struct replay *replay, int frame)
{
	struct kiosk *kiosk = replay->kiosk;
	unsigned unplugged = replay_reports(replay, frame);
	frame_clock_begin(&replay->clock, &kiosk->session);
	kiosk_frame(kiosk, replay->reports, unplugged);
	frame_clock_end(&replay->clock, &kiosk->session);
	if (kiosk->edits.count > 0)
		replay->last_word = edit_word[kiosk->edits.item[kiosk->edits.count - 1].kind];
	fwrite(kiosk->journal, 1, (size_t)kiosk->journal_size, replay->journal);
	show_progress(replay, frame + 1);
	bool last = frame + 1 == replay->frame_count;
	if (replay->no_pictures || (!last && (frame + 1) % replay->pictures_every != 0))
		return true;
	return take_picture(replay, frame + 1);
}

static bool run(struct replay *replay)
{
	fputs(JOURNAL_HEADER, replay->journal);
	for (int frame = 0; frame < replay->frame_count; frame++)
		if (!run_frame(replay, frame))
			return false;
	kiosk_finish(replay->kiosk);
	fwrite(replay->kiosk->journal, 1, (size_t)replay->kiosk->journal_size, replay->journal);
	return true;
}

/* ---- what comes out ---- */

static bool write_journal(struct replay *replay, const char *path)
{
	if (fflush(replay->journal) != 0) {
		snprintf(replay->fault, FAULT_BYTES, "not enough memory for the journal");
		return false;
	}
	return store_write(path, replay->journal_text, replay->journal_size, replay->fault);
}

static bool write_results(struct replay *replay)
{
	enum { JOURNAL, REPORT, OBJ, GLB, CONTACT, OUTPUT_COUNT };
	static const char *const name[OUTPUT_COUNT] = {"journal.kitsuke", "report.json",
						       "garment.obj", "garment.glb", "contact.png"};
	static char path[OUTPUT_COUNT][PATH_BYTES_MAX];
	struct session *session = &replay->kiosk->session;
	struct measure measure;
	for (int i = 0; i < OUTPUT_COUNT; i++)
		if (!store_join(path[i], PATH_BYTES_MAX, replay->out, name[i], replay->fault))
			return false;
	if (!write_journal(replay, path[JOURNAL]) ||
	    !report_write(session, &replay->clock, &measure, path[REPORT], replay->fault))
		return false;
	if (session->cloth.worn && !garment_write(session, path[OBJ], path[GLB], replay->fault))
		return false;
	if (!session->cloth.worn)
		fprintf(stderr, "kitsuke replay: note: %s: ends without a garment on the body\n",
			replay->tape_path);
	return replay->no_pictures ||
	       contact_finish(&replay->contact, path[CONTACT], replay->fault);
}

/* ---- a tape from end to end ---- */

static bool take_memory(struct replay *replay)
{
	replay->memory = malloc(KIOSK_MEMORY_BYTES);
	replay->kiosk = calloc(1, sizeof *replay->kiosk);
	replay->reports = calloc(1, sizeof *replay->reports);
	replay->journal = open_memstream(&replay->journal_text, &replay->journal_size);
	bool taken = replay->memory && replay->kiosk && replay->reports && replay->journal &&
		     frame_clock_open(&replay->clock);
	if (!taken)
		snprintf(replay->fault, FAULT_BYTES, "not enough memory to start");
	return taken;
}

static void give_memory(struct replay *replay)
{
	contact_finish(&replay->contact, NULL, replay->fault);
	snapshot_close(&replay->snapshot);
	frame_clock_close(&replay->clock);
	if (replay->journal)
		fclose(replay->journal);
	free(replay->journal_text);
	free(replay->reports);
	free(replay->kiosk);
	free(replay->memory);
	tape_free(&replay->tape);
}

static int replay_tape(struct replay *replay)
{
	if (!replay_load(replay))
		return complain(replay, STATUS_INPUT);
	if (!take_memory(replay))
		return complain(replay, STATUS_MACHINE);
	if (replay->samples) {
		replay_samples(replay);
		return STATUS_DONE;
	}
	if (!start_kiosk(replay))
		return complain(replay, STATUS_INPUT);
	if (!store_make_folder(replay->out, replay->fault) || !open_pictures(replay) ||
	    !run(replay) || !write_results(replay))
		return complain(replay, STATUS_MACHINE);
	printf("hash %016llx  %s\n", (unsigned long long)session_hash(&replay->kiosk->session),
	       replay->tape_path);
	return STATUS_DONE;
}

/* Several tapes get a folder each in DIR, named after the tape. */
static int replay_one_of(const struct replay *common, const char *path, bool alone)
{
	static struct replay replay;
	char folder[PATH_BYTES_MAX], name[256];
	replay = *common;
	replay.tape_path = path;
	if (!alone && !replay.samples) {
		snprintf(name, sizeof name, "%.250s", store_name(path));
		char *dot = strrchr(name, '.');
		if (dot && dot != name)
			*dot = 0;
		if (!store_make_folder(replay.out, replay.fault) ||
		    !store_join(folder, sizeof folder, replay.out, name, replay.fault))
			return complain(&replay, STATUS_MACHINE);
		replay.out = folder;
	}
	int status = replay_tape(&replay);
	give_memory(&replay);
	return status;
}

static bool load_descriptor(struct replay *common, const char *path)
{
	size_t size;
	common->descriptor = (uint8_t *)store_read(path, &size, common->fault);
	if (!common->descriptor)
		return false;
	common->descriptor_size = size > TAPE_DESCRIPTOR_MAX ? 0 : (int)size;
	if (pen_descriptor_sound(common->descriptor, common->descriptor_size))
		return true;
	snprintf(common->fault, FAULT_BYTES,
		 "%.250s: no sound report descriptor; kitsuke devices --descriptor tells why",
		 path);
	free(common->descriptor);
	return false;
}

int command_replay(int argc, char **argv)
{
	static struct replay common;
	static struct threads threads;
	const char *files[OPTION_FILES_MAX];
	int count;
	const char *descriptor = NULL;
	long thread_count = 1; /* several replays side by side use the processors better */
	common.seed = 1;
	const struct option_value known[] = {
		{"--out", NULL, &common.out, NULL},
		{"--body", NULL, &common.body, NULL},
		{"--no-pictures", &common.no_pictures, NULL, NULL},
		{"--samples", &common.samples, NULL, NULL},
		{"--descriptor", NULL, &descriptor, NULL},
		{"--pictures-every", NULL, NULL, &common.pictures_every},
		{"--jitter-mm", NULL, NULL, &common.jitter_mm},
		{"--seed", NULL, NULL, &common.seed},
		{"--threads", NULL, NULL, &thread_count},
		{NULL, NULL, NULL, NULL},
	};
	if (!options_read(argc, argv, known, files, &count) || count == 0 ||
	    (!common.out && !common.samples)) {
		fputs(usage, stderr);
		return STATUS_USAGE;
	}
	if (descriptor && !load_descriptor(&common, descriptor))
		return complain(&common, STATUS_INPUT);
	if (!threads_start(&threads, thread_count, NULL, common.fault))
		return complain(&common, STATUS_USAGE);
	common.crew = threads_crew(&threads);
	common.progress = isatty(STDERR_FILENO);
	int status = STATUS_DONE;
	for (int i = 0; i < count; i++) {
		int one = replay_one_of(&common, files[i], count == 1);
		status = one > status ? one : status;
	}
	threads_stop(&threads);
	free(common.descriptor);
	return status;
}
