/* A hand that trembles where its line begins, ends or turns leaves small loops there. They are cut
 * off where the outline crosses itself; a large loop is another matter and stays. */
#include "pattern_grid.h"
#include "pattern_private.h"

#define LOOP_SHARE_MAX 0.12f /* of the outline's length: what is longer was meant */
#define SHEET_MM_MAX 20000.0f
#define NEAR_MM 1.0f /* points nearer to each other than this are one */

enum { LOOPS_MAX = 12 };

static int wrap(const struct piece *piece, int i)
{
	return i % piece->point_count;
}

/* Do segments i and k, no neighbours, meet? */
static bool meet(const struct piece *piece, int i, int k)
{
	const struct v2 *p = piece->point_mm;
	return grid_segments_meet(grid_from_mm(p[i]), grid_from_mm(p[wrap(piece, i + 1)]),
				  grid_from_mm(p[k]), grid_from_mm(p[wrap(piece, k + 1)]));
}

static bool find_crossing(const struct piece *piece, int *first, int *second)
{
	int count = piece->point_count;
	for (int i = 0; i < count; i++)
		for (int k = i + 2; k < (i == 0 ? count - 1 : count); k++)
			if (meet(piece, i, k)) {
				*first = i;
				*second = k;
				return true;
			}
	return false;
}

/* Where two segments cross; half-way when they run side by side. */
static struct v2 crossing_of(const struct piece *piece, int i, int k)
{
	const struct v2 *p = piece->point_mm;
	struct v2 a = p[i], b = p[wrap(piece, i + 1)], c = p[k], d = p[wrap(piece, k + 1)];
	struct v2 ab = v2_sub(b, a), cd = v2_sub(d, c);
	float cross = v2_cross(ab, cd);
	float reach = 1e-3f * v2_length(ab) * v2_length(cd);
	if (float_abs(cross) <= reach)
		return v2_lerp(b, c, 0.5f);
	float t = v2_cross(v2_sub(c, a), cd) / cross;
	return v2_lerp(a, b, float_clamp(t, 0.0f, 1.0f));
}

/* Along the outline from point `from` to point `to`. */
static float length_between(const struct piece *piece, int from, int to)
{
	float length = 0.0f;
	for (int i = from; i != to; i = wrap(piece, i + 1))
		length += v2_distance(piece->point_mm[i], piece->point_mm[wrap(piece, i + 1)]);
	return length;
}

/* The points from `from` to `to` stay, and one where the loop was, which is a corner if the loop
 * had one. */
static void keep(struct piece *piece, int from, int to, struct v2 crossing)
{
	struct piece made = *piece;
	bool corner = false;
	int kept = (to - from + piece->point_count) % piece->point_count + 1;
	for (int i = 0; i < piece->point_count; i++) {
		int at = wrap(piece, from + i);
		if (i < kept) {
			made.point_mm[i] = piece->point_mm[at];
			made.corner[i] = piece->corner[at];
		} else {
			corner |= piece->corner[at];
		}
	}
	made.point_mm[kept] = crossing;
	made.corner[kept] = corner;
	made.point_count = kept + 1;
	*piece = made;
}

/* Of two points in one place the corner stays. */
static void drop_doubles(struct piece *piece)
{
	int kept = 0;
	for (int i = 0; i < piece->point_count; i++) {
		struct v2 before = piece->point_mm[kept > 0 ? kept - 1 : piece->point_count - 1];
		bool near = v2_distance(piece->point_mm[i], before) < NEAR_MM;
		if (near && kept > 0) {
			piece->corner[kept - 1] |= piece->corner[i];
			continue;
		}
		piece->point_mm[kept] = piece->point_mm[i];
		piece->corner[kept++] = piece->corner[i];
	}
	while (kept > 3 && v2_distance(piece->point_mm[kept - 1], piece->point_mm[0]) < NEAR_MM) {
		piece->corner[0] |= piece->corner[kept - 1];
		kept--;
	}
	piece->point_count = kept;
}

/* Else there is no grid to ask exactly. */
static bool on_sheet(const struct piece *piece)
{
	for (int i = 0; i < piece->point_count; i++)
		if (!(float_abs(piece->point_mm[i].x) < SHEET_MM_MAX &&
		      float_abs(piece->point_mm[i].y) < SHEET_MM_MAX))
			return false;
	return true;
}

bool outline_untangle(struct piece *piece)
{
	struct piece made = *piece;
	int first, second;
	if (!on_sheet(&made))
		return false;
	drop_doubles(&made);
	for (int loop = 0; loop < LOOPS_MAX && find_crossing(&made, &first, &second); loop++) {
		struct v2 crossing = crossing_of(&made, first, second);
		float inner = length_between(&made, wrap(&made, first + 1), second);
		float outer = length_between(&made, wrap(&made, second + 1), first);
		if (float_min(inner, outer) > LOOP_SHARE_MAX * (inner + outer))
			return false;
		if (inner < outer)
			keep(&made, wrap(&made, second + 1), first, crossing);
		else
			keep(&made, first + 1, second, crossing);
		drop_doubles(&made);
		if (made.point_count < 4)
			return false;
	}
	if (piece_edge_count(&made) == 0 || find_crossing(&made, &first, &second))
		return false;
	*piece = made;
	return true;
}
