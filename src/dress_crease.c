/* Folds that were made on purpose: a sleeve rolled up against pins (S12). Cloth that was dragged
 * with pins in place and lies folded or in waves when the hand lets go is creased: nobody turns it
 * back, and it rests on what lies under it, body or cloth. The hand that takes hold of it again
 * opens it. */
#include "dress_drag_private.h"

static const float hand_span_m = 0.15f;
static const float bend_m = 0.075f; /* cloth so near to what faces the body belongs to the fold */
static const float rest_step_m = 0.0005f; /* a frame: less than this is friction's */
static const float rest_share = 0.5f;     /* and of what is more, this */
static const float rest_near_m = 0.04f;   /* cloth farther from the body rests on nothing */
static const float stands_cosine = 0.5f;  /* between its normal and the body's: less */

/* Marks particles in the triangles round every particle of the mark before. */
static void grow(struct drag *drag, uint8_t mark)
{
	struct cloth *cloth = drag->cloth;
	const int *first = cloth->star_first;
	for (int j = 0; j < drag->order_count; j++) {
		int a = drag->order[j];
		for (int i = first[a]; cloth->creased[a] == mark && i < first[a + 1]; i++)
			for (int k = 0; k < 3; k++) {
				int b = cloth->triangle[cloth->star[i] >> 2].v[k];
				if (!cloth->creased[b])
					cloth->creased[b] = (uint8_t)(mark + 1);
			}
	}
}

/* Does a triangle near the body stand up from it, as the sides of a wave that has not tipped over
 * yet? */
static bool stands(const struct cloth *cloth, int t)
{
	const int *v = cloth->triangle[t].v;
	const struct v3 *x = cloth->position_m;
	struct v3 out = {0.0f, 0.0f, 0.0f};
	for (int k = 0; k < 3; k++) {
		if (cloth->contact[v[k]].distance_m > rest_near_m)
			return false;
		out = v3_add(out, cloth->contact[v[k]].normal);
	}
	struct v3 normal = v3_cross(v3_sub(x[v[1]], x[v[0]]), v3_sub(x[v[2]], x[v[0]]));
	return v3_dot(v3_normalize(normal), v3_normalize(out)) < stands_cosine;
}

void drag_crease(struct drag *drag)
{
	struct cloth *cloth = drag->cloth;
	for (int t = 0; t < cloth->garment->triangle_count; t++) {
		const int *v = cloth->triangle[t].v;
		if (drag->distance_m[v[0]] < 0.0f || !(stands(cloth, t) || cloth_folded(cloth, t)))
			continue;
		for (int k = 0; k < 3; k++)
			cloth->creased[v[k]] = 1;
	}
	int rings = int_clamp((int)(bend_m / cloth->garment->edge_m), 1, UINT8_MAX - 1);
	for (int ring = 1; ring <= rings; ring++)
		grow(drag, (uint8_t)ring);
	for (int j = 0; j < drag->order_count; j++)
		cloth->creased[drag->order[j]] = cloth->creased[drag->order[j]] != 0;
}

void drag_open_creases(struct drag *drag)
{
	for (int j = 0; j < drag->order_count; j++) {
		int a = drag->order[j];
		if (drag->distance_m[a] >= hand_span_m)
			break;
		drag->cloth->creased[a] = 0;
	}
}

void crease_rest(struct cloth *cloth, const struct v3 *start_m)
{
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		if (!cloth->creased[v] || cloth->held[v] || cloth->particle[v] != v ||
		    cloth->contact[v].distance_m > rest_near_m)
			continue;
		struct v3 step = v3_sub(cloth->position_m[v], start_m[v]);
		float length = v3_length(step), kept = 0.0f;
		if (length > rest_step_m)
			kept = rest_share * (length - rest_step_m) / length;
		cloth->position_m[v] = v3_mad(start_m[v], step, kept);
		cloth->previous_m[v] = cloth->position_m[v];
	}
}
