/* Head, arms and legs of a standing figure, found from its shape alone (S19).
 *
 *   1. f(v) = mean distance along the surface from 32 scattered points: high at the ends of limbs.
 *   2. Sweeping f downwards, a summit that joins another much lower down is a limb's tip; the point
 *      where they join is its saddle.
 *   3. Round each tip, contours of the distance from it: a limb ends where their girth begins to
 *      grow fast, at the armpit or the crotch.
 *   4. The head is what lies above the neck, the least girth of level sections between shoulders
 * and crown.
 *
 * Legs have the lowest tips, arms the two that reach farthest to the sides, the crown is highest.
 */
#include "body_private.h"

enum { SAMPLES = 32, TIPS_MAX = 16, SECTIONS = 64 };

static const float persistence = 0.16f; /* of the largest f */
static const float growth = 2.0f;       /* metres of girth per metre of limb: a trunk begins */

struct tip {
	int vertex, saddle;
	float persistence;
};

struct tips {
	int count;
	struct tip tip[TIPS_MAX];
};

/* ---- 1: the mean distance ---- */

static int farthest(const float *distance_m, int count)
{
	int far = 0;
	for (int v = 1; v < count; v++)
		if (distance_m[v] > distance_m[far])
			far = v;
	return far;
}

static void mean_distance(struct body *body)
{
	struct body_scratch *s = body->scratch;
	int count = body->vertex_count, from = 0;
	memset(s->mean_m, 0, (size_t)count * sizeof *s->mean_m);
	body_distances(body, from, s->distance_m);
	from = farthest(s->distance_m, count);
	for (int i = 0; i < SAMPLES; i++) {
		body_distances(body, from, s->distance_m);
		for (int v = 0; v < count; v++) {
			s->mean_m[v] += s->distance_m[v] * (1.0f / (float)SAMPLES);
			if (i == 0 || s->distance_m[v] < s->nearest_m[v])
				s->nearest_m[v] = s->distance_m[v];
		}
		from = farthest(s->nearest_m, count);
	}
}

/* ---- 2: tips ---- */

static bool higher(const float *f, int a, int b)
{
	return f[a] > f[b] || (f[a] == f[b] && a < b);
}

/* Heap sort, highest first. */
static void sort_down(int *order, int count, const float *f)
{
	for (int end = count, start = count / 2; end > 1;) {
		int item;
		if (start > 0) {
			item = order[--start];
		} else {
			item = order[--end];
			order[end] = order[0];
		}
		int at = start;
		for (int child = 2 * at + 1; child < end; child = 2 * at + 1) {
			if (child + 1 < end && higher(f, order[child], order[child + 1]))
				child++;
			if (!higher(f, item, order[child]))
				break;
			order[at] = order[child];
			at = child;
		}
		order[at] = item;
	}
}

static int find(int *group, int v)
{
	while (group[v] != v) {
		group[v] = group[group[v]];
		v = group[v];
	}
	return v;
}

static void add_tip(struct tips *tips, int vertex, int saddle, float value)
{
	if (tips->count < TIPS_MAX)
		tips->tip[tips->count++] = (struct tip){vertex, saddle, value};
}

/* Joins the groups of v and its neighbour w; the lower summit ends here. */
static void join(struct body_scratch *s, struct tips *tips, int v, int w, float least)
{
	int a = find(s->group, v), b = find(s->group, w);
	if (a == b)
		return;
	if (higher(s->mean_m, s->tip_of[b], s->tip_of[a])) {
		int swap = a;
		a = b;
		b = swap;
	}
	float value = s->mean_m[s->tip_of[b]] - s->mean_m[v];
	if (value > least) {
		if (tips->count == 0) /* the highest summit of all has its saddle here as well */
			add_tip(tips, s->tip_of[s->order[0]], v,
				s->mean_m[s->order[0]] - s->mean_m[v]);
		add_tip(tips, s->tip_of[b], v, value);
	}
	s->group[b] = a;
}

static void find_tips(struct body *body, struct tips *tips)
{
	struct body_scratch *s = body->scratch;
	int count = body->vertex_count;
	for (int v = 0; v < count; v++) {
		s->order[v] = v;
		s->group[v] = -1;
		s->tip_of[v] = v;
	}
	sort_down(s->order, count, s->mean_m);
	float least = persistence * s->mean_m[s->order[0]];
	tips->count = 0;
	for (int i = 0; i < count; i++) {
		int v = s->order[i];
		s->group[v] = v;
		for (int k = body->star_first[v]; k < body->star_first[v + 1]; k++)
			for (int c = 0; c < 3; c++) {
				int w = body->triangle[body->star[k]].v[c];
				if (w != v && s->group[w] >= 0)
					join(s, tips, v, w, least);
			}
	}
}

/* ---- 3: limbs ---- */

