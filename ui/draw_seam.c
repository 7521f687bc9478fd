/* Seams: edges in a glow, threads between them, letters, stitches. */
#include "draw_piece.h"

#include <stdio.h>

enum { EASED_PERCENT_MAX = 15 }; /* what is more lies in visible gathers */

static const struct v2 no_shift = {0.0f, 0.0f};

/* Outward on the screen from an edge that runs from a to b. */
static struct v2 outward(const struct piece *piece, struct v2 a, struct v2 b)
{
	struct v2 along = v2_normalize(v2_sub(b, a));
	struct v2 out = {-along.y, along.x};
	return piece->inside_up ? v2_scale(out, -1.0f) : out;
}

void path_edge(const struct easel *easel, struct edge_ref edge, double inset)
{
	const struct piece *piece = piece_of(easel, edge.piece);
	int first, last, count = piece->point_count;
	piece_edge(piece, edge.edge, &first, &last);
	int steps = (last - first + count) % count;
	steps = steps == 0 ? count : steps;
	cairo_new_path(easel->cr);
	for (int k = 0; k <= steps; k++) {
		int before = (first + int_max(k - 1, 0)) % count;
		int after = (first + int_min(k + 1, steps)) % count;
		struct v2 at = local_px(easel, piece, piece->point_mm[(first + k) % count],
					no_shift);
		struct v2 a = local_px(easel, piece, piece->point_mm[before], no_shift);
		struct v2 b = local_px(easel, piece, piece->point_mm[after], no_shift);
		line_to(easel->cr, v2_sub(at, v2_scale(outward(piece, a, b), (float)inset)));
	}
}

void draw_edge_glow(const struct easel *easel, struct edge_ref edge, uint32_t colour)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit;
	path_edge(easel, edge, 0.0);
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
	cairo_set_line_width(cr, 15.0 * u);
	ink(cr, colour, 0.55);
	cairo_stroke_preserve(cr);
	cairo_set_line_width(cr, 5.5 * u);
	ink(cr, colour, 1.0);
	cairo_stroke(cr);
}

static struct v2 edge_px(const struct easel *easel, struct edge_ref edge, float fraction)
{
	const struct piece *piece = piece_of(easel, edge.piece);
	return local_px(easel, piece, piece_edge_point(piece, edge.edge, fraction), no_shift);
}

/* Along an orientable surface the start of one edge meets the end of the other. */
void draw_zip(const struct easel *easel, struct edge_ref a, struct edge_ref b, bool swapped,
	      double alpha)
{
	enum { THREADS = 7 };
	cairo_t *cr = easel->cr;
	cairo_set_line_width(cr, 2.0 * easel->unit);
	ink(cr, LOOK_WRAP, 0.42 * alpha);
	for (int i = 0; i < THREADS; i++) {
		float t = (float)i / (float)(THREADS - 1);
		move_to(cr, edge_px(easel, a, t));
		line_to(cr, edge_px(easel, b, swapped ? t : 1.0f - t));
	}
	cairo_stroke(cr);
	for (int side = 0; side < 2; side++) { /* the ends that meet first */
		struct v2 at = side == 0 ? edge_px(easel, a, 0.0f)
					 : edge_px(easel, b, swapped ? 0.0f : 1.0f);
		disc(cr, (double)at.x, (double)at.y, 7.0 * easel->unit);
		ink(cr, LOOK_WRAP, alpha);
		cairo_fill(cr);
	}
}

/* On the cloth beside the edge, where no letter lies. */
static void label_length(const struct easel *easel, struct edge_ref edge, const char *text,
			 uint32_t colour)
{
	struct v2 middle = edge_px(easel, edge, 0.5f);
	struct v2 out = outward(piece_of(easel, edge.piece), edge_px(easel, edge, 0.47f),
				edge_px(easel, edge, 0.53f));
	float width = 11.5f * (float)strlen(text) + 20.0f;
	float inside = (float)easel->unit * (34.0f + 0.5f * width * float_abs(out.x));
	draw_label(easel, v2_sub(middle, v2_scale(out, inside)), text, colour);
}

void draw_lengths(const struct easel *easel, struct edge_ref a, struct edge_ref b, bool even)
{
	const struct edge_ref edge[2] = {a, b};
	float length[2] = {piece_edge_length_mm(piece_of(easel, a.piece), a.edge),
			   piece_edge_length_mm(piece_of(easel, b.piece), b.edge)};
	for (int side = 0; side < 2; side++) {
		float more = 100.0f * (length[side] / float_max(length[1 - side], 1.0f) - 1.0f);
		int percent = (int)(more + 0.5f);
		char text[40];
		if (even)
			snprintf(text, sizeof text, "= %d mm", (int)(length[side] + 0.5f));
		else if (percent > 0)
			snprintf(text, sizeof text, "%d mm +%d%%", (int)(length[side] + 0.5f),
				 percent);
		else
			snprintf(text, sizeof text, "%d mm", (int)(length[side] + 0.5f));
		label_length(easel, edge[side], text,
			     percent > EASED_PERCENT_MAX ? LOOK_WRAP : LOOK_NIGHT);
	}
}

static void seam_letter(int seam, int side, char text[8])
{
	char letter = (char)('A' + seam % 26);
	if (seam < 26)
		snprintf(text, 8, "%c%s", letter, side ? "'" : "");
	else
		snprintf(text, 8, "%c%d%s", letter, seam / 26 + 1, side ? "'" : "");
}

