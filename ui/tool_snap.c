/* Pieces lie best in line with others. A corner lies best where another one lies, on the axis of a
 * symmetric piece, or straight above, beside or at 45 degrees from its neighbours. */
#include "pattern_shape.h"
#include "tool.h"

static const float snap_mm = 1.8f; /* of the screen */

struct ray {
	struct v2 through, way; /* on the sheet */
};

static float off_ray(struct ray ray, struct v2 p)
{
	return float_abs(v2_cross(ray.way, v2_sub(p, ray.through)));
}

static struct v2 onto_ray(struct ray ray, struct v2 p)
{
	float along = v2_dot(ray.way, v2_sub(p, ray.through));
	return v2_add(ray.through, v2_scale(ray.way, along));
}

static bool crossing(struct ray a, struct ray b, struct v2 *at)
{
	float sine = v2_cross(a.way, b.way);
	if (float_abs(sine) < 0.2f)
		return false;
	float along = v2_cross(v2_sub(b.through, a.through), b.way) / sine;
	*at = v2_add(a.through, v2_scale(a.way, along));
	return true;
}

static void note(struct shaping *shaping, struct v2 from, struct v2 to)
{
	if (shaping->guide_count == GUIDES_MAX)
		return;
	shaping->guide_mm[shaping->guide_count][0] = from;
	shaping->guide_mm[shaping->guide_count++][1] = to;
}

/* The corner of another piece within reach. */
static bool near_corner(const struct tool *tool, struct v2 sheet_mm, float reach, struct v2 *at)
{
	bool found = false;
	for (int p = 0; p < PIECES_MAX; p++) {
		const struct piece *piece = &tool->session->document.pattern.piece[p];
		if (!piece->used || p == tool->ui->piece)
			continue;
		for (int i = 0; i < piece->point_count; i++) {
			struct v2 corner = piece_to_sheet(piece, piece->point_mm[i]);
			float distance = v2_distance(corner, sheet_mm);
			if (!piece->corner[i] || distance >= reach)
				continue;
			reach = distance;
			*at = corner;
			found = true;
		}
	}
	return found;
}

static int gather_rays(const struct piece *piece, int corner, struct ray ray[9])
{
	int edges = piece_edge_count(piece), count = 0;
	for (int side = 0; side < 2 && edges > 1; side++) {
		int neighbour = (corner + (side ? 1 : edges - 1)) % edges;
		struct v2 through = piece_to_sheet(piece, piece_corner_mm(piece, neighbour));
		for (int k = 0; k < 4; k++) {
			float angle = 0.25f * PI_F * (float)k;
			ray[count++] = (struct ray){through, {angle_cos(angle), angle_sin(angle)}};
		}
	}
	if (piece->symmetric) {
		struct v2 way = {angle_cos(piece->axis_rad), angle_sin(piece->axis_rad)};
		struct v2 from = piece_to_sheet(piece, piece->axis_mm);
		struct v2 to = piece_to_sheet(piece, v2_add(piece->axis_mm, way));
		ray[count++] = (struct ray){from, v2_sub(to, from)};
	}
	return count;
}

struct v2 snap_corner(struct tool *tool, const struct piece *piece, int corner, struct v2 sheet_mm)
{
	struct shaping *shaping = &tool->ui->shaping;
	float reach = tool_sheet_mm(tool->ui, snap_mm);
	struct ray ray[9];
	struct v2 at;
	shaping->guide_count = 0;
	if (near_corner(tool, sheet_mm, 1.6f * reach, &at)) {
		note(shaping, at, at);
		return at;
	}
	int count = gather_rays(piece, corner, ray), first = -1, second = -1;
	for (int i = 0; i < count; i++)
		if (off_ray(ray[i], sheet_mm) < reach &&
		    (first < 0 || off_ray(ray[i], sheet_mm) < off_ray(ray[first], sheet_mm)))
			first = i;
	if (first < 0)
		return sheet_mm;
	struct v2 snapped = onto_ray(ray[first], sheet_mm);
	for (int i = 0; i < count; i++)
		if (i != first && crossing(ray[first], ray[i], &at) &&
		    v2_distance(at, sheet_mm) < 1.6f * reach)
			second = i;
	if (second >= 0)
		crossing(ray[first], ray[second], &snapped);
	note(shaping, ray[first].through, snapped);
	if (second >= 0)
		note(shaping, ray[second].through, snapped);
	return snapped;
}

/* ---- whole pieces ---- */

/* One axis of a box: its low side, its middle, its high side. */
static float line_of(float low, float high, int line)
{
	return line == 0 ? low : line == 2 ? high : 0.5f * (low + high);
}

/* Of the other pieces' sides and middles the one that is nearest in line; what is missing to it. */
static bool in_line(const struct tool *tool, bool across, float low, float high, float reach,
		    float *missing, int *with, float *at)
{
	bool found = false;
	for (int p = 0; p < PIECES_MAX; p++) {
		const struct piece *piece = &tool->session->document.pattern.piece[p];
		struct v2 a, b;
		if (!piece->used || p == tool->ui->piece)
			continue;
		piece_bounds(piece, &a, &b);
		for (int line = 0; line < 3; line++) {
			float there = across ? line_of(a.x, b.x, line) : line_of(a.y, b.y, line);
			float by = there - line_of(low, high, line);
			if (float_abs(by) >= reach)
				continue;
			reach = float_abs(by);
			*missing = by;
			*with = p;
			*at = there;
			found = true;
		}
	}
	return found;
}

/* From the moved piece to the one that it is in line with. */
static void note_line(struct tool *tool, bool across, struct v2 low, struct v2 high, int with,
		      float at)
{
	struct v2 a, b;
	piece_bounds(&tool->session->document.pattern.piece[with], &a, &b);
	struct v2 from = across ? (struct v2){at, 0.5f * (a.y + b.y)}
				: (struct v2){0.5f * (a.x + b.x), at};
	struct v2 to = across ? (struct v2){at, 0.5f * (low.y + high.y)}
			      : (struct v2){0.5f * (low.x + high.x), at};
	note(&tool->ui->shaping, from, to);
}

struct v2 snap_move(struct tool *tool, struct v2 move_mm)
{
	struct ui *ui = tool->ui;
	float reach = tool_sheet_mm(ui, snap_mm), missing, at;
	struct v2 low, high;
	int with;
	ui->shaping.guide_count = 0;
	if (!piece_used(tool->session, ui->piece))
		return move_mm;
	piece_bounds(&tool->session->document.pattern.piece[ui->piece], &low, &high);
	low = v2_add(low, move_mm);
	high = v2_add(high, move_mm);
	if (in_line(tool, true, low.x, high.x, reach, &missing, &with, &at)) {
		move_mm.x += missing;
		note_line(tool, true, low, high, with, at);
	}
	if (in_line(tool, false, low.y, high.y, reach, &missing, &with, &at)) {
		move_mm.y += missing;
		note_line(tool, false, low, high, with, at);
	}
	return move_mm;
}
