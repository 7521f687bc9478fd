/* Between the gestures and the edits: what lies under the pen, and what a stroke does in each step.
 *
 *   gesture.c        contact -> wait -> begin (a tool says what it is) -> move -> end or tap
 *   gesture_stroke.c a trembling hand's samples -> an even line
 *   tool_pick.c      what lies under a position
 *   tool_<step>.c    begin, move, end, tap of that step; the step's buttons
 *   tool_shape.c     grips of the selected piece, ready shapes: what the pen is about to make of it
 *   tool_points.c    corners and edges of the selected piece
 *   tool_refused.c   why a stroke was not taken, and where
 *   tool_snap.c      where a point would rather lie
 */
#ifndef TOOL_H
#define TOOL_H

#include "text.h"
#include "ui.h"

/* What every tool works with. */
struct tool {
	struct ui *ui;
	const struct session *session;
	struct edit_list *edits;
};

/* A length on the real screen in pixels of this one. */
static inline float tool_px(const struct ui *ui, float mm)
{
	return mm / ui->layout.mm_per_px;
}

/* The same length on the sheet. */
static inline float tool_sheet_mm(const struct ui *ui, float screen_mm)
{
	return tool_px(ui, screen_mm) / ui->view.sheet_px_per_mm;
}

static inline bool piece_used(const struct session *session, int piece)
{
	return piece >= 0 && session->document.pattern.piece[piece].used;
}

void tool_notice(struct tool *tool, enum text text);

/* ---- gesture_stroke.c ---- */

/* The contact's samples without the tremor, into ui->smooth_px: twice a running mean over 30 ms to
 * either side. Returns their number (stroke_count). */
int stroke_smooth(struct ui *ui);

/* Points at even distances along the line `in`, both ends included: at most `max` (>= 2), not
 * closer than `spacing`. Returns their number; 1 when the line has no length. */
int stroke_even(const struct v2 *in, int count, float spacing, struct v2 *out, int max);
float stroke_length(const struct v2 *line, int count);
float stroke_distance(const struct v2 *line, int count, struct v2 point);

/* The longest run of true in good[0 .. count); returns its length. */
int stroke_run(const bool *good, int count, int *first);

/* ---- tool_pick.c ---- */

struct worn_hit {
	int triangle; /* garment.triangle */
	float weight[3];
	struct v3 point_m;
	int piece;
	struct v2 local_mm;
};

/* Distances to reach for are millimetres on the screen. */
bool pick_edge(const struct ui *ui, const struct session *session, struct v2 position_px,
	       float reach_mm, struct edge_ref *edge, float *fraction);
int pick_seam(const struct ui *ui, const struct session *session,
	      struct v2 position_px); /* or -1 */
int pick_cloth_mark(const struct ui *ui, const struct session *session, struct v2 position_px);
int pick_body_mark(const struct ui *ui, const struct session *session, struct v2 position_px);
int pick_pin(const struct ui *ui, const struct session *session, struct v2 position_px); /* or -1 */

/* The worn garment, where it lies in front of the body. */
bool pick_worn(const struct ui *ui, const struct session *session, struct v2 position_px,
	       struct worn_hit *hit);
/* The first surface under a position, or the last one, seen from within (laser mode's other side).
 */
bool pick_body_side(const struct ui *ui, const struct session *session, struct v2 position_px,
		    bool back, struct body_hit *hit);
bool pick_body(const struct ui *ui, const struct session *session, struct v2 position_px,
	       struct body_hit *hit);

/* Where the letter of one side of a seam stands, on the screen: off the edge's middle, outside. */
struct v2 seam_badge_px(const struct ui *ui, const struct pattern *pattern, const struct seam *seam,
			int side);
int seam_of_edge(const struct pattern *pattern, struct edge_ref edge); /* or -1 */

/* The outline's corner within reach of a position; -1: none. */
int pick_corner(const struct ui *ui, const struct piece *piece, struct v2 position_px);

