/* What the files of the picture share. Every GL object hangs on one of these structs and can be
 * made again from CPU data. */
#ifndef DRAW_PRIVATE_H
#define DRAW_PRIVATE_H

#include "draw.h"
#include "draw_gl.h"
#include "draw_layer.h"

enum {
	FRINGE_VERTICES_MAX = 32768,
	RIBBON_VERTICES_MAX = 49152, /* 1.5 MB: seams, hems, marks, all at once */
	SPRITES_MAX = 160,
	SHADOW_SIZE = 512,
	SHADOW_SIZE_FINE = 2048,
	MARK_SAMPLES_MAX = 96,
	BODY_LINE_POINTS_MAX = 128,
	HAND_POINTS_MAX = 1024,
	EDGE_TABLE_SIZE = 1 << 16,
	COVER_QUEUE = BODY_VERTICES_MAX, /* each vertex waits at most once */
};

/* How much deeper than it is the body is taken to be, so that cloth on it hides it. */
static const float body_bias_m = 0.007f;

/* The eye, as matrices. */
struct camera {
	float world_to_clip[16]; /* column-major */
	float world_to_axes[9];  /* column-major 3x3: right, up, towards the viewer */
	float world_to_light[16];
	struct v3 eye_m, back; /* back: towards the viewer */
	float depth[2];        /* NDC depth of distance d is depth[0] - depth[1] / d */
	float px_per_m;        /* at distance 1 m */
	struct rect pane;
};

/* Lit surfaces: body and cloth. */
struct surface_program {
	GLuint program;
	GLint clip, axes, light, eye, depth, bias, shadow, weave, strength, pixel;
};

/* An edge of the garment with a triangle on one side only. */
struct rim {
	int a, b, inner; /* garment vertices; inner: the third corner of its triangle */
	bool sewn;       /* welded to another such edge */
};

struct edge_use {
	int a, b;     /* keys, a < b */
	int from, to; /* garment vertices in the first triangle's order */
	int inner;    /* as in rim */
	int triangle[2];
	int count, next;
};

/* Room to reorder a mesh in; see draw_order.c. */
struct mesh_order {
	int *triangle, *triangle_2; /* in the new order: old indices */
	uint32_t *key, *key_2;
	int *rank; /* per old vertex: its new index */
};

/* How far body vertices are from cloth that lies on them; see draw_cover.c. */
struct body_cover {
	GLuint materials; /* openness to the sky, with cloth: 4 bytes a vertex, as drawn */
	uint8_t *material;
	int *drawn_as; /* per body vertex: its place in the buffers */
	float *distance_m;
	uint8_t *waiting; /* in the queue */
	int *queue;       /* a ring of COVER_QUEUE */
	int sweep;        /* of the cloth, when this was made; -1: never */
	bool worn;
};

struct draw_body {
	GLuint vertices, indices;
	int index_count;
	GLuint caster_vertices, caster_indices; /* a coarse copy that casts the shadows */
	int caster_count;
	int caster_vertex_count;
	struct v3 *caster_m, *caster_normal;
	float *caster_open, *open_next; /* room to bake open_sky in */
	struct surface_program program;
	struct body_vertex *vertex; /* BODY_VERTICES_MAX */
	uint16_t *index;
	float *open_sky; /* per body vertex: 0 closed in, 1 free */
	struct body_cover cover;
	uint64_t hash; /* of the body that was uploaded */
	bool stale;
};

struct body_vertex {
	struct v3 position_m;
	struct v3 normal;
};

struct cloth_fixed {
	float place[2]; /* in widths of the weave */
	uint8_t outside[4], inside[4];
};

struct cloth_vertex {
	struct v3 position_m;
	struct v3 normal;
	uint8_t material[4]; /* openness, glow */
};

struct draw_cloth {
	GLuint moving, fixed, indices;
	struct surface_program program;
	GLuint weave;
	int index_count;
	GLuint caster_indices; /* fewer triangles between the same vertices cast the shadows */
	int caster_count;
	int *caster;                 /* per vertex: the vertex that stands for it there */
	struct cloth_vertex *vertex; /* GARMENT_VERTICES_MAX */
	struct cloth_fixed *rest;
	uint16_t *index;
	struct v3 *normal;
	float *crease;   /* per vertex: > 0 in a valley */
	struct v2 *soft; /* per vertex: sum of the creases about it, and their count */
	int *born;       /* frame in which the vertex was laid on the body; -1: not yet */
	/* a copy of what was uploaded, to see changes */
	int vertex_count, triangle_count, placed_count;
	struct v2 *seen_rest_m;
	struct triangle *seen_triangle;
	int swatch[PIECES_MAX];
	/* rims: edges of one triangle only, once seams are closed */
	int rim_count;
	struct rim *rim;
	int edge_count;
	int *edge_table;           /* hash of an edge -> edge_use */
	struct edge_use *edge_use; /* by particles, once rims are known */
	uint8_t *stitched;         /* per vertex: on the side of a seam that shows its stitches */
	int8_t *seam;              /* per vertex: pattern.seam, -1: none */
	bool rims_known, rims_welded;
};

