/* Contact with the body: every particle tracks its own nearest surface point (S17). */
#include "cloth_private.h"
#include "lanes.h"

enum {
	WALK_STEPS_MAX = 12,
	BONE_UNITS = 1, /* an edge against the bones of a limb */
	RAY_UNITS = 32, /* a segment's way through the tree, in triangles looked at */
};

static const float plane_off_m = 0.001f;   /* a plane that may be so wrong is found anew */
static const float way_slack_m = 1e-5f;    /* more than rounding takes from a way */
static const float near_m = 0.03f;         /* farther cloth can't touch in the next sweeps */
static const float push_max_m = 0.015f;    /* deepest step out in one sweep */
static const float near_margin_m = 0.001f; /* faces so little farther off are looked at too */
static const float lift_max_m = 0.015f;    /* highest a particle is lifted for its faces */
static const float cleft_facing = 0.3f;    /* cosine between normals: less, and a cleft is there */
static const float lift_slack_m = 0.0015f; /* faces this clear let their corners down again */
static const float still_share = 0.25f;    /* of what a face has to spare, and it counts as still */

/* How far from the body the particle stays, before its faces ask for more. */
static float clearance(const struct cloth *cloth, int v)
{
	return cloth->settings.offset_m + layer_lift(cloth, v);
}

static long look(struct cloth *cloth, int v)
{
	struct body_hit hit;
	long units = 0;
	if (body_track(cloth->body, cloth->position_m[v], allowed_parts(cloth, v),
		       &cloth->scratch->track[v], &hit, &units))
		cloth->contact[v] = (struct contact){hit.triangle, hit.point_m, hit.normal,
						     hit.distance_m};
	return units;
}

void cloth_look(struct cloth *cloth, int v)
{
	cloth->scratch->track[v].triangle = -1;
	cloth->scratch->quiet[v].way2_m2 = 0.0f;
	look(cloth, v);
}

/* However far a particle was moved since its last look, it has not passed through the body: it
 * stops on its way, where it comes as near to the surface as cloth may be. Only a way as long as
 * the distance was can meet it (the displacement bound of Chen et al., "Offset Geometric Contact",
 * 2025, here with the exact way instead of a shorter step, since the body stands still). It has no
 * motion left then. */
static bool stop_at_surface(struct cloth *cloth, int v, struct v3 from_m)
{
	struct v3 *p = &cloth->position_m[v];
	unsigned parts = allowed_parts(cloth, v);
	struct body_hit hit;
	if (!body_segment_hits(cloth->body, from_m, *p, &hit) ||
	    (parts && !(parts >> cloth->body->part[hit.triangle] & 1)))
		return false;
	struct v3 way = v3_sub(*p, from_m);
	float sinks = -v3_dot(way, cloth->body->face_normal[hit.triangle]);
	float before = clearance(cloth, v) / float_max(sinks, 1e-6f);
	*p = v3_mad(from_m, way, float_max(hit.distance_m - before, 0.0f));
	cloth->previous_m[v] = *p;
	return true;
}

/* Looks the contact up at the end of a way. Nothing can lie on it when both ends are so far from
 * all surface that their distances cover it; else it may have to end before, and is looked up
 * there. */
static long look_along(struct cloth *cloth, int v, float way)
{
	struct body_track before = cloth->scratch->track[v];
	struct contact contact = cloth->contact[v];
	long looked = look(cloth, v);
	const struct body_track *track = &cloth->scratch->track[v];
	bool covered = track->parts == before.parts &&
		       way + way_slack_m < before.least_m + track->least_m;
	if (contact.distance_m > 0.0f && !covered && stop_at_surface(cloth, v, before.at_m)) {
		cloth->scratch->track[v] = before;
		cloth->contact[v] = contact;
		looked = look(cloth, v);
	}
	return RAY_UNITS + looked;
}

/* How wrong the plane's distance may be, `way` from where it was found: the surface can be nearer
 * than it was there by as much, and the plane is left behind by what the particle has risen. */
