/* Limbs: found by their tips, cut off where their girth begins to grow fast. */
#include "body_parts.h"

/* ---- tips ---- */

static uint32_t key_of(float value)
{
	uint32_t bits;
	memcpy(&bits, &value, sizeof bits);
	return ~bits; /* values are not negative, so the order of the bits is theirs; descending */
}

/* order: vertices by falling remote_m, equal ones by number. Radix sort, a byte at a time. */
static void sort_remote(const struct body *body, struct parts_scratch *s)
{
	for (int v = 0; v < body->vertex_count; v++)
		s->order[v] = v;
	for (int shift = 0; shift < 32; shift += 8) {
		int start[257] = {0};
		for (int v = 0; v < body->vertex_count; v++)
			start[(key_of(s->remote_m[v]) >> shift & 0xff) + 1]++;
		for (int i = 0; i < 256; i++)
			start[i + 1] += start[i];
		for (int i = 0; i < body->vertex_count; i++) {
			int v = s->order[i];
			s->order_swap[start[key_of(s->remote_m[v]) >> shift & 0xff]++] = v;
		}
		memcpy(s->order, s->order_swap, (size_t)body->vertex_count * sizeof *s->order);
	}
}

static int set_root(struct parts_scratch *s, int v)
{
	while (s->set[v] != v) {
		s->set[v] = s->set[s->set[v]];
		v = s->set[v];
	}
	return v;
}

static void add_limb(struct parts_scratch *s, int tip, int saddle)
{
	for (int l = 0; l < s->limb_count; l++)
		if (s->limb[l].tip == tip)
			return;
	if (s->limb_count < LIMBS_MAX)
		s->limb[s->limb_count++] = (struct limb){.tip = tip, .saddle = saddle};
}

/* The sets of v and w meet at v. The lower tip ends here; when it stands out, so does the higher
 * one, and both are limbs that join at v. */
static void join_sets(struct parts_scratch *s, int v, int w, float least_m)
{
	int a = set_root(s, v), b = set_root(s, w);
	if (a == b)
		return;
	bool a_higher = s->remote_m[s->set_tip[a]] >= s->remote_m[s->set_tip[b]];
	int high = a_higher ? a : b, low = a_higher ? b : a;
	if (s->remote_m[s->set_tip[low]] - s->remote_m[v] > least_m) {
		add_limb(s, s->set_tip[low], v);
		add_limb(s, s->set_tip[high], v);
	}
	s->set[low] = high;
}

/* Persistence of maxima, by flooding from the top (Edelsbrunner, Letscher and Zomorodian 2002). */
void parts_tips(const struct body *body, struct parts_scratch *s, float persistence)
{
	float least_m = persistence * s->remote_max_m;
	s->limb_count = 0;
	sort_remote(body, s);
	for (int v = 0; v < body->vertex_count; v++)
		s->set[v] = -1;
	for (int i = 0; i < body->vertex_count; i++) {
		int v = s->order[i];
		s->set[v] = v;
		s->set_tip[v] = v;
		const struct link *link = s->link + 2 * body->star_first[v];
		for (int e = 0; e < parts_degree(body, v); e++)
			if (s->set[link[e].to] >= 0)
				join_sets(s, v, link[e].to, least_m);
	}
}

/* ---- contours ---- */

/* The part of the level's curve inside a triangle: its length and middle. */
static bool cross_triangle(const struct body *body, const float *height_m, int t, float level,
			   struct v3 *middle, float *length_m)
{
	const int *v = body->triangle[t].v;
	struct v3 end[2];
	int count = 0;
	for (int k = 0; k < 3 && count < 2; k++) {
		int a = v[k], b = v[(k + 1) % 3];
		if ((height_m[a] < level) == (height_m[b] < level))
			continue;
		float share = (level - height_m[a]) / (height_m[b] - height_m[a]);
		end[count++] = v3_lerp(body->position_m[a], body->position_m[b], share);
	}
	if (count < 2)
		return false;
	*middle = v3_lerp(end[0], end[1], 0.5f);
	*length_m = v3_distance(end[0], end[1]);
	return true;
}

void parts_contours(const struct body *body, struct parts_scratch *s, float level_m, int count,
		    int owner)
{
	const float *h = s->height_m;
	MUST(count <= LEVELS_MAX);
	memset(s->contour, 0, sizeof s->contour);
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v;
		bool wanted = owner == OWNER_ANY ||
			      (s->owner[v[0]] == owner && s->owner[v[1]] == owner &&
			       s->owner[v[2]] == owner);
		float low = float_min(h[v[0]], float_min(h[v[1]], h[v[2]]));
		float high = float_max(h[v[0]], float_max(h[v[1]], h[v[2]]));
		if (!wanted || high <= 0.0f || low > level_m * (float)count)
			continue;
		int first = (int)(float_max(low, 0.0f) / level_m);
		for (int k = first; k <= count && (float)k * level_m <= high; k++) {
			struct v3 middle;
			float length;
			if (!cross_triangle(body, h, t, (float)k * level_m, &middle, &length))
				continue;
			struct contour *c = &s->contour[k];
			c->centre_m = v3_mad(c->centre_m, middle, length);
			c->girth_m += length;
		}
	}
	for (int k = 0; k <= count; k++)
		if (s->contour[k].girth_m > 0.0f)
			s->contour[k].centre_m = v3_scale(s->contour[k].centre_m,
							  1.0f / s->contour[k].girth_m);
}