enum dash_row {
	DASH_SOLID,
	DASH_MARK_2, /* and on: the styles of look.h */
	DASH_STITCH = MARK_STYLES,
	DASH_PULL,
	DASH_ROWS,
};

struct ribbon_vertex {
	struct v3 position_m;
	uint8_t colour[4]; /* premultiplied */
	float along;       /* in periods of the dash */
	float row;         /* of the dash texture, 0..1 */
	float across_px, half_px;
};

struct ribbons {
	GLuint vertices, dashes, program;
	GLint clip, depth, bias;
	int count; /* vertices, 4 a segment */
	struct ribbon_vertex *vertex;
};

/* How a line looks. */
struct stroke {
	uint32_t colour;
	float alpha;
	float half_px;
	enum dash_row row;
	float period; /* metres or pixels, as `along` is counted */
};

/* A corner of an outline's fringe: a surface's vertex, and where it is moved to. */
struct fringe_vertex {
	struct v3 position_m, normal;
	float shift_px[2], cover, side;
	float place[2];
	uint8_t material[4], colour[4], colour_2[4];
};

struct fringe {
	GLuint vertices;
	struct surface_program body, cloth;
	int count;
	struct fringe_vertex *vertex; /* 4 a segment */
	uint8_t *facing;              /* per triangle: seen from its front */
};

struct sprite_vertex {
	float clip[4];
	float place[2];
	uint8_t colour[4]; /* multiplies the picture */
};

struct sprites {
	GLuint vertices, atlas, program;
	int count; /* 4 vertices a sprite */
	struct sprite_vertex *vertex;
};

struct shadow {
	GLuint framebuffer, texture, program;
	GLint clip;
	int size; /* 0: no shadows */
};

/* A picture made on the processor. */
struct plate {
	GLuint texture, framebuffer;
	GLenum format;
	int width, height;
	bool bottom_up, copies;
};

struct room {
	struct plate backdrop;
	GLuint floor, quad, program, floor_program;
	GLint place, cut, floor_clip, floor_half, floor_cut;
	uint8_t *pixels; /* the backdrop */
	float floor_half_m;
	float floor_part[4]; /* low corner and size of what is shaded, of a floor 1 x 1 */
};

/* A place on the garment that rides with it. */
struct ride {
	int triangle; /* garment.triangle; -1: lost */
	float weight[3];
};

/* Has the wrap laid all of a triangle on the body? */
static inline bool laid(const uint8_t *placed, const struct triangle *triangle)
{
	return placed[triangle->v[0]] && placed[triangle->v[1]] && placed[triangle->v[2]];
}

struct draw_marks {
	struct marks seen;
	struct pin seen_pin[PINS_MAX];
	int ride_count[MARKS_MAX];
	struct ride ride[MARKS_MAX][MARK_SAMPLES_MAX];
	struct ride pin[PINS_MAX];
	int line_count[MARKS_MAX]; /* body marks, laid onto the surface */
	struct v3 line_m[MARKS_MAX][BODY_LINE_POINTS_MAX];
	struct v3 line_normal[MARKS_MAX][BODY_LINE_POINTS_MAX];
	bool stale;
};

struct draw {
	int width, height;
	GLint target;            /* the framebuffer that the frame goes to */
	struct mesh_order order; /* BODY_TRIANGLES_MAX, BODY_VERTICES_MAX */
	GLuint quads;            /* indices of RIBBON_VERTICES_MAX / 4 quads */
	struct camera camera;
	struct room room;
	struct draw_body body;
	struct draw_cloth cloth;
	struct ribbons ribbons;
	struct fringe fringe;
	struct sprites sprites;
	struct shadow shadow;
	struct draw_marks marks;
	struct sheet *sheet;
	struct chrome *chrome;
	const struct layer *sheet_layer, *chrome_layer; /* of this frame */
	struct plate sheet_plate, chrome_plate;
	struct service_sheet *service; /* NULL: the page is closed */
	struct plate service_plate;
	struct notice_sheet *notice; /* NULL: none */
	struct plate notice_plate;
	struct take_home_sheet *take_home;
	struct plate take_home_plate;
	struct portrait *portrait; /* NULL: none is being drawn */
	uint8_t *rows;             /* a screenful, on its way up */
	float px;                  /* one pixel of the look's drawing (1080 lines) on this screen */
	bool bones;
	bool software; /* processors do the GPU's work */
};

void camera_make(struct camera *camera, const struct view *view, const struct body *body);

/* Where a point is on the screen in clip coordinates, moved towards the viewer by lift_m. */
void camera_clip(const struct camera *camera, struct v3 point_m, float lift_m, float clip[4]);

bool surface_open(struct surface_program *surface, bool cloth, bool fringe, char fault[200]);
void surface_use(const struct surface_program *surface, const struct draw *draw, float bias_m);