static float plane_off(const struct cloth *cloth, int v, struct v3 gone, float way)
{
	const struct contact *contact = &cloth->contact[v];
	float risen = v3_dot(gone, contact->normal);
	if (contact->distance_m < 0.0f)
		risen = -risen;
	return cloth->scratch->track[v].off_m + way + float_max(risen, 0.0f);
}

static long refresh(struct cloth *cloth, int v)
{
	struct body_track *track = &cloth->scratch->track[v];
	if (cloth->contact[v].triangle < 0 || cloth->contact[v].triangle != track->triangle) {
		track->triangle = -1; /* new, or its contact was taken from elsewhere */
		return look(cloth, v);
	}
	struct v3 gone = v3_sub(cloth->position_m[v], track->at_m);
	float way = v3_length(gone);
	if (plane_off(cloth, v, gone, way) < plane_off_m && track->parts == allowed_parts(cloth, v))
		return 1;
	return way > track->least_m ? look_along(cloth, v, way) : look(cloth, v);
}

/* Up to where the particle's faces need it. Returns how far. */
static float rise(struct cloth *cloth, int v)
{
	const struct cloth_scratch *s = cloth->scratch;
	struct v3 *p = &cloth->position_m[v], way = s->lift_way[v];
	if (s->lift_m[v] <= 0.0f)
		return 0.0f;
	if (v3_dot(way, cloth->contact[v].normal) < cleft_facing)
		way = cloth->contact[v].normal;
	float height = v3_dot(v3_sub(*p, cloth->contact[v].point_m), way);
	float out = clearance(cloth, v) + s->lift_m[v] - height;
	if (out <= 0.0f)
		return 0.0f;
	*p = v3_mad(*p, way, float_min(out, push_max_m));
	return out;
}

/* Out along the normal. Friction: Coulomb's, so that cloth that hangs can rest (a step shorter than
 * grip times the push is lost wholly), and a share of what is left. */
static void push(struct cloth *cloth, int v)
{
	const struct contact *contact = &cloth->contact[v];
	struct v3 *p = &cloth->position_m[v], n = contact->normal;
	float d = v3_dot(v3_sub(*p, contact->point_m), n);
	if (contact->distance_m > near_m && d > 0.5f * near_m)
		return;
	float out = float_max(clearance(cloth, v) - d, 0.0f);
	*p = v3_mad(*p, n, float_min(out, push_max_m));
	out += rise(cloth, v);
	if (out <= 0.0f)
		return;
	struct v3 step = v3_sub(*p, cloth->previous_m[v]);
	step = v3_mad(step, n, -v3_dot(step, n));
	float length = v3_length(step), held = cloth->settings.grip * out;
	float lost = length > held ? cloth->settings.friction : 1.0f;
	if (length > held)
		lost += (1.0f - lost) * held / length;
	*p = v3_mad(*p, step, -lost);
}

float cloth_spare(const struct cloth *cloth, int v)
{
	const struct cloth_scratch *s = cloth->scratch;
	const struct contact *contact = &cloth->contact[v];
	struct v3 from = v3_sub(cloth->position_m[v], contact->point_m);
	float least = v3_dot(from, contact->normal);
	if (s->lift_m[v] > 0.0f)
		least = float_min(least, v3_dot(from, s->lift_way[v])) - s->lift_m[v];
	return least - clearance(cloth, v);
}

static void find_quiet(struct cloth *cloth, int v)
{
	const struct body_track *track = &cloth->scratch->track[v];
	struct v3 p = cloth->position_m[v];
	float gone = v3_distance(p, track->at_m);
	float looked = float_max(0.5f * (plane_off_m - track->off_m), body_track_idle_m(track));
	float way = float_min(cloth_spare(cloth, v), float_min(looked, track->least_m) - gone);
	cloth->scratch->quiet[v] = (struct quiet){p, way > 0.0f ? way * way : 0.0f};
}

