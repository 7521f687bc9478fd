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
	TARGET_HAND,  /* the tools change sides */
	TARGET_CLEAR, /* held for a second */
	TARGET_VIEW_FRONT,
	TARGET_VIEW_SIDE,
	TARGET_VIEW_BACK,
	TARGET_COPY,
	TARGET_TURN_OVER,
	TARGET_MIRROR,
	TARGET_DELETE, /* step 1: the selected piece; step 2: the selected seam */
	TARGET_SWAP,   /* step 2: the selected seam */
	TARGET_LASER,
	TARGET_ERASE, /* step 3 */
	TARGET_WRAP,
	TARGET_PIN,
	TARGET_RELAX, /* twins of the real buttons */
	TARGET_SWATCH_0,
	TARGET_SWATCH_7 = TARGET_SWATCH_0 + 7,
	TARGET_TOOL_PENCIL, /* step 1: what the pen does on the sheet, as enum drawing has it */
	TARGET_TOOL_POINTS,
	TARGET_TOOL_BOX,
	TARGET_TOOL_ROUND,
	TARGET_FOLD,     /* step 1: the selected piece is symmetric */
	TARGET_EVEN,     /* step 2: the selected seam's edges are kept equally long */
	TARGET_ZOOM_OUT, /* until all of the pattern is seen */
	TARGET_ZOOM_IN,
	TARGET_FINISH, /* makes the card to take home */
	TARGET_COUNT,
};

/* What the pen does on the sheet in step 1. */
enum drawing {
	DRAW_PENCIL, /* outlines; the selected piece has grips */
	DRAW_POINTS, /* corners and edges of the selected piece; the paper moves */
	DRAW_BOX,
	DRAW_ROUND,
};

struct layout {
	int width, height;
	enum step step;
	bool left_handed;
	struct rect bar, left, right, bottom, hint;
	struct rect meter;                /* strain, steps 4 and 5 */
	struct rect target[TARGET_COUNT]; /* w == 0: not on the screen in this step */
	float mm_per_px;                  /* of the real screen: 476 mm wide unless told */
};

/* Integer layout for a screen size (from 320 x 180 on) and a step, after the look's proportions.
 * For a left hand view buttons, swatches and tools change sides; the twins never do. */
void layout_make(struct layout *layout, int width, int height, enum step step, bool left_handed);
enum target layout_hit(const struct layout *layout, struct v2 position_px);

/* A length of the look's drawing (1920 x 1080) on this screen, rounded. */
int layout_px(const struct layout *layout, int px_at_1080);

static inline bool rect_holds(struct rect rect, struct v2 position_px)
{
	return position_px.x >= (float)rect.x && position_px.x < (float)(rect.x + rect.w) &&
	       position_px.y >= (float)rect.y && position_px.y < (float)(rect.y + rect.h);
}

/* The camera of the left pane: a virtual trackball about a point (S5; Hultquist). Orthographic
 * enough to read, perspective enough to look real. Arithmetic of src only. */
struct view {
	struct rect pane;
	struct m3 turn;     /* world to camera axes: right, up, towards the viewer */
	struct v3 centre_m; /* looked at */
	float distance_m;
	float focal;               /* pane heights */
	struct v2 sheet_centre_mm; /* right pane: sheet point at its middle */
	float sheet_px_per_mm;
	struct rect sheet_pane;
};

/* The whole of a 1.7 m figure from the front; a sheet 1.76 m wide about its origin. */
void view_init(struct view *view, const struct layout *layout);

/* Looks from azimuth_rad round the vertical axis: 0 the front, pi/2 the wearer's left. */
void view_look(struct view *view, float azimuth_rad);

/* Turns the figure as if the pen had rolled a ball from one position to another. */
void view_trackball(struct view *view, struct v2 from_px, struct v2 to_px);

/* The eye and the unit direction through a screen position. */
void view_ray(const struct view *view, struct v2 position_px, struct v3 *origin_m,
	      struct v3 *direction);
/* Screen position; false when behind the camera. depth_m: along the view axis. */
bool view_project(const struct view *view, struct v3 point_m, struct v2 *position_px,
		  float *depth_m);
struct v3 view_eye(const struct view *view);
struct v2 view_sheet_mm(const struct view *view, struct v2 position_px);
struct v2 view_sheet_px(const struct view *view, struct v2 sheet_mm);

/* Nearer by a factor (below 1: farther), about a sheet place that stays where it is seen. From 0.4
 * to 16 times the first scale. */
void view_sheet_zoom(struct view *view, float factor, struct v2 about_mm);

/* Widens the sheet (never narrows it) until the rectangle lies within the pane. */
void view_sheet_show(struct view *view, struct v2 low_mm, struct v2 high_mm);

enum gesture {
	GESTURE_NONE,
	GESTURE_WAIT,   /* touching a pane; too early to say what it is */
	GESTURE_TARGET, /* pressed on a target; acts on release inside */
	GESTURE_TRACKBALL,
	GESTURE_PIECE, /* drawing an outline */
	GESTURE_OVERSKETCH,
	GESTURE_MOVE,  /* moving a piece */
	GESTURE_SHAPE, /* a grip, a corner or an edge of the selected piece; a ready shape */
	GESTURE_SEW,
	GESTURE_MARK_CLOTH,
	GESTURE_MARK_BODY,
	GESTURE_MARK_WORN,
	GESTURE_DRAG, /* surface drag of the garment */
	GESTURE_ERASE,
	GESTURE_PAN,
	GESTURE_IDLE, /* touching, and nothing comes of it */
};

