/* Can this outline be cut out of cloth? Exact, on the grid of pattern_grid.h. */
#include "pattern.h"
#include "pattern_grid.h"

enum { COORDINATE_MM_MAX = 10000, AREA_MM2_MIN = 100 };

static int sign(int64_t value)
{
	return (value > 0) - (value < 0);
}

/* c on the line through a b: is it within the segment? */
static bool within(struct grid_point a, struct grid_point b, struct grid_point c)
{
	return (a.x < b.x ? a.x <= c.x && c.x <= b.x : b.x <= c.x && c.x <= a.x) &&
	       (a.y < b.y ? a.y <= c.y && c.y <= b.y : b.y <= c.y && c.y <= a.y);
}

bool grid_segments_meet(struct grid_point a, struct grid_point b, struct grid_point c,
			struct grid_point d)
{
	int abc = sign(grid_orient(a, b, c)), abd = sign(grid_orient(a, b, d));
	int cda = sign(grid_orient(c, d, a)), cdb = sign(grid_orient(c, d, b));
	if (abc * abd < 0 && cda * cdb < 0)
		return true;
	return (abc == 0 && within(a, b, c)) || (abd == 0 && within(a, b, d)) ||
	       (cda == 0 && within(c, d, a)) || (cdb == 0 && within(c, d, b));
}

static bool finite_coordinate(float mm)
{
	return mm >= (float)-COORDINATE_MM_MAX && mm <= (float)COORDINATE_MM_MAX;
}

/* Segments that are no neighbours must not meet; neighbours must not fold back on each other. */
static bool crosses_itself(const struct grid_point *point, int count)
{
	for (int i = 0; i < count; i++) {
		struct grid_point a = point[i], b = point[(i + 1) % count];
		struct grid_point after = point[(i + 2) % count];
		if (grid_orient(a, b, after) == 0 && grid_dot(b, a, after) > 0)
			return true;
		int32_t x0 = a.x < b.x ? a.x : b.x, x1 = a.x < b.x ? b.x : a.x;
		int32_t y0 = a.y < b.y ? a.y : b.y, y1 = a.y < b.y ? b.y : a.y;
		int end = i == 0 ? count - 1 : count;
		for (int k = i + 2; k < end; k++) {
			struct grid_point c = point[k], d = point[k + 1 < count ? k + 1 : 0];
			if ((c.x < x0 && d.x < x0) || (c.x > x1 && d.x > x1) ||
			    (c.y < y0 && d.y < y0) || (c.y > y1 && d.y > y1))
				continue;
			if (grid_segments_meet(a, b, c, d))
				return true;
		}
	}
	return false;
}

const char *piece_fault(const struct piece *piece)
{
	int count = piece->point_count;
	if (count < 3)
		return "the outline needs at least three points";
	if (count > OUTLINE_POINTS_MAX)
		return "the outline has too many points";
	if (piece_edge_count(piece) < 1)
		return "the outline needs at least one corner";
	struct grid_point point[OUTLINE_POINTS_MAX];
	for (int i = 0; i < count; i++) {
		struct v2 p = piece->point_mm[i];
		if (!finite_coordinate(p.x) || !finite_coordinate(p.y))
			return "the outline leaves the sheet (10 m from its middle)";
		point[i] = grid_from_mm(p);
	}
	for (int i = 0; i < count; i++)
		if (grid_same(point[i], point[(i + 1) % count]))
			return "two neighbouring points of the outline lie on one another";
	float area = piece_area_mm2(piece);
	if (area <= -(float)AREA_MM2_MIN)
		return "the outline runs clockwise; the outside of a piece is counter-clockwise";
	if (crosses_itself(point, count))
		return "the outline crosses or touches itself";
	if (area < (float)AREA_MM2_MIN)
		return "the piece is smaller than a square centimetre";
	return NULL;
}
