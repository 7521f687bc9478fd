/* The camera of the left pane and the scale of the sheet.
 *
 * Camera axes are right, up and towards the viewer; the eye lies distance_m from the centre along
 * the third. A point p is seen at  pane centre + f h (x, -y) / depth  with (x, y, -depth) the axes'
 * components of p - eye, f the focal length and h the pane's height.
 */
#include "ui.h"

#define SHEET_WIDTH_MM 1760.0f /* of the whole pane, at first */

static struct v2 rect_centre(struct rect rect)
{
	return (struct v2){(float)rect.x + 0.5f * (float)rect.w,
			   (float)rect.y + 0.5f * (float)rect.h};
}

struct v3 view_eye(const struct view *view)
{
	return v3_mad(view->centre_m, view->turn.row[2], view->distance_m);
}

void view_look(struct view *view, float azimuth_rad)
{
	float s = angle_sin(azimuth_rad), c = angle_cos(azimuth_rad);
	view->turn.row[0] = (struct v3){c, 0.0f, -s};
	view->turn.row[1] = (struct v3){0.0f, 1.0f, 0.0f};
	view->turn.row[2] = (struct v3){s, 0.0f, c};
}

void view_init(struct view *view, const struct layout *layout)
{
	memset(view, 0, sizeof *view);
	view->pane = layout->left;
	view->sheet_pane = layout->right;
	view->focal = 2.2f;
	view->distance_m = 4.3f;
	view->centre_m = (struct v3){0.0f, 0.84f, 0.0f};
	view_look(view, 0.0f);
	view->sheet_px_per_mm = (float)layout->right.w / SHEET_WIDTH_MM;
}

/* A position on the trackball, in camera axes: a sphere that fills the pane's smaller side, and
 * Bell's hyperbola where it would fall away, so that the turn stays even outside of it. */
static struct v3 ball_point(const struct view *view, struct v2 position_px)
{
	struct v2 centre = rect_centre(view->pane);
	float radius = 0.5f * (float)int_min(view->pane.w, view->pane.h);
	struct v3 p = {(position_px.x - centre.x) / radius, (centre.y - position_px.y) / radius,
		       0.0f};
	float d2 = p.x * p.x + p.y * p.y;
	p.z = d2 < 0.5f ? sqrtf(1.0f - d2) : 0.5f / sqrtf(d2);
	return v3_normalize(p);
}

/* Gram and Schmidt, so that a day of turning leaves a rotation. */
static void orthonormalize(struct m3 *m)
{
	m->row[2] = v3_normalize(m->row[2]);
	m->row[1] = v3_normalize(v3_mad(m->row[1], m->row[2], -v3_dot(m->row[1], m->row[2])));
	m->row[0] = v3_cross(m->row[1], m->row[2]);
}

/* Hultquist, "A Virtual Trackball" (Graphics Gems, 1990): the turn that takes the first ball point
 * to the second. In camera axes the figure turns by it, so each column of `turn` does. */
void view_trackball(struct view *view, struct v2 from_px, struct v2 to_px)
{
	struct v3 a = ball_point(view, from_px), b = ball_point(view, to_px);
	struct v3 axis = v3_cross(a, b);
	float sine = v3_length(axis);
	if (sine < 1e-6f)
		return;
	axis = v3_scale(axis, 1.0f / sine);
	float angle_rad = angle_atan2(sine, v3_dot(a, b));
	struct m3 *t = &view->turn;
	struct v3 x = {t->row[0].x, t->row[1].x, t->row[2].x};
	struct v3 y = {t->row[0].y, t->row[1].y, t->row[2].y};
	struct v3 z = {t->row[0].z, t->row[1].z, t->row[2].z};
	x = v3_turn(x, axis, angle_rad);
	y = v3_turn(y, axis, angle_rad);
	z = v3_turn(z, axis, angle_rad);
	t->row[0] = (struct v3){x.x, y.x, z.x};
	t->row[1] = (struct v3){x.y, y.y, z.y};
	t->row[2] = (struct v3){x.z, y.z, z.z};
	orthonormalize(t);
}

void view_ray(const struct view *view, struct v2 position_px, struct v3 *origin_m,
	      struct v3 *direction)
{
	struct v2 centre = rect_centre(view->pane);
	float scale = 1.0f / (view->focal * (float)view->pane.h);
	struct v3 camera = {(position_px.x - centre.x) * scale, (centre.y - position_px.y) * scale,
			    -1.0f};
	*origin_m = view_eye(view);
	*direction = v3_normalize(m3_apply_transposed(&view->turn, camera));
}

bool view_project(const struct view *view, struct v3 point_m, struct v2 *position_px,
		  float *depth_m)
{
	struct v2 centre = rect_centre(view->pane);
	struct v3 camera = m3_apply(&view->turn, v3_sub(point_m, view_eye(view)));
	*depth_m = -camera.z;
	if (*depth_m < 1e-3f)
		return false;
	float scale = view->focal * (float)view->pane.h / *depth_m;
	*position_px = (struct v2){centre.x + camera.x * scale, centre.y - camera.y * scale};
	return true;
}

struct v2 view_sheet_mm(const struct view *view, struct v2 position_px)
{
	struct v2 centre = rect_centre(view->sheet_pane);
	float scale = 1.0f / view->sheet_px_per_mm;
	return (struct v2){view->sheet_centre_mm.x + (position_px.x - centre.x) * scale,
			   view->sheet_centre_mm.y + (centre.y - position_px.y) * scale};
}

struct v2 view_sheet_px(const struct view *view, struct v2 sheet_mm)
{
	struct v2 centre = rect_centre(view->sheet_pane);
	struct v2 d = v2_sub(sheet_mm, view->sheet_centre_mm);
	return (struct v2){centre.x + d.x * view->sheet_px_per_mm,
			   centre.y - d.y * view->sheet_px_per_mm};
}

void view_sheet_zoom(struct view *view, float factor, struct v2 about_mm)
{
	float before = view->sheet_px_per_mm, first = (float)view->sheet_pane.w / SHEET_WIDTH_MM;
	view->sheet_px_per_mm = float_clamp(before * factor, 0.4f * first, 16.0f * first);
	float share = before / view->sheet_px_per_mm;
	view->sheet_centre_mm = v2_lerp(about_mm, view->sheet_centre_mm, share);
}

void view_sheet_show(struct view *view, struct v2 low_mm, struct v2 high_mm)
{
	struct v2 half = {0.5f * (float)view->sheet_pane.w / view->sheet_px_per_mm,
			  0.5f * (float)view->sheet_pane.h / view->sheet_px_per_mm};
	struct v2 low = v2_sub(view->sheet_centre_mm, half);
	struct v2 high = v2_add(view->sheet_centre_mm, half);
	if (low_mm.x >= low.x && low_mm.y >= low.y && high_mm.x <= high.x && high_mm.y <= high.y)
		return;
	low = (struct v2){float_min(low.x, low_mm.x), float_min(low.y, low_mm.y)};
	high = (struct v2){float_max(high.x, high_mm.x), float_max(high.y, high_mm.y)};
	view->sheet_centre_mm = v2_lerp(low, high, 0.5f);
	view->sheet_px_per_mm = float_min((float)view->sheet_pane.w / (high.x - low.x),
					  (float)view->sheet_pane.h / (high.y - low.y));
}