/* What GESTURE_SHAPE has hold of. */
enum grip {
	GRIP_NONE,
	GRIP_SIZE,   /* a corner of the box round the piece: 0..3, counter-clockwise from low */
	GRIP_WIDTH,  /* a side of that box: 0 the lower one, on counter-clockwise */
	GRIP_TURN,   /* above the box */
	GRIP_CORNER, /* of the outline, by number */
	GRIP_EDGE,
	GRIP_READY, /* the far corner of a new box or ellipse */
};

enum { GUIDES_MAX = 2 };

/* The edit that a pen in GESTURE_SHAPE would make if it were lifted now. */
struct shaping {
	bool shows; /* draft is drawn in place of the document */
	enum grip grip;
	int which;
	struct edit edit;
	const char *fault; /* why it would be refused */
	uint32_t changed;  /* pieces of the draft that differ */
	float turned_rad;  /* GRIP_TURN: the piece's turn */
	struct v2 size_mm; /* of the piece, or of the ready shape */
	int guide_count;   /* lines that the point has snapped to, on the sheet */
	struct v2 guide_mm[GUIDES_MAX][2];
	struct document draft;
};

enum { REFUSED_POINTS_MAX = 96 };

/* A stroke that was not taken stays for a while, with the place that is at fault. */
struct refused {
	bool shows;
	int frame;
	enum fault {
		FAULT_OTHER,
		FAULT_CROSSES, /* at[0]: where */
		FAULT_OPEN,    /* at[0], at[1]: the ends */
		FAULT_SMALL,   /* at[0]: its middle */
	} fault;
	struct v2 at_mm[2]; /* on the sheet */
	int count;
	struct v2 line_mm[REFUSED_POINTS_MAX];
};

struct ui {
	struct layout layout;
	struct view view;
	enum step step;
	enum language language;
	bool left_handed;
	bool laser, erase;
	bool pin_mode; /* pin_toggled by the twin, or the real button is held */
	bool pin_toggled;
	int piece, seam; /* selected; -1: none */
	int corner;      /* of the selected piece, DRAW_POINTS; -1: none */
	enum drawing drawing;
	bool zoomed; /* by hand: the paper no longer grows by itself */
	int swatch;  /* of the next piece */

	/* The pen, and the contact in progress: raw samples, thinned never. */
	struct v2 pen_px; /* last position */
	enum pen_state pen_state;
	float pen_pressure;
	bool eraser; /* the contact is by the pen's other end, or ERASE is on */
	enum gesture gesture;
	enum target pressed;
	int64_t press_us, last_us;
	bool moved; /* farther than a tap */
	int stroke_count;
	struct v2 stroke_px[STROKE_SAMPLES_MAX];
	struct v2 smooth_px[STROKE_SAMPLES_MAX]; /* room to work in; valid within one update */
	struct v2 start_px;                      /* mean of the first samples */
	struct v2 steady_px;                     /* mean of the last few samples */
	int hold_frames;                         /* how long a held target has been held */

	/* What the gesture in progress is about. */
	struct v2 move_mm; /* GESTURE_MOVE: shift of the piece so far */
	struct shaping shaping;
	struct refused refused;
	struct {
		int piece, edge; /* -1: none */
	} sew_from, sew_to;
	struct v3 grab_m; /* depth plane of a drag */
	bool grabbed;     /* EDIT_GRAB was sent, in frame grab_frame */
	int grab_frame;
	bool grab_on_body;

	/* What lies under the pen: for highlights only. -1: nothing. */
	enum target hover_target;
	int hover_piece, hover_edge, hover_seam;
	enum grip hover_grip; /* a grip or a point of the selected piece */
	int hover_which;
	int hover_triangle; /* garment.triangle under the pen, in front of the body */
	bool hover_body;
	struct v3 hover_m; /* the point on cloth or body */

	/* What was there last frame, so that new things can be selected. */
	uint32_t pieces_seen;
	uint64_t seams_seen;
	bool select_new;
	bool was_worn, had_pair;
	bool sent; /* edits went out: session->notice speaks of them */

	int frame;               /* for motion that explains; counts ui_update calls */
	int pulse[TARGET_COUNT]; /* frame at which a target became useful; 0: not */
	struct {
		bool open;   /* the page with the card lies over all */
		int count;   /* times it was opened */
		bool leave;  /* the visitor has done with it: the next one may come */
		int pressed; /* key, -1: none */
		bool down;   /* the pen touches, */
	} take_home;         /* take_home_page.h */
	uint8_t buttons_held;
	bool relax_wanted, relax_held; /* by hand; as last told to the session */
	int notice;                    /* enum text: a line for the visitor; 0: the step's hint */
	int notice_frame;
};

void ui_init(struct ui *ui, int width, int height);

/* One frame's input to edits. Pure: reads the session, changes only ui, adds to the list. */
void ui_update(struct ui *ui, const struct frame_input *input, const struct session *session,
	       struct edit_list *edits);

/* Would pressing this target do something now? Dim ones are drawn so. */
bool ui_useful(const struct ui *ui, const struct session *session, enum target target);

/* Goes to a step by itself (the attract loop, tests). */
void ui_step(struct ui *ui, enum step step);

#endif
