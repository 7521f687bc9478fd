/* The face: what the visitor does becomes edits; the document and the garment become a picture. */
#ifndef UI_H
#define UI_H

#include "input.h"
#include "session.h"

/* The five steps along the top; a step is the only mode there is (look: five numbered steps). */
enum step {
	STEP_DRAW,
	STEP_SEW,
	STEP_MARK,
	STEP_DRESS,
	STEP_ADJUST,
	STEP_COUNT,
};

enum language {
	LANGUAGE_BOTH, /* Japanese over English */
	LANGUAGE_JAPANESE,
	LANGUAGE_ENGLISH,
};

struct rect {
	int x, y, w, h; /* pixels, y down */
};

/* Everything that can be tapped. Rectangles come from ui_layout alone, never from text. */
enum target {
	TARGET_NONE,
	TARGET_STEP_DRAW,
	TARGET_STEP_SEW,
	TARGET_STEP_MARK,
	TARGET_STEP_DRESS,
	TARGET_STEP_ADJUST,
	TARGET_UNDO,
	TARGET_REDO,
	TARGET_LANGUAGE,
	TARGET_CLEAR,
	TARGET_VIEW_FRONT,
	TARGET_VIEW_SIDE,
	TARGET_VIEW_BACK,
	TARGET_COPY,
	TARGET_TURN_OVER,
	TARGET_MIRROR,
	TARGET_DELETE, /* step 1: the selected piece */
	TARGET_SWAP,   /* step 2: the last seam */
	TARGET_LASER,
	TARGET_ERASE, /* step 3 */
	TARGET_WRAP,
	TARGET_PIN,
	TARGET_RELAX, /* twins of the real buttons */
	TARGET_SWATCH_0,
	TARGET_SWATCH_7 = TARGET_SWATCH_0 + 7,
	TARGET_COUNT,
};

struct layout {
	int width, height;
	struct rect bar, left, right, bottom, hint;
	struct rect target[TARGET_COUNT]; /* w == 0: not on the screen in this step */
};

/* Integer layout for a screen size and a step, after the look's proportions. */
void layout_make(struct layout *layout, int width, int height, enum step step);
enum target layout_hit(const struct layout *layout, struct v2 position_px);

/* The camera of the left pane: a virtual trackball about a point (S5; Hultquist). Orthographic
 * enough to read, perspective enough to look real. Arithmetic of src only. */
struct view {
	struct rect pane;
	struct m3 turn;     /* world to camera axes */
	struct v3 centre_m; /* looked at */
	float distance_m;
	float focal;               /* pane heights */
	struct v2 sheet_centre_mm; /* right pane: sheet point at its middle */
	float sheet_px_per_mm;
	struct rect sheet_pane;
};

void view_ray(const struct view *view, struct v2 position_px, struct v3 *origin_m,
	      struct v3 *direction);
/* Screen position; false when behind the camera. depth_m: along the view axis. */
bool view_project(const struct view *view, struct v3 point_m, struct v2 *position_px,
		  float *depth_m);
struct v2 view_sheet_mm(const struct view *view, struct v2 position_px);
struct v2 view_sheet_px(const struct view *view, struct v2 sheet_mm);

enum gesture {
	GESTURE_NONE,
	GESTURE_TRACKBALL,
	GESTURE_TARGET, /* pressed on a target; acts on release inside */
	GESTURE_PIECE,  /* drawing an outline */
	GESTURE_OVERSKETCH,
	GESTURE_MOVE, /* moving a piece */
	GESTURE_SEW,
	GESTURE_MARK_CLOTH,
	GESTURE_MARK_BODY,
	GESTURE_MARK_WORN,
	GESTURE_DRAG, /* surface drag of the garment */
	GESTURE_PAN,
};

struct ui {
	struct layout layout;
	struct view view;
	enum step step;
	enum language language;
	enum gesture gesture;
	bool laser, erase;
	bool pin_mode;   /* the PIN twin toggles, the real button holds */
	int piece, seam; /* selected; -1: none */
	enum target pressed;
	int stroke_count; /* of the gesture in progress */
	struct v2 stroke_px[STROKE_SAMPLES_MAX];
	struct v2 pen_px; /* last position */
	enum pen_state pen_state;
	float pen_pressure;
	struct v3 grab_m; /* depth plane of a drag */
	int hover_piece, hover_edge, hover_triangle;
	float hover_fraction;
	struct v2 move_from_mm; /* GESTURE_MOVE */
	struct {
		int piece, edge;
	} sew_from;
	int frame;               /* for motion that explains; counts ui_update calls */
	int pulse[TARGET_COUNT]; /* frame at which a target became useful; 0: not */
	uint8_t buttons_held;
	const char *notice; /* a line for the visitor, from a static table; NULL: the step's hint */
	int notice_frame;
};

void ui_init(struct ui *ui, int width, int height);

/* One frame's input to edits. Pure: reads the session, changes only ui, adds to the list. */
void ui_update(struct ui *ui, const struct frame_input *input, const struct session *session,
	       struct edit_list *edits);

#endif
