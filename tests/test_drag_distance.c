/* How well the drag's front measures distance along the body: against the formula on a sphere and a
 * cylinder, and on the mannequin's trunk against shortest ways over a net of points on its edges.
 */
#include "dress_drag_private.h"
#include "scene.h"
#include "shapes.h"
#include "test.h"
#include "tube.h"

enum {
	GRABS = 8,
	SPHERE_SPLITS = 5,
	NET_EDGES_MAX = 16384,
	NET_PARTS = 8, /* of an edge */
	NET_NODES_MAX = GARMENT_VERTICES_MAX + (NET_PARTS - 1) * NET_EDGES_MAX,
};

static const float offset_m = 0.004f;
static const float sphere_m = 0.2f;
static struct shape shape;
static struct v3 worn_m[GARMENT_VERTICES_MAX];

/* ---- shapes ---- */

struct edges {
	int count;
	int low[NET_EDGES_MAX], high[NET_EDGES_MAX];
	int first[SHAPE_VERTICES_MAX], next[NET_EDGES_MAX]; /* lists by the lower end, 1 more */
};

/* The number of edge a-b; a new one is counted. */
static int edge_of(struct edges *edges, int a, int b)
{
	int low = int_min(a, b), high = int_max(a, b);
	for (int e = edges->first[low]; e > 0; e = edges->next[e - 1])
		if (edges->high[e - 1] == high)
			return e - 1;
	int e = edges->count++;
	MUST(e < NET_EDGES_MAX);
	edges->low[e] = low;
	edges->high[e] = high;
	edges->next[e] = edges->first[low];
	edges->first[low] = e + 1;
	return e;
}

/* Every triangle in four, on the unit sphere. */
static void split(void)
{
	static struct edges edges;
	int triangles = shape.triangle_count, vertices = shape.vertex_count;
	memset(&edges, 0, sizeof edges);
	for (int t = 0; t < triangles; t++) {
		int v[3], m[3];
		memcpy(v, shape.triangle[t].v, sizeof v);
		for (int k = 0; k < 3; k++) {
			struct v3 a = shape.position_m[v[k]], b = shape.position_m[v[(k + 1) % 3]];
			struct v3 p = v3_normalize(v3_add(a, b));
			m[k] = vertices + edge_of(&edges, v[k], v[(k + 1) % 3]);
			shape.position_m[m[k]] = p;
		}
		shape.triangle[t] = (struct triangle){{m[0], m[1], m[2]}};
		for (int k = 0; k < 3; k++)
			shape_triangle(&shape, v[k], m[k], m[(k + 2) % 3]);
	}
	shape.vertex_count = vertices + edges.count;
}

/* An octahedron split and made round: corners of 60 to 90 degrees. */
static void make_sphere(void)
{
	shape.vertex_count = shape.triangle_count = 0;
	for (int axis = 0; axis < 3; axis++)
		for (float side = -1.0f; side < 2.0f; side += 2.0f)
			shape_vertex(&shape, axis == 0 ? side : 0.0f, axis == 1 ? side : 0.0f,
				     axis == 2 ? side : 0.0f);
	for (int i = 0; i < 8; i++) {
		int x = i & 1, y = 2 + (i >> 1 & 1), z = 4 + (i >> 2 & 1);
		bool out = ((i ^ i >> 1 ^ i >> 2) & 1) != 0;
		shape_triangle(&shape, x, out ? y : z, out ? z : y);
	}
	for (int i = 0; i < SPHERE_SPLITS; i++)
		split();
}

static float sphere_radius(int ring, int column)
{
	(void)ring;
	(void)column;
	return sphere_m;
}

static void take_body(struct scene *scene)
{
	MUST(!body_build(&scene->session.body, shape.position_m, shape.vertex_count, shape.triangle,
			 shape.triangle_count));
}

/* ---- cloth ---- */