/* The stages of draw_frame that are measured one by one (tests/bench_draw.c). */
void pane_enter(const struct draw *draw, const struct rect *pane);
void background_draw(struct draw *draw, const struct ui *ui, const struct session *session);
void lines_draw(struct draw *draw, const struct ui *ui, const struct session *session);
void overlays_draw(struct draw *draw);

/* What is to be drawn follows the session, seen from here; the shadow is cast. */
void figure_follow(struct draw *draw, const struct view *view, const struct session *session);

void mesh_order(struct mesh_order *mesh, const struct v3 *position_m, int vertex_count,
		const struct triangle *triangle, int triangle_count);

/* Vertices that share a cell become one, at their mean; rank says which. Returns how many are left
 * (in coarse_m). Rough, and good enough for what casts a soft shadow. `triangle` then holds the
 * vertices, cell by cell. */
int mesh_coarsen(struct mesh_order *mesh, const struct v3 *position_m, int vertex_count,
		 float cell_m, struct v3 *coarse_m);

bool room_open(struct draw *draw, char fault[200]);
void room_release(struct draw *draw);
void room_floor_changed(struct draw *draw, const struct body *body);
void room_copy(struct draw *draw, const struct rect *pane);
void room_draw(struct draw *draw);

bool body_open(struct draw *draw, char fault[200]);
void body_release(struct draw *draw);
void body_upload(struct draw *draw, const struct body *body);
/* What cloth on the body takes of its light. */
bool cover_open(struct body_cover *cover);
void cover_release(struct body_cover *cover);
void cover_changed(struct draw *draw, const struct body *body);
void cover_follow(struct draw *draw, const struct session *session);

void body_cast(const struct draw *draw);
void body_draw(struct draw *draw);

bool cloth_open(struct draw *draw, char fault[200]);
void cloth_release(struct draw *draw);
void cloth_upload(struct draw *draw, const struct session *session);
void cloth_cast(const struct draw *draw);
void cloth_draw(struct draw *draw);

/* Soft outlines: what multisampling would do, for the price of the outline alone. */
bool fringe_open(struct draw *draw, char fault[200]);
void fringe_release(struct draw *draw);
void fringe_body_draw(struct draw *draw, const struct body *body);
void fringe_cloth_draw(struct draw *draw, const struct session *session);

/* Finds rims and edges of the garment when it or its seams have changed. */
void trim_follow(struct draw *draw, const struct session *session);

/* Seams, stitches and hems of the worn garment, as ribbons. */
void trim_add(struct draw *draw, const struct ui *ui, const struct session *session);

bool shadow_open(struct draw *draw, char fault[200]);
void shadow_draw(struct draw *draw);

bool ribbons_open(struct draw *draw, char fault[200]);
void ribbons_release(struct draw *draw);
void ribbons_begin(struct draw *draw);

/* A line through points, each lifted off its surface along its normal by lift_m (normal NULL: not).
 * Lines on a surface fade where it turns away. Dashes are counted in pixels from the line's start.
 * Drops what does not fit. */
void ribbons_line(struct draw *draw, const struct v3 *point_m, const struct v3 *normal, int count,
		  float lift_m, const struct stroke *stroke);

/* One segment whose dashes are counted in metres from along_m. */
void ribbons_segment(struct draw *draw, struct v3 a_m, struct v3 b_m, float along_m,
		     const struct stroke *stroke);

/* Draws what was added since ribbons_begin, nearer to the eye by lift_m. */
void ribbons_draw(struct draw *draw, float lift_m);

bool sprites_open(struct draw *draw, char fault[200]);
void sprites_release(struct draw *draw);
void sprites_begin(struct draw *draw);
void sprites_draw(struct draw *draw, bool over_everything);
void sprite_number(struct draw *draw, struct v3 point_m, int number);
void sprite_pin(struct draw *draw, struct v3 head_m);
void sprite_ring(struct draw *draw, struct v2 centre_px, float radius_px, uint32_t colour);

void marks_add(struct draw *draw, const struct ui *ui, const struct session *session);
void hand_add(struct draw *draw, const struct ui *ui, const struct session *session);
void bones_add(struct draw *draw, const struct body *body);

void portrait_release(struct draw *draw);

bool plate_open(struct draw *draw, struct plate *plate, int width, int height);

/* Takes a rectangle of a picture (top row first, cairo's bytes) of the plate's size. */
void plate_upload(struct draw *draw, struct plate *plate, const uint8_t *pixels, int stride,
		  const struct rect *rect);

/* Shows a rectangle of the plate at screen position x, y: copied, or blended as GL is set. */
void plate_copy(const struct draw *draw, const struct plate *plate, const struct rect *from, int x,
		int y);
void plate_quad(const struct draw *draw, const struct plate *plate, const struct rect *from, int x,
		int y);

void layer_take(struct draw *draw, struct plate *plate, const struct layer *layer);
void layer_draw(struct draw *draw, const struct plate *plate, const struct layer *layer,
		bool opaque);

#endif
