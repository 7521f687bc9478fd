/* Recordings of real tablets, from text to samples, against the counts that other decoders found.
 *
 * The dumps have no descriptors of their own: the descriptor is the one of the same tablet in the
 * table of descriptors that has the recorded report ids. */
#include "pen.h"
#include "table.h"
#include "tape.h"
#include "test.h"

#define DATA "../shared/data/hid/"

static struct table recordings, expected, descriptors;

struct seen {
	long reports, proximities, tip_downs;
	int max_x, max_y, max_pressure;
};

/* --- fields ----------------------------------------------------------------------------------- */

/* What the switches alone say, as the table counts it. */
static void seen_report(struct seen *seen, const struct pen_layout *layout,
			const struct pen_fields *f, bool *was_in, bool *was_tip)
{
	bool in = layout->in_range.size ? f->in_range : true;
	bool tip = in && (f->tip || f->eraser);
	seen->reports++;
	seen->proximities += in && !*was_in;
	seen->tip_downs += tip && !*was_tip;
	*was_in = in;
	*was_tip = tip;
	if (!in)
		return;
	seen->max_x = int_max(seen->max_x, f->x);
	seen->max_y = int_max(seen->max_y, f->y);
	seen->max_pressure = int_max(seen->max_pressure, f->pressure);
}

static struct seen seen_fields(const struct tape *tape, const struct pen_layout *layout, int count)
{
	struct seen seen = {0};
	bool was_in = false, was_tip = false;
	for (size_t i = 0; i < tape->event_count; i++) {
		const struct tape_event *event = &tape->event[i];
		struct pen_fields f;
		bool cut_off;
		const struct pen_layout *l = pen_report_read(
			layout, count, tape->bytes + event->offset, event->size, &f, &cut_off);
		if (l)
			seen_report(&seen, l, &f, &was_in, &was_tip);
	}
	return seen;
}

/* --- which descriptor ------------------------------------------------------------------------- */

static bool same_int(int row, const char *column, long have)
{
	const char *cell = table_cell(&recordings, row, column);
	return !*cell || strtol(cell, NULL, 10) == have;
}

static bool seen_as_stated(int row, const struct seen *seen)
{
	return same_int(row, "pen_reports", seen->reports) &&
	       same_int(row, "prox_ins", seen->proximities) &&
	       same_int(row, "tip_downs", seen->tip_downs) &&
	       same_int(row, "seen_max_x", seen->max_x) &&
	       same_int(row, "seen_max_y", seen->max_y) &&
	       same_int(row, "seen_max_pressure", seen->max_pressure);
}

/* Could this descriptor be the recorded tablet's: the same folder, or the same ids? */
static bool same_tablet(int row, int candidate)
{
	const char *file = table_cell(&recordings, row, "file");
	size_t folder = strcspn(file, "/") + 1;
	if (!strncmp(file, table_cell(&expected, candidate, "descriptor_file"), folder))
		return true;
	return !strcmp(table_cell(&expected, candidate, "vid"),
		       table_cell(&recordings, row, "vid")) &&
	       !strcmp(table_cell(&expected, candidate, "pid"),
		       table_cell(&recordings, row, "pid"));
}

struct found {
	uint8_t descriptor[DESCRIPTOR_BYTES_MAX];
	int size;
	struct seen seen;
};

/* The reports of one id, as the descriptor of a candidate row reads them. */
static bool candidate_read(const struct tape *tape, int candidate, struct found *found)
{
	struct pen_layout layout[PEN_REPORTS_MAX];
	char reason[160];
	int at = table_find(&descriptors, "sha1",
			    table_cell(&expected, candidate, "descriptor_sha1"));
	found->size = table_hex(table_cell(&descriptors, at, "hex"), found->descriptor,
				DESCRIPTOR_BYTES_MAX);
	int count = pen_descriptor_read(found->descriptor, found->size, layout, reason);
	long id = strtol(table_cell(&expected, candidate, "report_id"), NULL, 10);
	for (int i = 0; i < count; i++) {
		if (layout[i].report_id != id)
			continue;
		found->seen = seen_fields(tape, &layout[i], 1);
		if (found->seen.reports)
			return true;
	}
	return false;
}

/* A hid-recorder tape brings its own descriptor. */
static bool own_descriptor(const struct tape *tape, struct found *found)
{
	struct pen_layout layout[PEN_REPORTS_MAX];
	char reason[160];
	found->size = tape->device[0].descriptor_size;
	memcpy(found->descriptor, tape->device[0].descriptor, (size_t)found->size);
	int count = pen_descriptor_read(found->descriptor, found->size, layout, reason);
	found->seen = seen_fields(tape, layout, count);
	return found->size > 0;
}

/* The first candidate by whose descriptor the recording reads as stated. -1: no candidate knows the
 * recorded report ids; -2: candidates do, and disagree. */
static int descriptor_find(int row, const struct tape *tape, struct found *found)
{
	int best = -1;
	if (own_descriptor(tape, found))
		return seen_as_stated(row, &found->seen) ? 0 : -2;
	for (int i = 0; i < expected.rows; i++) {
		if (!same_tablet(row, i) || !candidate_read(tape, i, found))
			continue;
		if (seen_as_stated(row, &found->seen))
			return i;
		best = -2;
	}
	return best;
}

/* --- samples ---------------------------------------------------------------------------------- */

struct played {
	long samples, contacts, contacts_short, contacts_split;
	int64_t down_us, up_us; /* of the last contact */
	bool sound;
	struct hash hash;
};