/* Length and centre of the contours at levels of the distance that now stands in distance_m. */
static void trace_contours(struct body *body, float reach_m)
{
	struct body_scratch *s = body->scratch;
	struct contour *contour = &s->contour;
	memset(contour, 0, sizeof *contour);
	contour->step_m = reach_m / (float)PART_LEVELS;
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v;
		float d[3] = {s->distance_m[v[0]], s->distance_m[v[1]], s->distance_m[v[2]]};
		float low = float_min(d[0], float_min(d[1], d[2]));
		float high = float_max(d[0], float_max(d[1], d[2]));
		if (low >= reach_m)
			continue;
		int first = int_max(0, (int)(low / contour->step_m - 0.5f));
		for (int i = first; i < PART_LEVELS; i++) {
			float level = ((float)i + 0.5f) * contour->step_m;
			struct v3 end[3];
			int ends = 0;
			if (level >= high)
				break;
			for (int k = 0; k < 3; k++) {
				float a = d[k], b = d[(k + 1) % 3];
				if ((a < level) == (b < level))
					continue;
				end[ends++] = v3_lerp(body->position_m[v[k]],
						      body->position_m[v[(k + 1) % 3]],
						      (level - a) / (b - a));
			}
			if (ends != 2)
				continue;
			float length = v3_distance(end[0], end[1]);
			contour->girth_m[i] += length;
			contour->centre_m[i] = v3_mad(contour->centre_m[i],
						      v3_lerp(end[0], end[1], 0.5f), length);
		}
	}
	for (int i = 0; i < PART_LEVELS; i++)
		if (contour->girth_m[i] > 0.0f)
			contour->centre_m[i] = v3_scale(contour->centre_m[i],
							1.0f / contour->girth_m[i]);
}

/* The level at which the limb ends. */
static int limb_end(const struct contour *contour, float size_m)
{
	int window = int_max(2, (int)(0.011f * size_m / contour->step_m + 0.5f));
	for (int i = PART_LEVELS * 35 / 100; i + window < PART_LEVELS; i++) {
		float along = ((float)i + 0.5f) * contour->step_m;
		float grown = contour->girth_m[i + window] - contour->girth_m[i];
		if (along > 0.42f * contour->girth_m[i] &&
		    grown > growth * (float)window * contour->step_m)
			return i;
	}
	return PART_LEVELS - 1;
}

static void label_limb(struct body *body, enum body_part part, float end_m)
{
	const struct body_scratch *s = body->scratch;
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v;
		float mean = (s->distance_m[v[0]] + s->distance_m[v[1]] + s->distance_m[v[2]]) /
			     3.0f;
		if (mean < end_m)
			body->part[t] = (uint8_t)part;
	}
}

static void add_bone(struct body *body, enum body_part part, struct v3 a, struct v3 b, float radius)
{
	MUST(body->bone_count < BODY_BONES_MAX);
	body->bone[body->bone_count++] = (struct bone){part, a, b, radius};
}

/* Two bones from the trunk outward, parting where the centre line strays most from straight (elbow,
 * knee), or in the middle of a straight limb. */
static void add_limb_bones(struct body *body, enum body_part part, int end)
{
	const struct contour *contour = &body->scratch->contour;
	int tip = PART_LEVELS * 6 / 100, middle = (tip + end) / 2;
	struct v3 a = contour->centre_m[end], b = contour->centre_m[tip];
	struct v3 axis = v3_normalize(v3_sub(b, a));
	float girth = 0.0f, most = 0.0f;
	for (int i = tip; i <= end; i++) {
		struct v3 d = v3_sub(contour->centre_m[i], a);
		float stray = v3_length(v3_mad(d, axis, -v3_dot(d, axis)));
		bool inner = i > tip + (end - tip) / 4 && i < end - (end - tip) / 4;
		girth += contour->girth_m[i] / (float)(end - tip + 1);
		if (inner && stray > most) {
			most = stray;
			middle = i;
		}
	}
	float radius = girth / (2.0f * PI_F);
	if (most < 0.4f * radius)
		middle = (tip + end) / 2;
	add_bone(body, part, a, contour->centre_m[middle], radius);
	add_bone(body, part, contour->centre_m[middle], b, radius);
}

static void cut_limb(struct body *body, const struct tip *tip, enum body_part part, float size_m)
{
	struct body_scratch *s = body->scratch;
	body_distances(body, tip->vertex, s->distance_m);
	trace_contours(body, 1.1f * s->distance_m[tip->saddle]);
	int end = limb_end(&s->contour, size_m);
	label_limb(body, part, ((float)end + 0.5f) * s->contour.step_m);
	add_limb_bones(body, part, end);
}

/* ---- 4: trunk and head, by level sections ---- */

struct section {
	float y_m, girth_m;
	struct v3 centre_m;
};

/* What is still trunk, cut at a height. */
static void cut_section(const struct body *body, struct section *section)
{
	struct v3 sum = {0.0f, 0.0f, 0.0f};
	section->girth_m = 0.0f;
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v;
		struct v3 end[3];
		int ends = 0;
		if (body->part[t] != PART_TRUNK)
			continue;
		for (int k = 0; k < 3; k++) {
			struct v3 a = body->position_m[v[k]], b = body->position_m[v[(k + 1) % 3]];
			if ((a.y < section->y_m) != (b.y < section->y_m))
				end[ends++] = v3_lerp(a, b, (section->y_m - a.y) / (b.y - a.y));
		}
		if (ends != 2)
			continue;
		float length = v3_distance(end[0], end[1]);
		section->girth_m += length;
		sum = v3_mad(sum, v3_lerp(end[0], end[1], 0.5f), length);
	}
	if (section->girth_m > 0.0f)
		section->centre_m = v3_scale(sum, 1.0f / section->girth_m);
}