/* ---- cutting off ---- */

enum { GIRTH_MEAN = 5 };

/* Means over GIRTH_MEAN levels: a crease or a rough surface is no armpit. */
static void smooth_girths(const struct parts_scratch *s, float girth_m[LEVELS_MAX + 1])
{
	for (int k = 0; k <= LEVELS_MAX; k++) {
		int low = int_max(k - GIRTH_MEAN / 2, 0),
		    high = int_min(low + GIRTH_MEAN, LEVELS_MAX);
		girth_m[k] = 0.0f;
		for (int i = low; i < high; i++)
			girth_m[k] += s->contour[i].girth_m / (float)(high - low);
	}
}

/* The level where the limb ends: past hand or foot, the first where the girth begins to grow faster
 * than 2 m a metre, which it does at the armpit and at the crotch. */
static int cut_level(const struct parts_scratch *s, float estimate_m, float level_m)
{
	float girth_m[LEVELS_MAX + 1];
	smooth_girths(s, girth_m);
	int window = int_max(2, (int)(0.022f * s->reach_m / level_m + 0.5f));
	int last = LEVELS_MAX - window - 1, k = (int)(0.35f * estimate_m / level_m);
	while (k < last && (float)k * level_m < 0.42f * girth_m[k])
		k++;
	if (k == last)
		k = (int)(0.9f * estimate_m / level_m);
	while (k < last && (float)k * level_m < 1.05f * estimate_m &&
	       girth_m[k + window] - girth_m[k] < 2.0f * (float)window * level_m)
		k++;
	return k;
}

/* A cavity of the surface (a mouth, a nostril) has a tip as well: seen from its middle, its
 * triangles face inward. */
static bool is_cavity(const struct body *body, const struct parts_scratch *s, float length_m)
{
	struct v3 sum = {0.0f, 0.0f, 0.0f};
	float count = 0.0f, outward = 0.0f;
	for (int v = 0; v < body->vertex_count; v++)
		if (s->distance_m[v] <= length_m) {
			sum = v3_add(sum, body->position_m[v]);
			count += 1.0f;
		}
	struct v3 middle = v3_scale(sum, 1.0f / count);
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v;
		const struct v3 *p = body->position_m;
		if (s->distance_m[v[0]] > length_m || s->distance_m[v[1]] > length_m ||
		    s->distance_m[v[2]] > length_m)
			continue;
		struct v3 n = v3_cross(v3_sub(p[v[1]], p[v[0]]), v3_sub(p[v[2]], p[v[0]]));
		outward += v3_dot(n, v3_sub(p[v[0]], middle));
	}
	return outward < 0.0f;
}

/* Averages of three, four times, with the ends kept: sections that are cut askew even out. */
static void smooth_path(struct path *path)
{
	for (int round = 0; round < 4; round++) {
		struct v3 before = path->point_m[0];
		for (int i = 1; i + 1 < path->count; i++) {
			struct v3 here = path->point_m[i];
			struct v3 sides = v3_lerp(before, path->point_m[i + 1], 0.5f);
			path->point_m[i] = v3_lerp(here, sides, 0.5f);
			before = here;
		}
	}
}

void parts_path(const struct parts_scratch *s, int from, int to, struct path *path)
{
	int step = from <= to ? 1 : -1;
	path->count = 0;
	for (int k = from; k != to + step; k += step) {
		if (s->contour[k].girth_m <= 0.0f)
			continue;
		path->point_m[path->count] = s->contour[k].centre_m;
		path->radius_m[path->count++] = s->contour[k].girth_m / (2.0f * PI_F);
	}
	smooth_path(path);
}

void parts_measure_limb(const struct body *body, struct parts_scratch *s, int l)
{
	struct limb *limb = &s->limb[l];
	parts_distance_from(body, s, limb->tip);
	float estimate_m = s->distance_m[limb->saddle];
	float level_m = 1.5f * estimate_m / (float)LEVELS_MAX;
	limb->length_m = 0.0f;
	memcpy(s->height_m, s->distance_m, (size_t)body->vertex_count * sizeof *s->height_m);
	parts_contours(body, s, level_m, LEVELS_MAX, OWNER_ANY);
	int cut = cut_level(s, estimate_m, level_m);
	float length_m = (float)cut * level_m;
	if (length_m < 0.3f * s->contour[cut].girth_m || is_cavity(body, s, length_m))
		return;
	limb->length_m = length_m;
	parts_path(s, cut, 2, &limb->path);
}

void parts_claim_limb(const struct body *body, struct parts_scratch *s, int l)
{
	const struct limb *limb = &s->limb[l];
	parts_distance_from(body, s, limb->tip);
	for (int v = 0; v < body->vertex_count; v++) {
		float share = s->distance_m[v] / limb->length_m;
		if (share <= 1.0f && share < s->share[v]) {
			s->share[v] = share;
			s->owner[v] = (int8_t)l;
		}
	}
}