static void sample_check(struct played *played, const struct pen_sample *last,
			 const struct pen_sample *sample, float steepest)
{
	const struct pen_sample *s = sample;
	bool sound = s->time_us >= last->time_us;
	sound &= s->position_px.x >= 0.0f && s->position_px.x < 1920.0f;
	sound &= s->position_px.y >= 0.0f && s->position_px.y < 1080.0f;
	sound &= s->pressure >= 0.0f && s->pressure <= 1.0f;
	sound &= s->state == PEN_TOUCH || s->pressure <= 0.0f;
	sound &= s->state != PEN_TOUCH || last->state == PEN_TOUCH || s->pressure <= steepest;
	sound &= s->tilt_rad.x > -1.6f && s->tilt_rad.x < 1.6f;
	played->sound &= sound;
	played->samples++;
	bool touch = s->state == PEN_TOUCH, touched = last->state == PEN_TOUCH;
	if (touch && !touched) {
		played->contacts_split += played->contacts &&
					  s->time_us - played->up_us < PEN_MERGE_US;
		played->contacts++;
		played->down_us = s->time_us;
	} else if (touched && !touch) {
		played->contacts_short += s->time_us - played->down_us < PEN_CONTACT_LEAST_US;
		played->up_us = s->time_us;
	}
	hash_int(&played->hash, (int)s->state);
	hash_float(&played->hash, s->position_px.x);
	hash_float(&played->hash, s->position_px.y);
	hash_float(&played->hash, s->pressure);
}

/* The whole tape through the code that the station runs, frame by frame. */
static struct played play(const struct tape *tape, const uint8_t *descriptor, int size)
{
	static struct pen pen;
	static struct frame_reports reports;
	static struct frame_input input;
	struct played played = {.sound = true};
	struct pen_sample last = {0};
	size_t cursor = 0;
	hash_init(&played.hash);
	pen_init(&pen, 1920, 1080);
	for (int i = 0; i < PEN_DEVICES_MAX; i++)
		pen_describe(&pen, i, descriptor, size);
	for (int frame = 0; frame < tape->frame_count + 120; frame++) {
		input = (struct frame_input){0};
		tape_frame(tape, frame, &cursor, &reports);
		pen_read(&pen, &reports, (int64_t)(frame + 1) * 1000000 / FRAME_RATE_HZ, &input);
		for (int i = 0; i < input.sample_count; i++) {
			sample_check(&played, &last, &input.sample[i], 0.34f);
			last = input.sample[i];
		}
	}
	played.sound &= cursor == tape->event_count && last.state != PEN_TOUCH;
	return played;
}

static int decoded, undescribed;
static long contacts, contacts_short, contacts_split, tip_downs;
static struct hash all;

static void check_recording(int row, const struct tape *tape)
{
	static struct found found;
	const char *file = table_cell(&recordings, row, "file");
	int candidate = descriptor_find(row, tape, &found);
	if (candidate == -1) {
		undescribed++;
		return;
	}
	if (candidate == -2) {
		fprintf(stderr, "%s: reads otherwise than stated\n", file);
		test_failures++;
		return;
	}
	struct played first = play(tape, found.descriptor, found.size);
	struct played again = play(tape, found.descriptor, found.size);
	if (!first.sound || first.samples < found.seen.reports ||
	    first.hash.value != again.hash.value) {
		fprintf(stderr, "%s: %ld samples of %ld reports, sound: %d\n", file, first.samples,
			found.seen.reports, first.sound);
		test_failures++;
	}
	decoded++;
	hash_u32(&all, (uint32_t)(first.hash.value >> 32));
	hash_u32(&all, (uint32_t)first.hash.value);
	contacts += first.contacts;
	contacts_short += first.contacts_short;
	contacts_split += first.contacts_split;
	tip_downs += found.seen.tip_downs;
	if (getenv("VERBOSE"))
		printf("%s: %ld reports, %ld samples, %ld tip switches, %ld contacts, p %d\n", file,
		       found.seen.reports, first.samples, found.seen.tip_downs, first.contacts,
		       found.seen.max_pressure);
}

int main(void)
{
	if (!table_read(&recordings, DATA "recordings.csv", ',') ||
	    !table_read(&expected, DATA "expected.csv", ',') ||
	    !table_read(&descriptors, DATA "descriptors.tsv", '\t')) {
		printf("skip: no recordings at " DATA "\n");
		return 77;
	}
	hash_init(&all);
	for (int row = 0; row < recordings.rows; row++) {
		char path[512], fault[200];
		size_t size;
		static struct tape tape;
		if (strcmp(table_cell(&recordings, row, "decode"), "descriptor"))
			continue;
		snprintf(path, sizeof path, DATA "%s", table_cell(&recordings, row, "data_path"));
		char *text = table_file(path, &size);
		bool sound = text && tape_read(&tape, text, size, fault);
		CHECK(sound);
		if (sound) {
			check_recording(row, &tape);
			tape_free(&tape);
		}
		free(text);
	}
	/* 20 of 96 stand without their descriptor in the tables. */
	CHECK(decoded >= 76 && undescribed <= 20);
	CHECK(contacts > 100 && contacts_short == 0 && contacts_split == 0);
	if (getenv("VERBOSE"))
		printf("%d decoded, %d undescribed, %ld tip switches, %ld contacts, hash %016llx\n",
		       decoded, undescribed, tip_downs, contacts, (unsigned long long)all.value);
	return test_end();
}
