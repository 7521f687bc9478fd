#include "pattern.h"

struct v2 piece_to_sheet(const struct piece *piece, struct v2 local_mm)
{
	float x = piece->inside_up ? -local_mm.x : local_mm.x;
	float y = local_mm.y;
	float s = angle_sin(piece->turn_rad), c = angle_cos(piece->turn_rad);
	return (struct v2){piece->position_mm.x + x * c - y * s,
			   piece->position_mm.y + x * s + y * c};
}

struct v2 piece_from_sheet(const struct piece *piece, struct v2 sheet_mm)
{
	struct v2 d = v2_sub(sheet_mm, piece->position_mm);
	float s = angle_sin(piece->turn_rad), c = angle_cos(piece->turn_rad);
	float x = d.x * c + d.y * s;
	return (struct v2){piece->inside_up ? -x : x, d.y * c - d.x * s};
}

int piece_edge_count(const struct piece *piece)
{
	int count = 0;
	for (int i = 0; i < piece->point_count; i++)
		count += piece->corner[i];
	return count;
}

static int next_point(const struct piece *piece, int i)
{
	return i + 1 < piece->point_count ? i + 1 : 0;
}

void piece_edge(const struct piece *piece, int edge, int *first, int *last)
{
	int seen = -1, i = 0;
	for (; i < piece->point_count; i++) {
		seen += piece->corner[i];
		if (seen == edge)
			break;
	}
	MUST(edge >= 0 && i < piece->point_count);
	*first = i;
	int end = next_point(piece, i);
	while (!piece->corner[end])
		end = next_point(piece, end);
	*last = end;
}

/* How many segments lie from outline point first to last; the whole outline when they are one. */
static int segment_count(const struct piece *piece, int first, int last)
{
	int count = last - first;
	return count > 0 ? count : count + piece->point_count;
}

float piece_edge_length_mm(const struct piece *piece, int edge)
{
	int first, last;
	piece_edge(piece, edge, &first, &last);
	float length = 0.0f;
	int count = segment_count(piece, first, last);
	for (int k = 0, i = first; k < count; k++) {
		int next = next_point(piece, i);
		length += v2_distance(piece->point_mm[i], piece->point_mm[next]);
		i = next;
	}
	return length;
}

struct v2 piece_edge_point(const struct piece *piece, int edge, float fraction)
{
	int first, last;
	piece_edge(piece, edge, &first, &last);
	float wanted = piece_edge_length_mm(piece, edge) * float_clamp(fraction, 0.0f, 1.0f);
	int count = segment_count(piece, first, last);
	for (int k = 0, i = first; k < count; k++) {
		int next = next_point(piece, i);
		struct v2 a = piece->point_mm[i], b = piece->point_mm[next];
		float length = v2_distance(a, b);
		if (wanted < length)
			return v2_lerp(a, b, wanted / length);
		wanted -= length;
		i = next;
	}
	return piece->point_mm[last];
}

float piece_area_mm2(const struct piece *piece)
{
	if (piece->point_count < 3)
		return 0.0f;
	/* From the first point, so that a piece far from its origin loses no digits. */
	struct v2 origin = piece->point_mm[0];
	float twice = 0.0f;
	for (int i = 1; i + 1 < piece->point_count; i++)
		twice += v2_cross(v2_sub(piece->point_mm[i], origin),
				  v2_sub(piece->point_mm[i + 1], origin));
	return 0.5f * twice;
}

bool piece_contains(const struct piece *piece, struct v2 local_mm)
{
	bool inside = false;
	for (int i = 0; i < piece->point_count; i++) {
		struct v2 a = piece->point_mm[i], b = piece->point_mm[next_point(piece, i)];
		if ((a.y > local_mm.y) == (b.y > local_mm.y))
			continue;
		float side = v2_cross(v2_sub(b, a), v2_sub(local_mm, a));
		if ((side > 0.0f) == (b.y > a.y))
			inside = !inside;
	}
	return inside;
}

/* The nearest point of segment a b as a share of its length. */
static float nearest_share(struct v2 a, struct v2 b, struct v2 p)
{
	struct v2 d = v2_sub(b, a);
	float squared = v2_dot(d, d);
	if (squared <= 0.0f)
		return 0.0f;
	return float_clamp(v2_dot(v2_sub(p, a), d) / squared, 0.0f, 1.0f);
}

/* Which edge a segment belongs to: points before the first corner close the last edge. */
static int edge_of_segment(const struct piece *piece, int segment)
{
	int edge = -1;
	for (int i = 0; i <= segment; i++)
		edge += piece->corner[i];
	return edge >= 0 ? edge : piece_edge_count(piece) - 1;
}

float piece_nearest_edge(const struct piece *piece, struct v2 local_mm, int *edge, float *fraction)
{
	MUST(piece->point_count > 0 && piece_edge_count(piece) > 0);
	int best = 0;
	float best_share = 0.0f, best_mm = 1e30f;
	for (int i = 0; i < piece->point_count; i++) {
		struct v2 a = piece->point_mm[i], b = piece->point_mm[next_point(piece, i)];
		float share = nearest_share(a, b, local_mm);
		float distance = v2_distance(local_mm, v2_lerp(a, b, share));
		if (distance < best_mm) {
			best_mm = distance;
			best = i;
			best_share = share;
		}
	}
	*edge = edge_of_segment(piece, best);
	int first, last;
	piece_edge(piece, *edge, &first, &last);
	float before = 0.0f;
	for (int i = first; i != best; i = next_point(piece, i))
		before += v2_distance(piece->point_mm[i], piece->point_mm[next_point(piece, i)]);
	before += best_share *
		  v2_distance(piece->point_mm[best], piece->point_mm[next_point(piece, best)]);
	float length = piece_edge_length_mm(piece, *edge);
	*fraction = length > 0.0f ? float_clamp(before / length, 0.0f, 1.0f) : 0.0f;
	return best_mm;
}

int pattern_free_piece(const struct pattern *pattern)
{
	for (int p = 0; p < PIECES_MAX; p++)
		if (!pattern->piece[p].used)
			return p;
	return -1;
}

int pattern_pick(const struct pattern *pattern, struct v2 sheet_mm, uint32_t skip)
{
	int best = -1;
	for (int p = 0; p < PIECES_MAX; p++) {
		const struct piece *piece = &pattern->piece[p];
		if (!piece->used || (skip >> p & 1u))
			continue;
		if (best >= 0 && piece->layer < pattern->piece[best].layer)
			continue;
		if (piece_contains(piece, piece_from_sheet(piece, sheet_mm)))
			best = p;
	}
	return best;
}