/* After the push the plane is found anew where it left the particle: what was pushed far into a
 * hollow has another surface below it. */
long cloth_touch(struct cloth *cloth, int v)
{
	long units = refresh(cloth, v);
	push(cloth, v);
	units += refresh(cloth, v);
	find_quiet(cloth, v);
	return units;
}

/* What a stage of the wrap changes ends all quiet. */
static void note_stage(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	struct contact_stage now = {.offset_m = cloth->settings.offset_m};
	if (cloth->settings.filter_parts)
		memcpy(now.piece_parts, cloth->piece_parts, sizeof now.piece_parts);
	if (memcmp(&now, &s->stage, sizeof now) == 0)
		return;
	s->stage = now;
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		s->quiet[v].way2_m2 = 0.0f;
	for (int t = 0; t < cloth->garment->triangle_count; t++)
		s->face_quiet[t].far_m = s->face_quiet[t].near_m = 0.0f;
}

struct contact_pass {
	struct cloth *cloth;
	long units[GARMENT_VERTICES_MAX / LOOP_ROUNDS + 1]; /* per part */
};

static void touch_part(void *context, int part)
{
	struct contact_pass *pass = context;
	struct cloth *cloth = pass->cloth;
	const struct kernel *kernel = kernel_of(cloth->lanes);
	struct loop_part loop = loop_part(cloth->garment->vertex_count, part);
	long units = 0;
	for (int first = loop.first; first < loop.first + loop.count; first += BATCH) {
		unsigned stirred = kernel->stirred(cloth->position_m + first,
						   cloth->scratch->quiet + first);
		for (int v = first; stirred; v++, stirred >>= 1)
			if ((stirred & 1) && v < cloth->garment->vertex_count &&
			    is_particle(cloth, v))
				units += cloth_touch(cloth, v);
	}
	pass->units[part] = units;
}

long cloth_contact(struct cloth *cloth)
{
	struct contact_pass pass = {.cloth = cloth};
	int parts = loop_parts(cloth->garment->vertex_count);
	long units = 0;
	note_stage(cloth);
	crew_run(cloth->crew, touch_part, &pass, parts);
	for (int part = 0; part < parts; part++)
		units += pass.units[part];
	return units;
}

/* ---- faces ----
 *
 * A point inside a face stays outside the body by lifting the face's corners: a lift is kept from
 * sweep to sweep, so that cloth over an edge of the body rests and is not pushed and dropped. */

bool cloth_pierced(const struct cloth *cloth, const int *v, int corners)
{
	for (int k = 0; k < corners; k++) {
		int a = v[k], b = v[(k + 1) % corners];
		struct v3 na = cloth->contact[a].normal, nb = cloth->contact[b].normal;
		struct v3 apart = v3_sub(cloth->position_m[b], cloth->position_m[a]);
		if (v3_dot(na, nb) < 0.0f && v3_dot(apart, v3_sub(nb, na)) > 0.0f)
			return true;
	}
	return false;
}

/* A corner is to rise by `by_m` along `up`, the body's normal at the face's point: along their own
 * normals the corners over a peak would part and stretch the cloth between them. In a cleft, where
 * that way leads into the other side, a corner keeps to its own normal. */
static void lift(struct cloth *cloth, int v, struct v3 up, float by_m)
{
	struct cloth_scratch *s = cloth->scratch;
	if (v3_dot(up, cloth->contact[v].normal) < cleft_facing)
		up = cloth->contact[v].normal;
	struct v3 way = v3_normalize(
		v3_add(v3_scale(s->lift_way[v], s->lift_m[v]), v3_scale(up, by_m)));
	struct v3 to = v3_mad(v3_sub(cloth->position_m[v], cloth->contact[v].point_m), up, by_m);
	float high = v3_dot(to, way) - clearance(cloth, v);
	s->lift_way[v] = way;
	s->quiet[v].way2_m2 = 0.0f;
	s->lift_m[v] = float_clamp(high, s->lift_m[v], lift_max_m);
}

