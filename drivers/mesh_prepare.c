#include "mesh_prepare.h"

#include <stdio.h>
#include <stdlib.h>

static void add_note(char note[200], const char *text)
{
	size_t used = strlen(note);
	snprintf(note + used, 200 - used, "%s%s", used ? "; " : "", text);
}

/* ---- size and place ---- */

static void bounds(const struct mesh *mesh, struct v3 *low, struct v3 *high)
{
	*low = *high = mesh->position_m[0];
	for (int v = 1; v < mesh->vertex_count; v++) {
		struct v3 at = mesh->position_m[v];
		low->x = float_min(low->x, at.x), high->x = float_max(high->x, at.x);
		low->y = float_min(low->y, at.y), high->y = float_max(high->y, at.y);
		low->z = float_min(low->z, at.z), high->z = float_max(high->z, at.z);
	}
}

/* Metres per unit, guessed from the largest extent of something that wears clothes; 0: unknown. */
static float unit_of(float extent, char note[200])
{
	if (extent >= 0.2f && extent <= 5.0f)
		return 1.0f;
	if (extent >= 25.0f && extent <= 300.0f) {
		add_note(note, "taken to be in centimetres");
		return 0.01f;
	}
	if (extent > 300.0f && extent <= 5000.0f) {
		add_note(note, "taken to be in millimetres");
		return 0.001f;
	}
	return 0.0f;
}

static const char *stand(struct mesh *mesh, char note[200])
{
	struct v3 low, high;
	bounds(mesh, &low, &high);
	struct v3 size = v3_sub(high, low);
	float extent = float_max(size.x, float_max(size.y, size.z));
	struct v3 shift = {-0.5f * (low.x + high.x), -low.y, -0.5f * (low.z + high.z)};
	float farthest = float_max(float_abs(shift.x),
				   float_max(float_abs(shift.y), float_abs(shift.z)));
	float unit = unit_of(extent, note);
	if (unit == 0.0f)
		return "its size is no body's in metres, centimetres or millimetres; "
		       "export it in metres";
	if (farthest > 1000.0f * extent)
		return "it stands so far from the origin that its shape is lost in rounding; "
		       "move it to the origin and export it again";
	bool aside = float_max(float_abs(shift.x), float_abs(shift.z)) > 0.5f * extent;
	bool afloat = float_abs(shift.y) > 0.006f * extent;
	if (!aside)
		shift.x = shift.z = 0.0f;
	if (!afloat)
		shift.y = 0.0f;
	if (aside || afloat)
		add_note(note, "moved to stand on the floor at the origin");
	for (int v = 0; v < mesh->vertex_count && (aside || afloat || unit < 1.0f); v++)
		mesh->position_m[v] = v3_scale(v3_add(mesh->position_m[v], shift), unit);
	if (size.z > 2.5f * size.y)
		add_note(note, "much deeper than high: if it lies down, export it with +Y up");
	return NULL;
}

/* ---- edges ---- */

/* One side of an undirected edge, sorted by its ends. */
struct side {
	int low, high, triangle;
	bool forward; /* the triangle runs from low to high */
};

static int compare_sides(const void *a, const void *b)
{
	const struct side *s = a, *t = b;
	if (s->low != t->low)
		return s->low < t->low ? -1 : 1;
	if (s->high != t->high)
		return s->high < t->high ? -1 : 1;
	return (s->triangle > t->triangle) - (s->triangle < t->triangle);
}

/* All sides, sorted, so that the sides of one edge stand together. */
static void list_sides(const struct mesh *mesh, struct side *side)
{
	for (int t = 0; t < mesh->triangle_count; t++)
		for (int k = 0; k < 3; k++) {
			int a = mesh->triangle[t].v[k], b = mesh->triangle[t].v[(k + 1) % 3];
			side[3 * t + k] = (struct side){int_min(a, b), int_max(a, b), t, a < b};
		}
	qsort(side, 3 * (size_t)mesh->triangle_count, sizeof *side, compare_sides);
}

/* How many sides from `first` on belong to the same edge. */
static int run_length(const struct side *side, int first, int count)
{
	int end = first + 1;
	while (end < count && side[end].low == side[first].low &&
	       side[end].high == side[first].high)
		end++;
	return end - first;
}

struct edge_census {
	int open;    /* edges with one triangle */
	int crowded; /* with more than two */
	int clashes; /* whose two triangles run the same way */
};

static struct edge_census count_edges(const struct side *side, int count)
{
	struct edge_census census = {0};
	for (int i = 0, run; i < count; i += run) {
		run = run_length(side, i, count);
		census.open += run == 1;
		census.crowded += run > 2;
		census.clashes += run == 2 && side[i].forward == side[i + 1].forward;
	}
	return census;
}

/* ---- welding ---- */

struct place {
	struct v3 at;
	int vertex;
};

