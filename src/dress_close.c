/* Seams close round the body. What a seam joins may lie on two sides of a shoulder or an arm: the
 * straight way leads through it, and contact holds both where they are. Such pairs go round the
 * bone that lies between them, to the side to which both edges look from their cloth. */
#include "dress_private.h"

static const float round_step_m = 0.003f; /* a sweep */
static const float opposed = 0.5f; /* largest cosine between the ways to two opposite sides */
static const float agreed = 0.7f;  /* least length of the mean of the edges' two looks */

/* The ends of a pair, as seen from the bone that is nearest to their middle. */
struct between {
	struct v3 a, b;
};

static bool look_between(const struct cloth *cloth, const struct seam_pair *pair,
			 struct between *between)
{
	int a = cloth->particle[pair->a], b = cloth->particle[pair->b];
	if (a == b || !cloth->placed[a] || !cloth->placed[b] || cloth->body->bone_count == 0)
		return false;
	struct v3 a_m = cloth->position_m[a], b_m = cloth->position_m[b];
	struct v3 bone_m = body_nearest_bone(cloth->body, 0, v3_lerp(a_m, b_m, 0.5f));
	between->a = v3_sub(a_m, bone_m);
	between->b = v3_sub(b_m, bone_m);
	return v3_length(between->a) + v3_length(between->b) > 1e-3f;
}

/* The middle of what lies round a particle. */
static struct v3 middle_round(const struct cloth *cloth, int v)
{
	const struct v3 *x = cloth->position_m;
	int first = cloth->star_first[v], end = cloth->star_first[v + 1];
	struct v3 sum = {0.0f, 0.0f, 0.0f};
	for (int i = first; i < end; i++) {
		const int *t = cloth->triangle[cloth->star[i] / 4].v;
		sum = v3_add(sum, v3_add(v3_add(x[t[0]], x[t[1]]), x[t[2]]));
	}
	return v3_scale(sum, 1.0f / (float)int_max(3 * (end - first), 1));
}

/* Of all that is sewn, before any of it moves. */
static void find_middles(struct wrap *wrap)
{
	const struct cloth *cloth = wrap->cloth;
	for (int i = 0; i < 2 * cloth->garment->pair_count; i++) {
		const struct seam_pair *pair = &cloth->garment->pair[i / 2];
		int v = cloth->particle[i & 1 ? pair->b : pair->a];
		wrap->scratch->sum_m[v] = middle_round(cloth, v);
	}
}

/* Where the edge of cloth looks: from the middle of what lies round a vertex to the vertex. */
static struct v3 look_of(const struct wrap *wrap, int v)
{
	return v3_normalize(v3_sub(wrap->cloth->position_m[v], wrap->scratch->sum_m[v]));
}

/* A step of a particle round the bone, `from` there, towards a direction. */
static void go_round(struct cloth *cloth, int v, struct v3 from, struct v3 to)
{
	struct v3 out = v3_normalize(from);
	struct v3 tangent = v3_mad(to, out, -v3_dot(to, out));
	if (!cloth->held[v])
		cloth->position_m[v] = v3_mad(cloth->position_m[v], v3_normalize(tangent),
					      round_step_m);
}

long wrap_close_round(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	find_middles(wrap);
	for (int i = 0; i < cloth->garment->pair_count; i++) {
		const struct seam_pair *pair = &cloth->garment->pair[i];
		int a = cloth->particle[pair->a], b = cloth->particle[pair->b];
		struct between at;
		if (!look_between(cloth, pair, &at) ||
		    v3_dot(v3_normalize(at.a), v3_normalize(at.b)) > opposed)
			continue;
		struct v3 to = v3_scale(v3_add(look_of(wrap, a), look_of(wrap, b)), 0.5f);
		if (v3_length(to) < agreed)
			continue;
		go_round(cloth, a, at.a, to);
		go_round(cloth, b, at.b, to);
	}
	return cloth->garment->triangle_count;
}
