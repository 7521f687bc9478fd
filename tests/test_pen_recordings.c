/* Recordings of real tablets, from text to samples, against the counts that other decoders found.
 *
 * The dumps have no descriptors of their own: the descriptor is the one of the same tablet in the
 * table of descriptors that has the recorded report ids. */
#include "pen.h"
#include "table.h"
#include "tape_learn.h"
#include "test.h"

#define DATA "../shared/data/hid/"

static struct table recordings, expected, descriptors, probes;

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
	struct pen_memory memory = {0};
	bool was_in = false, was_tip = false;
	for (size_t i = 0; i < tape->event_count; i++) {
		const struct tape_event *event = &tape->event[i];
		struct pen_fields f;
		bool cut_off;
		const struct pen_layout *l = pen_report_read(layout, count,
							     tape->bytes + event->offset,
							     event->size, &memory, &f, &cut_off);
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
	struct pen_vendor speaks;
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
static struct played play(const struct tape *tape, const struct found *found)
{
	static struct pen pen;
	static struct frame_reports reports;
	static struct frame_input input;
	struct played played = {.sound = true};
	struct pen_sample last = {0};
	size_t cursor = 0;
	hash_init(&played.hash);
	pen_init(&pen, 1920, 1080);
	for (int i = 0; i < PEN_DEVICES_MAX; i++) {
		pen_describe(&pen, i, found->descriptor, found->size);
		pen_vendor_set(&pen, i, &found->speaks);
	}
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

/* Twice the same, sound, and as many contacts each time. */
static void check_played(int row, const struct tape *tape, const struct found *found)
{
	const char *file = table_cell(&recordings, row, "file");
	struct played first = play(tape, found);
	struct played again = play(tape, found);
	if (!first.sound || first.samples < found->seen.reports ||
	    first.hash.value != again.hash.value) {
		fprintf(stderr, "%s: %ld samples of %ld reports, sound: %d\n", file, first.samples,
			found->seen.reports, first.sound);
		test_failures++;
	}
	decoded++;
	hash_u32(&all, (uint32_t)(first.hash.value >> 32));
	hash_u32(&all, (uint32_t)first.hash.value);
	contacts += first.contacts;
	contacts_short += first.contacts_short;
	contacts_split += first.contacts_split;
	tip_downs += found->seen.tip_downs;
	if (getenv("VERBOSE"))
		printf("%s: %s, %ld reports, %ld samples, %ld tip switches, %ld contacts, x %d y "
		       "%d "
		       "p %d\n",
		       file,
		       found->speaks.family == PEN_BY_DESCRIPTOR
			       ? "descriptor"
			       : pen_family_rule(found->speaks.family)->word,
		       found->seen.reports, first.samples, found->seen.tip_downs, first.contacts,
		       found->seen.max_x, found->seen.max_y, found->seen.max_pressure);
}

static void check_recording(int row, const struct tape *tape)
{
	static struct found found;
	const char *file = table_cell(&recordings, row, "file");
	found.speaks = (struct pen_vendor){PEN_BY_DESCRIPTOR, 0, 0, 0};
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
	check_played(row, tape, &found);
}

/* --- makers' protocols ------------------------------------------------------------------------ */

static long cell_int(const struct table *table, int row, const char *column, long missing)
{
	const char *cell = row < 0 ? "" : table_cell(table, row, column);
	return *cell ? strtol(cell, NULL, 10) : missing;
}

/* A dump does not say what the tablet answered; its probe does, else what was seen is the range. */
static struct pen_vendor uclogic_speaks(int row, bool second)
{
	char tablet[128];
	const char *file = table_cell(&recordings, row, "file");
	snprintf(tablet, sizeof tablet, "%.*s", (int)strcspn(file, "/"), file);
	int probe = table_find(&probes, "tablet", tablet);
	return (struct pen_vendor){
		.family = second ? PEN_UCLOGIC_2 : PEN_UCLOGIC_1,
		.x_maximum = (int)cell_int(&probes, probe, second ? "v2_max_x" : "v1_max_x",
					   cell_int(&recordings, row, "seen_max_x", 100) + 100),
		.y_maximum = (int)cell_int(&probes, probe, second ? "v2_max_y" : "v1_max_y",
					   cell_int(&recordings, row, "seen_max_y", 100) + 100),
		.pressure_maximum = (int)cell_int(
			&probes, probe, second ? "v2_max_pressure" : "v1_max_pressure", 8191),
	};
}

static int spoken, counted_otherwise;

/* Contacts and maxima as the table has them. It keeps half of an Intuos' pressure where Linux does.
 * It leaves out where an art pen was when it told its rotation, takes the last position of a pen
 * that leaves for one in range, and buttons of KYE's with report 7 for a pen. */
static bool vendor_seen_as_stated(int row, const struct found *found)
{
	const struct seen *seen = &found->seen;
	long p = cell_int(&recordings, row, "seen_max_pressure", seen->max_pressure);
	return same_int(row, "tip_downs", seen->tip_downs) &&
	       same_int(row, "seen_max_x", seen->max_x) &&
	       same_int(row, "seen_max_y", seen->max_y) &&
	       (p == seen->max_pressure || p == seen->max_pressure / 2);
}

static void check_vendor(int row, const struct tape *tape)
{
	static struct found found;
	float width_mm, height_mm;
	const char *decode = table_cell(&recordings, row, "decode");
	struct pen_layout layout;
	bool uclogic = !strncmp(decode, "uclogic", 7);
	found.size = 0;
	found.speaks = uclogic ? uclogic_speaks(row, decode[9] == '2')
			       : tape_speaks(&tape->device[0], &width_mm, &height_mm);
	if (found.speaks.family == PEN_BY_DESCRIPTOR) {
		fprintf(stderr, "%s: no protocol\n", table_cell(&recordings, row, "file"));
		test_failures++;
		return;
	}
	pen_vendor_layout(&found.speaks, &layout);
	found.seen = seen_fields(tape, &layout, 1);
	spoken++;
	if (vendor_seen_as_stated(row, &found)) {
		check_played(row, tape, &found);
		return;
	}
	counted_otherwise++;
	if (getenv("VERBOSE"))
		printf("%s: %ld reports, %ld tips, %d %d %d; stated %s, %s, %s %s %s\n",
		       table_cell(&recordings, row, "file"), found.seen.reports,
		       found.seen.tip_downs, found.seen.max_x, found.seen.max_y,
		       found.seen.max_pressure, table_cell(&recordings, row, "pen_reports"),
		       table_cell(&recordings, row, "tip_downs"),
		       table_cell(&recordings, row, "seen_max_x"),
		       table_cell(&recordings, row, "seen_max_y"),
		       table_cell(&recordings, row, "seen_max_pressure"));
	CHECK(same_int(row, "tip_downs", found.seen.tip_downs));
	check_played(row, tape, &found);
}

int main(void)
{
	if (!table_read(&recordings, DATA "recordings.csv", ',') ||
	    !table_read(&expected, DATA "expected.csv", ',') ||
	    !table_read(&probes, DATA "uclogic_probe.csv", ',') ||
	    !table_read(&descriptors, DATA "descriptors.tsv", '\t')) {
		printf("skip: no recordings at " DATA "\n");
		return 77;
	}
	hash_init(&all);
	for (int row = 0; row < recordings.rows; row++) {
		char path[512], fault[200];
		size_t size;
		static struct tape tape;
		const char *decode = table_cell(&recordings, row, "decode");
		bool described = !strcmp(decode, "descriptor");
		if (!*decode)
			continue;
		snprintf(path, sizeof path, DATA "%s", table_cell(&recordings, row, "data_path"));
		char *text = table_file(path, &size);
		bool sound = text && tape_read(&tape, text, size, fault);
		CHECK(sound);
		if (sound) {
			if (described)
				check_recording(row, &tape);
			else
				check_vendor(row, &tape);
			tape_free(&tape);
		}
		free(text);
	}
	/* 20 of 96 stand without their descriptor in the tables. */
	CHECK(decoded >= 76 && undescribed <= 20);
	CHECK(contacts > 100 && contacts_short == 0 && contacts_split == 0);
	CHECK(spoken > 20 && 4 * counted_otherwise <= spoken);
	printf("recordings: %d decoded, %d of them by a maker's protocol (%d with maxima other "
	       "than "
	       "stated), %d without their descriptor\n",
	       decoded, spoken, counted_otherwise, undescribed);
	if (getenv("VERBOSE"))
		printf("%d decoded, %d undescribed, %ld tip switches, %ld contacts, hash %016llx\n",
		       decoded, undescribed, tip_downs, contacts, (unsigned long long)all.value);
	return test_end();
}