static int compare_floats(float a, float b)
{
	return (a > b) - (a < b);
}

static int compare_places(const void *a, const void *b)
{
	const struct place *p = a, *q = b;
	int order = compare_floats(p->at.x, q->at.x);
	order = order ? order : compare_floats(p->at.y, q->at.y);
	order = order ? order : compare_floats(p->at.z, q->at.z);
	return order ? order : (p->vertex > q->vertex) - (p->vertex < q->vertex);
}

/* Vertices at exactly the same place become the first of them; the others stay, unused, until
 * drop_vertices. */
static void weld(struct mesh *mesh, struct place *place, int *into)
{
	for (int v = 0; v < mesh->vertex_count; v++)
		place[v] = (struct place){mesh->position_m[v], v};
	qsort(place, (size_t)mesh->vertex_count, sizeof *place, compare_places);
	for (int i = 0, first = 0; i < mesh->vertex_count; i++) {
		if (v3_distance(place[i].at, place[first].at) > 0.0f)
			first = i;
		into[place[i].vertex] = place[first].vertex;
	}
	for (int t = 0; t < mesh->triangle_count; t++)
		for (int k = 0; k < 3; k++)
			mesh->triangle[t].v[k] = into[mesh->triangle[t].v[k]];
}

/* Removes vertices that no triangle uses. */
static void drop_vertices(struct mesh *mesh, int *into)
{
	memset(into, 0, (size_t)mesh->vertex_count * sizeof *into);
	for (int t = 0; t < mesh->triangle_count; t++)
		for (int k = 0; k < 3; k++)
			into[mesh->triangle[t].v[k]] = 1;
	int kept = 0;
	for (int v = 0; v < mesh->vertex_count; v++) {
		if (!into[v])
			continue;
		mesh->position_m[kept] = mesh->position_m[v];
		into[v] = kept++;
	}
	mesh->vertex_count = kept;
	for (int t = 0; t < mesh->triangle_count; t++)
		for (int k = 0; k < 3; k++)
			mesh->triangle[t].v[k] = into[mesh->triangle[t].v[k]];
}

/* ---- doubled and flat triangles ---- */

/* The same triangle whatever corner it starts at: smallest first, direction kept. */
static struct triangle rotated(struct triangle triangle)
{
	int *v = triangle.v, first = v[0] < v[1] ? (v[0] < v[2] ? 0 : 2) : (v[1] < v[2] ? 1 : 2);
	return (struct triangle){{v[first], v[(first + 1) % 3], v[(first + 2) % 3]}};
}

struct numbered {
	struct triangle triangle;
	int index;
};

static int compare_numbered(const void *a, const void *b)
{
	const struct numbered *s = a, *t = b;
	for (int k = 0; k < 3; k++)
		if (s->triangle.v[k] != t->triangle.v[k])
			return s->triangle.v[k] < t->triangle.v[k] ? -1 : 1;
	return (s->index > t->index) - (s->index < t->index);
}