static struct v3 limb_root(const struct body *body, enum body_part part)
{
	for (int b = 0; b < body->bone_count; b++)
		if (body->bone[b].part == part)
			return body->bone[b].a_m;
	return (struct v3){0.0f, 0.0f, 0.0f};
}

static bool cut_head(struct body *body, float crown_y_m)
{
	struct section section[SECTIONS];
	float hips = 0.5f * (limb_root(body, PART_LEG_LEFT).y + limb_root(body, PART_LEG_RIGHT).y);
	float arms = 0.5f * (limb_root(body, PART_ARM_LEFT).y + limb_root(body, PART_ARM_RIGHT).y);
	int neck = -1, low = 0;
	for (int i = 0; i < SECTIONS; i++) {
		section[i].y_m = arms + (crown_y_m - arms) * ((float)i + 0.5f) / (float)SECTIONS;
		cut_section(body, &section[i]);
		bool between = i > SECTIONS / 8 && i < SECTIONS * 3 / 4;
		if (between && (neck < 0 || section[i].girth_m < section[neck].girth_m))
			neck = i;
	}
	if (neck < 0 || section[neck].girth_m <= 0.0f)
		return false;
	for (low = neck; low > 0 && section[low].girth_m < 1.35f * section[neck].girth_m;)
		low--;
	for (int t = 0; t < body->triangle_count; t++)
		if (body->part[t] == PART_TRUNK &&
		    body->position_m[body->triangle[t].v[0]].y > section[low].y_m)
			body->part[t] = PART_HEAD;
	struct section waist = {.y_m = 0.5f * (hips + section[low].y_m)};
	struct section pelvis = {.y_m = hips + 0.1f * (section[low].y_m - hips)};
	cut_section(body, &waist);
	cut_section(body, &pelvis);
	struct v3 nape = section[low].centre_m, crown = section[neck].centre_m;
	crown.y = crown_y_m - 0.25f * (crown_y_m - section[neck].y_m);
	float radius = section[neck].girth_m / (2.0f * PI_F);
	add_bone(body, PART_TRUNK, pelvis.centre_m, waist.centre_m, waist.girth_m / (2.0f * PI_F));
	add_bone(body, PART_TRUNK, waist.centre_m, nape, waist.girth_m / (2.0f * PI_F));
	add_bone(body, PART_HEAD, nape, section[neck].centre_m, radius);
	add_bone(body, PART_HEAD, section[neck].centre_m, crown, radius);
	return true;
}

/* ---- names ---- */

/* The two tips with the largest value, named by their side; the tips used are cleared. */
static bool pick_pair(const struct body *body, struct tips *tips, float (*value)(struct v3),
		      struct tip *left, struct tip *right)
{
	int best[2] = {-1, -1};
	for (int k = 0; k < 2; k++)
		for (int i = 0; i < tips->count; i++) {
			if (tips->tip[i].vertex < 0 || i == best[0])
				continue;
			float v = value(body->position_m[tips->tip[i].vertex]);
			if (best[k] < 0 || v > value(body->position_m[tips->tip[best[k]].vertex]))
				best[k] = i;
		}
	if (best[1] < 0)
		return false;
	bool first_left = body->position_m[tips->tip[best[0]].vertex].x >
			  body->position_m[tips->tip[best[1]].vertex].x;
	*left = tips->tip[best[first_left ? 0 : 1]];
	*right = tips->tip[best[first_left ? 1 : 0]];
	tips->tip[best[0]].vertex = tips->tip[best[1]].vertex = -1;
	return true;
}

static float lowness(struct v3 p)
{
	return -p.y;
}

static float sideness(struct v3 p)
{
	return float_abs(p.x);
}

bool body_find_parts(struct body *body)
{
	struct tips tips;
	struct tip leg[2], arm[2];
	memset(body->part, PART_TRUNK, (size_t)body->triangle_count);
	body->bone_count = 0;
	body_ways(body);
	mean_distance(body);
	find_tips(body, &tips);
	float size_m = 2.0f * body->scratch->mean_m[body->scratch->order[0]];
	bool found = pick_pair(body, &tips, lowness, &leg[0], &leg[1]) &&
		     pick_pair(body, &tips, sideness, &arm[0], &arm[1]);
	if (found) {
		cut_limb(body, &leg[0], PART_LEG_LEFT, size_m);
		cut_limb(body, &leg[1], PART_LEG_RIGHT, size_m);
		cut_limb(body, &arm[0], PART_ARM_LEFT, size_m);
		cut_limb(body, &arm[1], PART_ARM_RIGHT, size_m);
		found = cut_head(body, body->high_m.y);
	}
	if (!found) {
		memset(body->part, PART_TRUNK, (size_t)body->triangle_count);
		body->bone_count = 0;
	}
	return found;
}