/* The shape's own triangles as a garment of one piece at worn_m. */
static void lay_shape(struct scene *scene)
{
	struct garment *garment = &scene->session.garment;
	MUST(shape.vertex_count <= GARMENT_VERTICES_MAX);
	garment->vertex_count = shape.vertex_count;
	garment->triangle_count = shape.triangle_count;
	garment->pair_count = 0;
	garment->edge_m = 0.01f;
	for (int v = 0; v < shape.vertex_count; v++) {
		garment->rest_m[v] = (struct v2){worn_m[v].x, worn_m[v].y};
		garment->piece[v] = 0;
		garment->weld[v] = v;
	}
	memcpy(garment->triangle, shape.triangle,
	       (size_t)shape.triangle_count * sizeof *shape.triangle);
	tube_wear(&scene->session, worn_m, false);
}

/* ---- figures ---- */

struct error {
	int count;
	float sum, most;
};

static void note(struct error *error, float distance_m, float exact_m)
{
	if (exact_m < 0.02f)
		return;
	float off = float_abs(distance_m / exact_m - 1.0f);
	error->count++;
	error->sum += off;
	error->most = float_max(error->most, off);
}

static void grab(struct scene *scene, int triangle)
{
	static const float weight[3] = {0.5f, 0.3f, 0.2f};
	drag_begin(&scene->session.drag, &scene->session.cloth, NULL, 0, triangle, weight);
}

/* What lies under the grabbed point. */
static struct v3 grabbed_m(const struct scene *scene)
{
	const struct drag *drag = &scene->session.drag;
	struct body_hit hit;
	body_nearest(&scene->session.body, drag_point(drag), 0, &hit);
	return hit.point_m;
}

typedef float (*formula)(struct v3 a, struct v3 b);

static float on_sphere(struct v3 a, struct v3 b)
{
	return sphere_m * angle_acos(v3_dot(v3_normalize(a), v3_normalize(b)));
}

static struct error errors_of(struct scene *scene, formula exact)
{
	const struct session *session = &scene->session;
	struct error error = {0};
	for (int g = 0; g < GRABS; g++) {
		grab(scene, session->garment.triangle_count * g / GRABS + 7);
		struct v3 from = grabbed_m(scene);
		for (int k = 0; k < session->drag.order_count; k++) {
			int a = session->drag.order[k];
			note(&error, session->drag.distance_m[a],
			     exact(from, session->cloth.contact[a].point_m));
		}
		drag_end(&scene->session.drag);
	}
	return error;
}

static void say(const char *where, struct error error)
{
	printf("%s: distance off by %.2f %% in the mean, %.1f %% at most\n", where,
	       (double)(100.0f * error.sum / (float)error.count), (double)(100.0f * error.most));
	CHECK(error.count > 1000);
	CHECK(error.sum / (float)error.count < 0.01f);
	CHECK(error.most < 0.05f);
}

static void check_sphere(struct scene *scene)
{
	shape_globe(&shape, 120, 240, sphere_radius);
	take_body(scene);
	make_sphere();
	for (int v = 0; v < shape.vertex_count; v++)
		worn_m[v] = v3_scale(shape.position_m[v], sphere_m + offset_m);
	lay_shape(scene);
	say("sphere", errors_of(scene, on_sphere));
}

static void check_cylinder(struct scene *scene)
{
	tube_lay(scene, 2400);
	say("cylinder", errors_of(scene, tube_distance));
}

/* ---- the net: shortest ways over points on the edges of the shape ---- */

enum { TRIANGLE_NODES = 3 * NET_PARTS };

struct net {
	struct edges edges;
	int edge[GARMENT_TRIANGLES_MAX][3]; /* k: from corner k to the next */
	struct v3 node_m[NET_NODES_MAX];
	float distance_m[NET_NODES_MAX];
	bool fresh[NET_NODES_MAX], was_fresh[NET_NODES_MAX];
};

static void build_net(struct net *net)
{
	memset(net, 0, sizeof *net);
	for (int t = 0; t < shape.triangle_count; t++)
		for (int k = 0; k < 3; k++)
			net->edge[t][k] = edge_of(&net->edges, shape.triangle[t].v[k],
						  shape.triangle[t].v[(k + 1) % 3]);
	memcpy(net->node_m, shape.position_m, (size_t)shape.vertex_count * sizeof *net->node_m);
	for (int e = 0; e < net->edges.count; e++)
		for (int i = 1; i < NET_PARTS; i++)
			net->node_m[shape.vertex_count + e * (NET_PARTS - 1) + i - 1] = v3_lerp(
				shape.position_m[net->edges.low[e]],
				shape.position_m[net->edges.high[e]], (float)i / (float)NET_PARTS);
}