/* The sheet rectangle that a piece covers. */
void piece_bounds(const struct piece *piece, struct v2 *low_mm, struct v2 *high_mm);

/* ---- one file a step ---- */

enum gesture tool_draw_begin(struct tool *tool);
void tool_name_piece(struct tool *tool, struct edit *edit);
void tool_select_at(struct tool *tool); /* the piece under the contact's start, or none */
void tool_draw_end(struct tool *tool);
void tool_draw_tap(struct tool *tool);
void tool_draw_target(struct tool *tool, enum target target);

/* ---- tool_shape.c ---- */

/* Where a grip of the box round a piece is seen (GRIP_SIZE, GRIP_WIDTH, GRIP_TURN). */
struct v2 grip_px(const struct ui *ui, const struct piece *piece, enum grip grip, int which);
/* Is there room for grips in the middle of those sides? */
bool grip_fits(const struct ui *ui, const struct piece *piece, int side);
enum grip pick_grip(const struct ui *ui, const struct session *session, struct v2 position_px,
		    int *which);

/* Takes hold of something: GESTURE_SHAPE. */
enum gesture shape_begin(struct tool *tool, enum grip grip, int which);
void tool_shape_move(struct tool *tool);
void tool_shape_end(struct tool *tool);

/* To the next multiple of 15 degrees, if it is near. */
float shape_snapped_turn(float turn_rad);

/* The draft becomes the document after the edit. */
void shape_try(struct tool *tool, const struct edit *edit);

/* What the sheet shows: the draft of a shape, or the document. */
static inline const struct document *shown_document(const struct ui *ui,
						    const struct session *session)
{
	return ui->shaping.shows ? &ui->shaping.draft : &session->document;
}

/* ---- tool_refused.c ---- */

/* Says why the stroke in progress was not taken, in words and where it lies. */
void stroke_refused(struct tool *tool, const char *reason);

/* ---- tool_points.c ---- */

enum gesture tool_points_begin(struct tool *tool);
enum grip points_hover(const struct tool *tool, int *which); /* what the pen would take */
void tool_points_move(struct tool *tool);
void tool_points_tap(struct tool *tool);
bool tool_points_take(struct tool *tool); /* the corner under the contact's start is chosen */
void tool_points_delete(struct tool *tool);

/* ---- tool_snap.c ---- */

/* A corner's place on the sheet, drawn to other corners, to the axis of a symmetric piece, and to
 * lines through its neighbours at multiples of 45 degrees. Notes the lines in ui->shaping. */
/* A shift of the selected piece, drawn to where a side or the middle of its box lies in line with
 * that of another. */
struct v2 snap_move(struct tool *tool, struct v2 move_mm);
struct v2 snap_corner(struct tool *tool, const struct piece *piece, int corner, struct v2 sheet_mm);

enum gesture tool_sew_begin(struct tool *tool);
void tool_sew_move(struct tool *tool);
void tool_sew_end(struct tool *tool);
void tool_sew_tap(struct tool *tool);
void tool_sew_target(struct tool *tool, enum target target);

enum gesture tool_mark_begin(struct tool *tool, bool on_sheet);
void tool_mark_end(struct tool *tool);
void tool_mark_tap(struct tool *tool, bool on_sheet);

enum gesture tool_adjust_begin(struct tool *tool);
void tool_adjust_frame(struct tool *tool);
void tool_adjust_end(struct tool *tool);
void tool_adjust_tap(struct tool *tool, bool on_sheet);
void tool_adjust_pin_here(struct tool *tool);

/* A stroke or tap of ERASE or of the pen's other end, in any step. */
void tool_erase(struct tool *tool, bool on_sheet, bool tap);

/* ---- gesture.c ---- */

void gesture_samples(struct tool *tool, const struct frame_input *input);
void gesture_target(struct tool *tool, enum target target); /* ui.c: a target was chosen */

#endif
