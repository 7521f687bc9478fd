#include "drape_file.h"

#include "format_obj.h"
#include "garment_file.h"

#include <stdio.h>
#include <stdlib.h>

/* The weights of a flat point in a triangle of the file's pattern; false: it has no area. */
static bool flat_weights(const struct mesh *mesh, int t, struct v2 p, float weight[3])
{
	const int *v = mesh->triangle[t].v;
	struct v2 a = mesh->texture_m[v[0]];
	struct v2 u = v2_sub(mesh->texture_m[v[1]], a), w = v2_sub(mesh->texture_m[v[2]], a);
	struct v2 d = v2_sub(p, a);
	float area = v2_cross(u, w);
	if (float_abs(area) < 1e-12f)
		return false;
	weight[1] = v2_cross(d, w) / area;
	weight[2] = v2_cross(u, d) / area;
	weight[0] = 1.0f - weight[1] - weight[2];
	return true;
}

static float least_of(const float weight[3])
{
	return float_min(weight[0], float_min(weight[1], weight[2]));
}

/* Where the file's cloth has the point p of a piece: in the triangle that holds it, or that it is
 * least beyond. False: none is near. */
static bool find_place(const struct mesh *mesh, const char *piece_name, struct v2 p,
		       struct v3 *place_m)
{
	static const float beyond = -1.0f; /* a triangle's own size */
	float best = beyond, weight[3];
	for (int g = 0; g < mesh->group_count; g++) {
		const struct mesh_group *group = &mesh->group[g];
		if (strcmp(group->name, piece_name) != 0)
			continue;
		for (int i = 0; i < group->triangle_count && best < 0.0f; i++) {
			int t = group->triangle_first + i;
			const int *v = mesh->triangle[t].v;
			if (!flat_weights(mesh, t, p, weight) || least_of(weight) <= best)
				continue;
			best = least_of(weight);
			*place_m = (struct v3){0.0f, 0.0f, 0.0f};
			for (int k = 0; k < 3; k++)
				*place_m = v3_mad(*place_m, mesh->position_m[v[k]], weight[k]);
		}
	}
	return best > beyond;
}

static bool find_places(const struct session *session, const struct mesh *mesh, const char *path,
			struct v3 *position_m, char fault[FAULT_BYTES])
{
	struct mesh pieces = {0};
	garment_groups(&pieces, session);
	for (int g = 0; g < pieces.group_count; g++) {
		const struct mesh_group *group = &pieces.group[g];
		for (int i = 0; i < group->vertex_count; i++) {
			int v = group->vertex_first + i;
			if (find_place(mesh, group->name, session->garment.rest_m[v],
				       &position_m[v]))
				continue;
			struct v2 p = session->garment.rest_m[v];
			snprintf(fault, FAULT_BYTES,
				 "%.200s: group \"%s\" has no cloth at texture point %.3f %.3f; "
				 "%s",
				 path, group->name, (double)p.x, (double)p.y,
				 "it needs a group per piece and texture coordinates = pattern "
				 "coordinates in metres");
			return false;
		}
	}
	return true;
}

bool drape_read(const struct session *session, const char *path, struct v3 *position_m,
		char fault[FAULT_BYTES])
{
	size_t size;
	struct mesh mesh;
	char wrong[200];
	char *text = store_read(path, &size, fault);
	if (!text)
		return false;
	bool read = format_obj_read_garment(&mesh, text, size, wrong);
	free(text);
	if (!read) {
		snprintf(fault, FAULT_BYTES, "%.250s: %s", path, wrong);
		return false;
	}
	bool found = find_places(session, &mesh, path, position_m, fault);
	mesh_free(&mesh);
	return found;
}