/* How much a point of a face, as weights of its corners, lacks; its corners are lifted by it. What
 * it has to spare bounds *spare_m. */
static long lift_point(struct cloth *cloth, const int v[3], const float weight[3], float *spare_m)
{
	struct cloth_scratch *s = cloth->scratch;
	struct v3 p = {0.0f, 0.0f, 0.0f};
	float squares = 0.0f, offset = 0.5f * cloth->settings.offset_m;
	int nearest = 0;
	for (int k = 0; k < 3; k++) {
		p = v3_mad(p, cloth->position_m[v[k]], weight[k]);
		squares += weight[k] * weight[k];
		nearest = weight[k] > weight[nearest] ? k : nearest;
	}
	struct body_hit hit;
	int looked = body_walk(cloth->body, p, cloth->contact[v[nearest]].triangle, WALK_STEPS_MAX,
			       &hit);
	float lack = offset - hit.distance_m;
	*spare_m = float_min(*spare_m, -lack);
	for (int k = 0; k < 3; k++)
		if (weight[k] > 0.0f)
			s->slack_m[v[k]] = float_min(s->slack_m[v[k]], -lack);
	if (lack <= 0.0f || hit.distance_m < -near_m || cloth_pierced(cloth, v, 3))
		return looked;
	for (int k = 0; k < 3; k++)
		if (weight[k] > 0.0f)
			lift(cloth, v[k], hit.normal, 0.7f * lack * weight[k] / squares);
	return looked;
}

/* How much farther from the body the corners are at least than where a face must be looked at. */
static float face_height(const struct cloth *cloth, const int v[3])
{
	const struct cloth_scratch *s = cloth->scratch;
	float least = 1.0f;
	for (int k = 0; k < 3; k++) {
		const struct contact *contact = &cloth->contact[v[k]];
		float gone = v3_distance(cloth->position_m[v[k]], s->track[v[k]].at_m);
		float need = clearance(cloth, v[k]) + near_margin_m + s->lift_m[v[k]];
		least = float_min(least, contact->distance_m - gone - need);
	}
	return least;
}

static bool face_rests(const struct cloth *cloth, int t, const struct face_quiet *quiet)
{
	const int *v = cloth->triangle[t].v;
	const struct v3 *x = cloth->position_m, *at = quiet->at_m;
	float far2 = quiet->far_m * quiet->far_m, near2 = quiet->near_m * quiet->near_m;
	lanes last = lanes_row(&x[v[2]]) - lanes_row(&at[2]);
	lanes moved2 = lanes_squared_lengths(lanes_row(&x[v[0]]) - lanes_row(&at[0]),
					     lanes_row(&x[v[1]]) - lanes_row(&at[1]), last, last);
	if (!lanes_any(~(moved2 < lanes_of(far2))))
		return true;
	if (lanes_any(~(moved2 < lanes_of(near2))))
		return false;
	for (int k = 0; k < 3; k++)
		cloth->scratch->slack_m[v[k]] = float_min(cloth->scratch->slack_m[v[k]], 0.0f);
	return true;
}

static void note_face(const struct cloth *cloth, int t, struct face_quiet *quiet, float clear_m,
		      float still_m)
{
	const int *v = cloth->triangle[t].v;
	const struct v3 *x = cloth->position_m;
	*quiet = (struct face_quiet){
		{x[v[0]], x[v[1]], x[v[2]]}, float_max(clear_m, 0.0f), float_max(still_m, 0.0f)};
}

/* Corners whose faces were clear in the whole last round come down by a fifth. */
static void lower_lifts(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		if (s->slack_m[v] > lift_slack_m)
			s->lift_m[v] *= 0.8f;
		s->slack_m[v] = 1.0f;
	}
}

/* An edge whose ends both lie on one limb, or on the neck, and that passes the bone inside is on
 * the wrong side of it: both ends move the way back (S19). */
