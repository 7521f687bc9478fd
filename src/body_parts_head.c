/* Head and trunk by plane sections: the neck is the least girth between chest and face. */
#include "body_parts.h"

enum { HEAD_LEVELS = 100, TRUNK_LEVELS = 64 };

/* Of the way from the chest (between the armpits) to the crown. */
enum { NECK_LOW_ELSE = 38, NECK_HIGH_ELSE = 48 };

enum {
	NECK_LEVELS_MAX = 10
}; /* below its least girth: a heavy neck widens slowly into shoulders */

/* height_m: along the line from a to b, 0 at a. Returns the line's length. */
static float measure_along(const struct body *body, struct parts_scratch *s, struct v3 a_m,
			   struct v3 b_m)
{
	struct v3 axis = v3_normalize(v3_sub(b_m, a_m));
	for (int v = 0; v < body->vertex_count; v++)
		s->height_m[v] = v3_dot(v3_sub(body->position_m[v], a_m), axis);
	return v3_distance(a_m, b_m);
}

/* Gives the head everything above a level that hangs together with the crown. */
static void flood(const struct body *body, struct parts_scratch *s, float level_m)
{
	int waiting = 0, tip = s->limb[LIMBS_MAX].tip;
	s->owner[tip] = LIMBS_MAX;
	s->order[waiting++] = tip;
	while (waiting > 0) {
		int v = s->order[--waiting];
		const struct link *link = s->link + 2 * body->star_first[v];
		for (int i = 0; i < parts_degree(body, v); i++) {
			int to = link[i].to;
			if (s->owner[to] != OWNER_NONE || s->height_m[to] <= level_m)
				continue;
			s->owner[to] = LIMBS_MAX;
			s->order[waiting++] = to;
		}
	}
}

static void unflood(const struct body *body, struct parts_scratch *s)
{
	for (int v = 0; v < body->vertex_count; v++)
		if (s->owner[v] == LIMBS_MAX)
			s->owner[v] = OWNER_NONE;
}

/* Of the head's skin. */
static struct v3 head_middle(const struct body *body, const struct parts_scratch *s)
{
	struct v3 sum = {0.0f, 0.0f, 0.0f};
	float whole = 0.0f;
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v;
		const struct v3 *p = body->position_m;
		if (s->owner[v[0]] != LIMBS_MAX)
			continue;
		float area = v3_length(
			v3_cross(v3_sub(p[v[1]], p[v[0]]), v3_sub(p[v[2]], p[v[0]])));
		sum = v3_mad(sum, p[v[0]], area);
		whole += area;
	}
	return v3_scale(sum, 1.0f / float_max(whole, 1e-12f));
}

/* The neck among sections of the line from chest to crown. */
struct neck {
	float level_m; /* from section to section */
	int low, high;
};

/* False: there is no narrow place between chest and face. */
static bool find_neck(const struct body *body, struct parts_scratch *s, struct v3 chest_m,
		      struct v3 crown_m, struct neck *at)
{
	const struct contour *c = s->contour;
	at->level_m = measure_along(body, s, chest_m, crown_m) / (float)HEAD_LEVELS;
	if (at->level_m < 1e-5f)
		return false;
	parts_contours(body, s, at->level_m, HEAD_LEVELS, OWNER_NONE);
	int face = HEAD_LEVELS - 3;
	for (int k = face; k > 45; k--)
		face = c[k].girth_m > c[face].girth_m ? k : face;
	int neck = face;
	for (int k = face; k > 4; k--)
		neck = c[k].girth_m < c[neck].girth_m ? k : neck;
	at->low = NECK_LOW_ELSE;
	at->high = NECK_HIGH_ELSE;
	if (c[neck].girth_m > 0.92f * c[face].girth_m || c[neck].girth_m <= 0.0f)
		return false;
	at->low = at->high = neck;
	while (at->low > int_max(1, neck - NECK_LEVELS_MAX) &&
	       c[at->low - 1].girth_m < 1.35f * c[neck].girth_m)
		at->low--;
	while (at->high < face && c[at->high + 1].girth_m < 1.2f * c[neck].girth_m)
		at->high++;
	return true;
}

/* Seen from the neck, the farthest point of the head in the direction of its middle. The highest
 * vertex may lie on a crest, a quiff or a helmet's edge, and its direction then is not the head's.
 */
static struct v3 head_end(const struct body *body, const struct parts_scratch *s, struct v3 neck_m,
			  struct v3 middle_m)
{
	struct v3 axis = v3_normalize(v3_sub(middle_m, neck_m));
	float farthest = 0.0f;
	for (int v = 0; v < body->vertex_count; v++)
		if (s->owner[v] == LIMBS_MAX)
			farthest = float_max(farthest,
					     v3_dot(v3_sub(body->position_m[v], neck_m), axis));
	return v3_mad(neck_m, axis, farthest);
}

bool parts_cut_head(const struct body *body, struct parts_scratch *s, struct v3 chest_m, bool guess)
{
	struct limb *head = &s->limb[LIMBS_MAX];
	struct v3 crown_m = body->position_m[head->tip];
	struct neck neck, again;
	if (!find_neck(body, s, chest_m, crown_m, &neck) && !guess)
		return false;
	struct v3 neck_m = s->contour[neck.high].centre_m;
	flood(body, s, (float)neck.high * neck.level_m);
	s->head_end_m = head_end(body, s, neck_m, head_middle(body, s));
	unflood(body, s);
	if (find_neck(body, s, chest_m, s->head_end_m, &again))
		neck = again;
	else
		find_neck(body, s, chest_m, crown_m, &neck);
	parts_path(s, neck.low, neck.high, &s->neck);
	parts_path(s, neck.high, HEAD_LEVELS - 2, &head->path);
	head->length_m = (float)(HEAD_LEVELS - neck.low) * neck.level_m;
	flood(body, s, (float)neck.low * neck.level_m);
	return s->neck.count > 0 && head->path.count > 1;
}

void parts_trunk(const struct body *body, struct parts_scratch *s, struct v3 pelvis_m,
		 struct v3 neck_m)
{
	float level_m = measure_along(body, s, pelvis_m, neck_m) / (float)TRUNK_LEVELS;
	parts_contours(body, s, level_m, TRUNK_LEVELS, OWNER_NONE);
	float widest_m = 0.0f;
	for (int k = 0; k <= TRUNK_LEVELS / 2; k++)
		widest_m = float_max(widest_m, s->contour[k].girth_m);
	int low = 1; /* the lowest sections hold what is left between the legs */
	while (low < TRUNK_LEVELS / 2 && s->contour[low].girth_m < 0.8f * widest_m)
		low++;
	parts_path(s, low, TRUNK_LEVELS - 1, &s->trunk);
}
