/* Head and trunk by plane sections: the neck is the least girth between chest and face. */
#include "body_parts.h"

enum { HEAD_LEVELS = 100, TRUNK_LEVELS = 64 };

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
static void flood(const struct body *body, struct parts_scratch *s, int head, float level_m)
{
	int waiting = 0, tip = s->limb[head].tip;
	s->owner[tip] = (int8_t)head;
	s->order[waiting++] = tip;
	while (waiting > 0) {
		int v = s->order[--waiting];
		const struct link *link = s->link + 2 * body->star_first[v];
		for (int i = 0; i < parts_degree(body, v); i++) {
			int to = link[i].to;
			if (s->owner[to] != OWNER_NONE || s->height_m[to] <= level_m)
				continue;
			s->owner[to] = (int8_t)head;
			s->order[waiting++] = to;
		}
	}
}

bool parts_cut_head(const struct body *body, struct parts_scratch *s, int head, struct v3 chest_m)
{
	struct limb *limb = &s->limb[head];
	const struct contour *c = s->contour;
	float length_m = measure_along(body, s, chest_m, body->position_m[limb->tip]);
	if (length_m < 1e-3f)
		return false;
	float level_m = length_m / (float)HEAD_LEVELS;
	parts_contours(body, s, level_m, HEAD_LEVELS, OWNER_NONE);
	int face = HEAD_LEVELS - 3;
	for (int k = face; k > 45; k--)
		face = c[k].girth_m > c[face].girth_m ? k : face;
	int neck = face;
	for (int k = face; k > 4; k--)
		neck = c[k].girth_m < c[neck].girth_m ? k : neck;
	if (c[neck].girth_m > 0.92f * c[face].girth_m)
		return false;
	int low = neck, high = neck;
	while (low > 1 && c[low - 1].girth_m < 1.35f * c[neck].girth_m)
		low--;
	while (high < face && c[high + 1].girth_m < 1.2f * c[neck].girth_m)
		high++;
	parts_path(s, low, high, &s->neck);
	parts_path(s, high, HEAD_LEVELS - 2, &limb->path);
	limb->length_m = length_m - (float)low * level_m;
	flood(body, s, head, (float)low * level_m);
	return true;
}

void parts_trunk(const struct body *body, struct parts_scratch *s, struct v3 pelvis_m,
		 struct v3 neck_m)
{
	float level_m = measure_along(body, s, pelvis_m, neck_m) / (float)TRUNK_LEVELS;
	parts_contours(body, s, level_m, TRUNK_LEVELS, OWNER_NONE);
	float widest_m = 0.0f;
	for (int k = 0; k <= TRUNK_LEVELS; k++)
		widest_m = float_max(widest_m, s->contour[k].girth_m);
	int low = 1;
	while (low < TRUNK_LEVELS / 2 && s->contour[low].girth_m < 0.5f * widest_m)
		low++;
	parts_path(s, low, TRUNK_LEVELS - 1, &s->trunk);
}
