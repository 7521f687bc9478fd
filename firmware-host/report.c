#include "report.h"

#include "cloth_pleat.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { MEASURE_MEMORY_BYTES = 64 << 20, REPORT_REAL_DIGITS = 6 };

/* ---- the clock ---- */

static double now_ms(void)
{
	struct timespec now;
	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

bool frame_clock_open(struct frame_clock *clock)
{
	memset(clock, 0, sizeof *clock);
	clock->frame_ms = malloc(FRAME_CLOCK_FRAMES_MAX * sizeof *clock->frame_ms);
	return clock->frame_ms != NULL;
}

void frame_clock_close(struct frame_clock *clock)
{
	free(clock->frame_ms);
	clock->frame_ms = NULL;
}

void frame_clock_begin(struct frame_clock *clock, const struct session *session)
{
	clock->job = session->job;
	clock->begin_ms = now_ms();
}

void frame_clock_end(struct frame_clock *clock, const struct session *session)
{
	double spent_ms = now_ms() - clock->begin_ms;
	if (clock->count < FRAME_CLOCK_FRAMES_MAX)
		clock->frame_ms[clock->count] = (float)spent_ms;
	clock->count++;
	bool fresh = clock->job != JOB_MESH && session->job == JOB_MESH;
	if (fresh) {
		clock->wrap_frames = 0;
		clock->wrap_ms = 0.0;
	}
	if (fresh || clock->job != JOB_NONE) {
		clock->wrap_frames++;
		clock->wrap_ms += spent_ms;
	}
}

static int compare_ms(const void *a, const void *b)
{
	float s = *(const float *)a, t = *(const float *)b;
	return (s > t) - (s < t);
}

/* Sorts the times; what is asked for here is asked once, at the end. */
static double percentile_ms(const struct frame_clock *clock, double share)
{
	long kept = clock->count < FRAME_CLOCK_FRAMES_MAX ? clock->count : FRAME_CLOCK_FRAMES_MAX;
	if (kept == 0)
		return 0.0;
	return (double)clock->frame_ms[(long)(share * (double)(kept - 1))];
}

static void sort_times(struct frame_clock *clock)
{
	long kept = clock->count < FRAME_CLOCK_FRAMES_MAX ? clock->count : FRAME_CLOCK_FRAMES_MAX;
	qsort(clock->frame_ms, (size_t)kept, sizeof *clock->frame_ms, compare_ms);
}

/* ---- the figures ---- */

static bool measure_now(const struct session *session, struct measure *measure)
{
	memset(measure, 0, sizeof *measure);
	if (!session->cloth.worn)
		return true;
	void *memory = malloc(MEASURE_MEMORY_BYTES);
	if (!memory)
		return false;
	struct arena arena;
	arena_init(&arena, memory, MEASURE_MEMORY_BYTES);
	measure_garment(measure, &session->cloth, measure_init(&arena));
	free(memory);
	return true;
}

static void put_int(json_t *report, const char *key, long value)
{
	json_object_set_new(report, key, json_integer(value));
}

static void put_real(json_t *report, const char *key, double value)
{
	json_object_set_new(report, key, json_real(value));
}

static void put_work(json_t *report, const struct session *session, struct frame_clock *clock)
{
	char hash[20];
	snprintf(hash, sizeof hash, "%016llx", (unsigned long long)session_hash(session));
	json_object_set_new(report, "hash", json_string(hash));
	put_int(report, "frames", session->frame);
	put_int(report, "vertices", session->garment.vertex_count);
	put_int(report, "triangles", session->garment.triangle_count);
	put_int(report, "work_units", session->work_units);
	put_int(report, "wrap_frames", clock->wrap_frames);
	put_real(report, "wrap_ms", clock->wrap_ms);
	sort_times(clock);
	put_real(report, "step_ms_p50", percentile_ms(clock, 0.5));
	put_real(report, "step_ms_p99", percentile_ms(clock, 0.99));
	put_real(report, "step_ms_max", percentile_ms(clock, 1.0));
}

static void put_measure(json_t *report, const struct measure *measure)
{
	put_int(report, "vertices_inside", measure->vertices_inside);
	put_int(report, "midpoints_inside", measure->midpoints_inside);
	put_int(report, "centres_inside", measure->centres_inside);
	put_real(report, "penetration_mm_max", (double)measure->penetration_mm_max);
	put_int(report, "edge_crossings_body", measure->edge_crossings_body);
	put_real(report, "strain_p95", (double)measure->strain_p95);
	put_real(report, "strain_max", (double)measure->strain_max);
	put_real(report, "compression_p95", (double)measure->compression_p95);
	put_int(report, "inverted_triangles", measure->inverted_triangles);
	put_int(report, "creased_triangles", measure->creased_triangles);
	put_int(report, "self_intersections", measure->self_intersections);
	put_real(report, "seam_gap_mm_max", (double)measure->seam_gap_mm_max);
}

static const char *const part_name[PART_COUNT] = {"trunk",     "head",     "arm_left",
						  "arm_right", "leg_left", "leg_right"};

static void diagnose_girth(json_t *diagnoses, const struct girth *girth, const char *part)
{
	char text[200];
	snprintf(text, sizeof text,
		 "Too small: the garment is %.0f mm round the %s %.2f m up, where %.0f mm are "
		 "needed.",
		 (double)girth->cloth_m * 1e3, part, (double)girth->at_m.y,
		 (double)girth->body_m * 1e3);
	json_array_append_new(diagnoses, json_pack("{s:s, s:[], s:s}", "kind", "too_small", "marks",
						   "text", text));
}

/* How tight the garment is round each part, and what is said of it where it is too small. */
static void put_girths(json_t *report, const struct measure *measure)
{
	double least = 0.0;
	json_t *girths = json_array();
	for (int part = 0; part < PART_COUNT; part++) {
		const struct girth *girth = &measure->girth[part];
		if (girth->body_m <= 0.0f)
			continue;
		double ratio = (double)(girth->cloth_m / girth->body_m);
		least = least > 0.0 && least < ratio ? least : ratio;
		json_array_append_new(
			girths, json_pack("{s:s, s:f, s:f, s:f, s:[f, f, f]}", "part",
					  part_name[part], "garment_m", (double)girth->cloth_m,
					  "body_m", (double)girth->body_m, "ratio", ratio, "at_m",
					  (double)girth->at_m.x, (double)girth->at_m.y,
					  (double)girth->at_m.z));
		if (ratio < (double)girth_enough)
			diagnose_girth(json_object_get(report, "diagnoses"), girth,
				       part_name[part]);
	}
	put_real(report, "girth_ratio_min", least);
	json_object_set_new(report, "girths", girths);
}

/* Which bones pass through which rim of the garment: how one knows that an arm is in its sleeve. */
static void put_loops(json_t *report, const struct measure *measure)
{
	json_t *loops = json_array();
	for (int l = 0; l < measure->loop_count; l++) {
		const struct loop_link *link = &measure->loop[l];
		json_t *linking = json_object();
		for (int part = 0; part < PART_COUNT; part++)
			put_int(linking, part_name[part], link->linking[part]);
		json_array_append_new(loops,
				      json_pack("{s:i, s:f, s:[f, f, f], s:o}", "vertices",
						link->vertex_count, "length_m",
						(double)link->length_m, "centre_m",
						(double)link->centre_m.x, (double)link->centre_m.y,
						(double)link->centre_m.z, "linking", linking));
	}
	json_object_set_new(report, "loops", loops);
	json_object_set_new(report, "head_through_collar",
			    json_boolean(measure->head_through_collar));
	put_int(report, "arms_in_sleeves", measure->arms_in_sleeves);
	put_int(report, "legs_in_legs", measure->legs_in_legs);
}

/* Says of each pleated seam what is sewn to what, and how long both are. */
static void diagnose_pleats(json_t *diagnoses, const struct session *session)
{
	const struct garment *garment = &session->garment;
	const struct piece *piece = session->document.pattern.piece;
	struct pleats pleats;
	char text[200];
	for (int at = 0; session->cloth.welded && cloth_pleats(garment, &at, &pleats);) {
		const struct seam_pair *pair = &garment->pair[pleats.first];
		int a = garment->piece[pair->a], b = garment->piece[pair->b];
		double longer_mm = (double)(pleats.excess_m / (1.0f - pleats.share)) * 1e3;
		snprintf(text, sizeof text, "Pleated: %.0f mm of %s are sewn to %.0f mm of %s.",
			 longer_mm, piece[pleats.side ? b : a].name,
			 longer_mm * (double)pleats.share, piece[pleats.side ? a : b].name);
		json_array_append_new(diagnoses, json_pack("{s:s, s:[], s:s}", "kind", "pleated",
							   "marks", "text", text));
	}
}

static void put_wrap(json_t *report, const struct wrap *wrap)
{
	put_real(report, "mark_error_mm_rms", (double)wrap->mark_error_rms_m * 1e3);
	put_real(report, "mark_error_mm_max", (double)wrap->mark_error_max_m * 1e3);
	json_t *list = json_array();
	for (int d = 0; d < wrap->diagnoses.count; d++) {
		const struct diagnosis *item = &wrap->diagnoses.item[d];
		json_t *marks = json_array();
		for (int m = 0; m < COUNT_OF(item->mark); m++)
			if (item->mark[m])
				json_array_append_new(marks, json_integer(item->mark[m]));
		json_array_append_new(list, json_pack("{s:s, s:o, s:s}", "kind", item->kind,
						      "marks", marks, "text", item->text));
	}
	json_object_set_new(report, "diagnoses", list);
}

bool report_write(const struct session *session, struct frame_clock *clock, struct measure *measure,
		  const char *path, char fault[FAULT_BYTES])
{
	if (!measure_now(session, measure)) {
		snprintf(fault, FAULT_BYTES, "not enough memory to measure the garment");
		return false;
	}
	json_t *report = json_object();
	put_work(report, session, clock);
	put_measure(report, measure);
	put_wrap(report, &session->wrap);
	diagnose_pleats(json_object_get(report, "diagnoses"), session);
	put_girths(report, measure);
	put_loops(report, measure);
	char *text = json_dumps(report, JSON_INDENT(2) | JSON_REAL_PRECISION(REPORT_REAL_DIGITS));
	json_decref(report);
	if (!text) {
		snprintf(fault, FAULT_BYTES, "%.250s: not enough memory to write it", path);
		return false;
	}
	bool written = store_write(path, text, strlen(text), fault);
	free(text);
	return written;
}