/* A triangle beside the edge that points the way the seam runs, the same way on both sides. */
static void draw_way(const struct easel *easel, struct edge_ref edge, bool backwards)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit;
	const struct piece *piece = piece_of(easel, edge.piece);
	struct v2 a = edge_px(easel, edge, 0.24f), b = edge_px(easel, edge, 0.26f);
	struct v2 out = outward(piece, a, b);
	struct v2 along = v2_scale(v2_normalize(v2_sub(b, a)), backwards ? -1.0f : 1.0f);
	struct v2 at = v2_sub(a, v2_scale(out, (float)(11.0 * u)));
	struct v2 tip = v2_add(at, v2_scale(along, (float)(9.0 * u)));
	struct v2 tail = v2_sub(at, v2_scale(along, (float)(5.0 * u)));
	move_to(cr, tip);
	line_to(cr, v2_add(tail, v2_scale(out, (float)(5.5 * u))));
	line_to(cr, v2_sub(tail, v2_scale(out, (float)(5.5 * u))));
	cairo_close_path(cr);
	ink(cr, 0xffffff, 0.9);
	cairo_fill(cr);
}

static void draw_stitches(const struct easel *easel, struct edge_ref edge)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit, dash[2] = {6.0 * u, 5.0 * u};
	path_edge(easel, edge, 7.0 * u);
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
	cairo_set_line_width(cr, 2.0 * u);
	ink(cr, 0xffffff, 0.72);
	stroke_dashed(cr, dash, 2);
}

/* A dotted thread that leaves both edges straight outwards. */
static void draw_thread(const struct easel *easel, const struct seam *seam)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit, dots[2] = {0.01, 8.5 * u};
	struct v2 end[2], control[2];
	for (int side = 0; side < 2; side++) {
		struct edge_ref edge = side == 0 ? seam->a : seam->b;
		struct v2 a = edge_px(easel, edge, 0.47f), b = edge_px(easel, edge, 0.53f);
		end[side] = seam_badge_px(
			easel->ui, &shown_document(easel->ui, easel->session)->pattern, seam, side);
		control[side] = outward(piece_of(easel, edge.piece), a, b);
	}
	float reach = float_clamp(0.36f * v2_distance(end[0], end[1]), (float)(24.0 * u),
				  (float)(150.0 * u));
	for (int side = 0; side < 2; side++)
		control[side] = v2_add(end[side], v2_scale(control[side], reach));
	move_to(cr, end[0]);
	cairo_curve_to(cr, (double)control[0].x, (double)control[0].y, (double)control[1].x,
		       (double)control[1].y, (double)end[1].x, (double)end[1].y);
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_width(cr, 3.0 * u);
	ink(cr, 0x8c8375, 1.0);
	stroke_dashed(cr, dots, 2);
}

/* Under the pieces, so that a thread to the far side of another piece doesn't cross its cloth. */
void draw_threads(const struct easel *easel)
{
	const struct ui *ui = easel->ui;
	const struct pattern *pattern = &shown_document(easel->ui, easel->session)->pattern;
	for (int s = 0; ui->step <= STEP_SEW && s < SEAMS_MAX; s++)
		if (pattern->seam[s].used && !(ui->step == STEP_SEW && s == ui->seam))
			draw_thread(easel, &pattern->seam[s]);
}

static void draw_letter(const struct easel *easel, int s, int side, bool selected)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit;
	char text[8];
	const struct pattern *pattern = &shown_document(easel->ui, easel->session)->pattern;
	struct v2 at = seam_badge_px(easel->ui, pattern, &pattern->seam[s], side);
	seam_letter(s, side, text);
	round_box(cr, (double)at.x - 19.0 * u, (double)at.y - 17.0 * u, 38.0 * u, 34.0 * u,
		  8.0 * u);
	ink(cr, 0xffffff, 1.0);
	cairo_fill_preserve(cr);
	cairo_set_line_width(cr, (selected ? 3.6 : 2.4) * u);
	ink(cr, selected ? LOOK_WRAP : 0x8c8375, 1.0);
	cairo_stroke(cr);
	struct style style = {23.0 * u, selected, LOOK_INK, ALIGN_CENTRE, 34.0 * u};
	draw_text(cr, easel->type, text, (double)at.x, (double)at.y + 8.5 * u, &style);
}

static bool touches(const struct seam *seam, uint32_t pieces)
{
	return (pieces >> seam->a.piece & 1) || (pieces >> seam->b.piece & 1);
}

void draw_seams(const struct easel *easel, bool lifted)
{
	const struct pattern *pattern = &shown_document(easel->ui, easel->session)->pattern;
	uint32_t pieces = lifted_pieces(easel->ui);
	bool sewing = easel->ui->step == STEP_SEW, early = easel->ui->step <= STEP_SEW;
	for (int s = 0; s < SEAMS_MAX; s++) {
		const struct seam *seam = &pattern->seam[s];
		bool selected = sewing && s == easel->ui->seam;
		if (!seam->used || touches(seam, pieces) != lifted)
			continue;
		draw_stitches(easel, seam->a);
		draw_stitches(easel, seam->b);
		if (selected) {
			draw_edge_glow(easel, seam->a, LOOK_HINT_RIM);
			draw_edge_glow(easel, seam->b, LOOK_HINT_RIM);
			draw_zip(easel, seam->a, seam->b, seam->swapped, 1.0);
		}
		if (sewing) {
			draw_way(easel, seam->a, false);
			draw_way(easel, seam->b, !seam->swapped);
		}
	}
	for (int s = 0; early && s < SEAMS_MAX; s++)
		for (int side = 0; pattern->seam[s].used && side < 2; side++)
			if (touches(&pattern->seam[s], pieces) == lifted)
				draw_letter(easel, s, side, sewing && s == easel->ui->seam);
	int s = easel->ui->seam;
	if (sewing && s >= 0 && pattern->seam[s].used && !lifted)
		draw_lengths(easel, pattern->seam[s].a, pattern->seam[s].b, pattern->seam[s].even);
}