/* Keeps the first of equal triangles, and none that names a vertex twice. Returns how many went. */
static int drop_triangles(struct mesh *mesh, struct numbered *sorted)
{
	int before = mesh->triangle_count, kept = 0;
	for (int t = 0; t < before; t++)
		sorted[t] = (struct numbered){rotated(mesh->triangle[t]), t};
	qsort(sorted, (size_t)before, sizeof *sorted, compare_numbered);
	for (int i = 0; i < before; i++) {
		int *v = sorted[i].triangle.v;
		bool doubled = i > 0 && memcmp(v, sorted[i - 1].triangle.v, 3 * sizeof *v) == 0;
		if (doubled || v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
			mesh->triangle[sorted[i].index].v[0] = -1;
	}
	for (int t = 0; t < before; t++)
		if (mesh->triangle[t].v[0] >= 0)
			mesh->triangle[kept++] = mesh->triangle[t];
	mesh->triangle_count = kept;
	return before - kept;
}

/* ---- orientation ---- */

static void flip(struct triangle *triangle)
{
	int v = triangle->v[1];
	triangle->v[1] = triangle->v[2];
	triangle->v[2] = v;
}

static double volume_of(const struct mesh *mesh, const struct triangle *triangle)
{
	const struct v3 *p = mesh->position_m;
	struct v3 a = p[triangle->v[0]], b = p[triangle->v[1]], c = p[triangle->v[2]];
	return (double)v3_dot(a, v3_cross(b, c)) / 6.0;
}

/* Clearly so: two shells that cancel each other are not. */
static bool inside_out(const struct mesh *mesh)
{
	double volume = 0.0, magnitude = 0.0;
	for (int t = 0; t < mesh->triangle_count; t++) {
		double part = volume_of(mesh, &mesh->triangle[t]);
		volume += part;
		magnitude += part < 0.0 ? -part : part;
	}
	return volume < -1e-3 * magnitude;
}

/* For each triangle and edge k the triangle across it, and whether that one must be flipped to run
 * with this one; -1 across open and crowded edges. */
struct across {
	int triangle[3];
	bool clash[3];
};

static void find_across(const struct mesh *mesh, const struct side *side, struct across *across)
{
	int count = 3 * mesh->triangle_count;
	for (int t = 0; t < mesh->triangle_count; t++)
		for (int k = 0; k < 3; k++)
			across[t].triangle[k] = -1;
	for (int i = 0, run; i < count; i += run) {
		run = run_length(side, i, count);
		if (run != 2)
			continue;
		for (int s = 0; s < 2; s++) {
			const struct side *own = &side[i + s], *other = &side[i + 1 - s];
			const int *v = mesh->triangle[own->triangle].v;
			int k = 0;
			while (int_min(v[k], v[(k + 1) % 3]) != own->low ||
			       int_max(v[k], v[(k + 1) % 3]) != own->high)
				k++;
			across[own->triangle].triangle[k] = other->triangle;
			across[own->triangle].clash[k] = own->forward == other->forward;
		}
	}
}

/* Floods each connected part from its first triangle so that all run alike, then turns a part whose
 * volume is negative inside out. `turned` marks 1 kept, 2 flipped; `queue` holds a part. */
static void orient(struct mesh *mesh, const struct across *across, uint8_t *turned, int *queue)
{
	memset(turned, 0, (size_t)mesh->triangle_count);
	for (int start = 0; start < mesh->triangle_count; start++) {
		int count = 0;
		double volume = 0.0;
		if (turned[start])
			continue;
		turned[start] = 1;
		queue[count++] = start;
		for (int i = 0; i < count; i++) {
			int t = queue[i];
			for (int k = 0; k < 3; k++) {
				int other = across[t].triangle[k];
				if (other < 0 || turned[other])
					continue;
				turned[other] = across[t].clash[k] ? 3 - turned[t] : turned[t];
				queue[count++] = other;
			}
			double part = volume_of(mesh, &mesh->triangle[t]);
			volume += turned[t] == 1 ? part : -part;
		}
		uint8_t to_flip = volume < 0.0 ? 1 : 2;
		for (int i = 0; i < count; i++)
			if (turned[queue[i]] == to_flip)
				flip(&mesh->triangle[queue[i]]);
	}
}

/* ---- all of it ---- */

struct workshop {
	struct side *side;
	struct place *place;
	struct numbered *numbered;
	struct across *across;
	uint8_t *turned;
	int *index;
};

static bool workshop_take(struct workshop *shop, const struct mesh *mesh)
{
	size_t triangles = (size_t)mesh->triangle_count, vertices = (size_t)mesh->vertex_count;
	shop->side = malloc(3 * triangles * sizeof *shop->side);
	shop->place = malloc(vertices * sizeof *shop->place);
	shop->numbered = malloc(triangles * sizeof *shop->numbered);
	shop->across = malloc(triangles * sizeof *shop->across);
	shop->turned = malloc(triangles);
	shop->index = malloc((vertices + triangles) * sizeof *shop->index);
	return shop->side && shop->place && shop->numbered && shop->across && shop->turned &&
	       shop->index;
}

static void workshop_free(struct workshop *shop)
{
	free(shop->side);
	free(shop->place);
	free(shop->numbered);
	free(shop->across);
	free(shop->turned);
	free(shop->index);
}

static void mend(struct mesh *mesh, struct workshop *shop, char note[200])
{
	list_sides(mesh, shop->side);
	if (count_edges(shop->side, 3 * mesh->triangle_count).open > 0) {
		int before = mesh->vertex_count;
		weld(mesh, shop->place, shop->index);
		drop_vertices(mesh, shop->index);
		if (mesh->vertex_count < before)
			add_note(note, "vertices at the same place joined");
	}
	if (drop_triangles(mesh, shop->numbered) > 0)
		add_note(note, "doubled or flat triangles left out");
	drop_vertices(mesh, shop->index);
	list_sides(mesh, shop->side);
	bool clashes = count_edges(shop->side, 3 * mesh->triangle_count).clashes > 0;
	if (clashes || inside_out(mesh)) {
		find_across(mesh, shop->side, shop->across);
		orient(mesh, shop->across, shop->turned, shop->index);
		add_note(note, "triangles turned to face outward");
	}
}

const char *mesh_prepare(struct mesh *mesh, char note[200])
{
	note[0] = 0;
	const char *fault = stand(mesh, note);
	if (fault)
		return fault;
	struct workshop shop = {0};
	if (workshop_take(&shop, mesh))
		mend(mesh, &shop, note);
	else
		fault = "not enough memory to examine it; simplify the mesh first";
	workshop_free(&shop);
	return fault ? fault : mesh->triangle_count ? NULL : "it has no triangle with an area";
}