static long leave_bone(struct cloth *cloth, int a, int b)
{
	const struct body *body = cloth->body;
	const struct contact *on_a = &cloth->contact[a], *on_b = &cloth->contact[b];
	enum body_part part = (enum body_part)body->part[on_a->triangle];
	struct v3 push;
	if (part == PART_TRUNK || body->part[on_b->triangle] != part)
		return 0;
	if (!body_bone_crossed(body, part, cloth->position_m[a], cloth->position_m[b],
			       v3_add(on_a->normal, on_b->normal), &push))
		return BONE_UNITS;
	float length = v3_length(push);
	push = v3_scale(push, float_min(length, push_max_m) / float_max(length, 1e-6f));
	cloth->position_m[a] = v3_add(cloth->position_m[a], push);
	cloth->position_m[b] = v3_add(cloth->position_m[b], push);
	return BONE_UNITS;
}

/* Three points of every edge of the triangle, and the centre. Edges of two triangles are looked at
 * in the first. */
static long look_at_face(struct cloth *cloth, int t, struct face_quiet *quiet)
{
	static const float third[3] = {1.0f / 3.0f, 1.0f / 3.0f, 1.0f / 3.0f};
	const int *v = cloth->triangle[t].v;
	uint8_t owner = cloth->scratch->edge_owner[t];
	if (!corners_placed(cloth, t) || face_rests(cloth, t, quiet))
		return 0;
	for (int k = 0; k < 3; k++)
		if (cloth->contact[v[k]].triangle < 0)
			return 0;
	float spare_m = 1.0f, height_m = face_height(cloth, v);
	if (height_m >= 0.0f) {
		note_face(cloth, t, quiet, height_m, 0.0f);
		return 0;
	}
	long units = lift_point(cloth, v, third, &spare_m);
	for (int k = 0; k < 3; k++)
		if (owner >> k & 1)
			units += leave_bone(cloth, v[k], v[(k + 1) % 3]);
	for (int k = 0; k < 3; k++)
		for (int i = 1; (owner >> k & 1) && i < 4; i++) {
			float weight[3] = {0.0f, 0.0f, 0.0f};
			weight[k] = 1.0f - 0.25f * (float)i;
			weight[(k + 1) % 3] = 0.25f * (float)i;
			units += lift_point(cloth, v, weight, &spare_m);
		}
	note_face(cloth, t, quiet, spare_m - lift_slack_m, still_share * spare_m);
	return units;
}

struct face_pass {
	struct cloth *cloth;
	int slice, slices, first_group;
	long units[STRIPS_MAX]; /* per part */
};

/* Faces of a frame's slice lie together in memory, in which the quiet of all is the most.
 *
 * Faces lift their corners: they are shared out as the triangles' shapes are (cloth_order.c). */
static void face_group(void *context, int part)
{
	struct face_pass *pass = context;
	const struct cloth_scratch *s = pass->cloth->scratch;
	const int *first = &s->face_first[pass->first_group + part];
	long units = 0;
	int count = first[1] - first[0];
	for (int i = pass->slice; i < count; i += pass->slices) {
		units += look_at_face(pass->cloth, s->face[first[0] + i],
				      &s->face_quiet[first[0] + sliced(count, i)]);
	}
	pass->units[part] = units;
}

long cloth_contact_faces(struct cloth *cloth, int slice, int slices)
{
	struct face_pass pass = {.cloth = cloth, .slice = slice, .slices = slices};
	int strips = cloth->scratch->strip_count;
	long units = 0;
	if (slice == 0)
		lower_lifts(cloth);
	for (int cuts = 0; cuts < 2; cuts++) {
		pass.first_group = cuts * strips;
		crew_run(cloth->crew, face_group, &pass, strips - cuts);
		for (int part = 0; part < strips - cuts; part++)
			units += pass.units[part];
	}
	return units;
}
