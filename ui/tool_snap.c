/* A corner lies best where another one lies, on the axis of a symmetric piece, or straight above,
 * beside or at 45 degrees from its neighbours. */
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