static void nodes_of(const struct net *net, int t, int node[TRIANGLE_NODES])
{
	for (int k = 0; k < 3; k++) {
		node[k * NET_PARTS] = shape.triangle[t].v[k];
		for (int i = 1; i < NET_PARTS; i++)
			node[k * NET_PARTS + i] = shape.vertex_count +
						  net->edge[t][k] * (NET_PARTS - 1) + i - 1;
	}
}

/* Straight ways within one triangle. */
static bool relax(struct net *net, int t)
{
	int node[TRIANGLE_NODES];
	bool better = false;
	nodes_of(net, t, node);
	for (int i = 0; i < TRIANGLE_NODES; i++)
		for (int j = 0; net->was_fresh[node[i]] && j < TRIANGLE_NODES; j++) {
			float d = net->distance_m[node[i]] +
				  v3_distance(net->node_m[node[i]], net->node_m[node[j]]);
			if (!(d < net->distance_m[node[j]]))
				continue;
			net->distance_m[node[j]] = d;
			net->fresh[node[j]] = better = true;
		}
	return better;
}

static void measure_net(struct net *net, int triangle, struct v3 from_m)
{
	int count = shape.vertex_count + net->edges.count * (NET_PARTS - 1);
	int node[TRIANGLE_NODES];
	bool better = true;
	for (int i = 0; i < count; i++)
		net->distance_m[i] = 1e9f;
	memset(net->fresh, 0, sizeof net->fresh);
	nodes_of(net, triangle, node);
	for (int i = 0; i < TRIANGLE_NODES; i++) {
		net->distance_m[node[i]] = v3_distance(net->node_m[node[i]], from_m);
		net->fresh[node[i]] = true;
	}
	while (better) {
		better = false;
		memcpy(net->was_fresh, net->fresh, sizeof net->fresh);
		memset(net->fresh, 0, sizeof net->fresh);
		for (int t = 0; t < shape.triangle_count; t++)
			better |= relax(net, t);
	}
}

/* The mannequin's trunk from the hips to the armpits. */
static void take_trunk(const struct body *body)
{
	static int number[BODY_VERTICES_MAX];
	memset(number, 0, sizeof number);
	shape.vertex_count = shape.triangle_count = 0;
	for (int t = 0; t < body->triangle_count; t++) {
		bool inside = body->part[t] == PART_TRUNK;
		const int *v = body->triangle[t].v;
		int own[3];
		for (int k = 0; k < 3; k++)
			inside &= body->position_m[v[k]].y > 0.9f &&
				  body->position_m[v[k]].y < 1.3f;
		for (int k = 0; inside && k < 3; k++) {
			struct v3 p = body->position_m[v[k]];
			if (number[v[k]] == 0)
				number[v[k]] = shape_vertex(&shape, p.x, p.y, p.z) + 1;
			own[k] = number[v[k]] - 1;
			worn_m[own[k]] = v3_mad(p, body->normal[v[k]], offset_m);
		}
		if (inside)
			shape_triangle(&shape, own[0], own[1], own[2]);
	}
}

static void check_trunk(struct scene *scene)
{
	static struct net net;
	struct session *session = &scene->session;
	struct error error = {0};
	MUST(!body_build_mannequin(&session->body));
	body_find_parts(&session->body);
	take_trunk(&session->body);
	lay_shape(scene);
	build_net(&net);
	for (int g = 0; g < 4; g++) {
		int triangle = session->garment.triangle_count * g / 4 + 7;
		grab(scene, triangle);
		measure_net(&net, triangle, grabbed_m(scene));
		for (int k = 0; k < session->drag.order_count; k++) {
			int a = session->drag.order[k];
			note(&error, session->drag.distance_m[a], net.distance_m[a]);
		}
		drag_end(&session->drag);
	}
	printf("%d vertices ", shape.vertex_count);
	say("trunk", error);
}

int main(void)
{
	struct scene *scene = scene_open();
	check_sphere(scene);
	check_cylinder(scene);
	check_trunk(scene);
	scene_close(scene);
	return test_end();
}
