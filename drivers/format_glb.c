#include "format_glb.h"

#include <jansson.h>
#include <stdlib.h>

/* The numbers of the specification. */
enum {
	GLB_VERSION = 2,
	GLB_HEADER_BYTES = 12,
	GLB_CHUNK_HEADER_BYTES = 8,
	COMPONENT_FLOAT = 5126,
	COMPONENT_UNSIGNED_INT = 5125,
	TARGET_VERTICES = 34962,
	TARGET_INDICES = 34963,
	JSON_REAL_DIGITS = 9, /* reads back to the same float */
};

#define GLB_MAGIC 0x46546c67u  /* "glTF" */
#define CHUNK_JSON 0x4e4f534au /* "JSON" */
#define CHUNK_BIN 0x004e4942u  /* "BIN" */

/* The four runs of the binary chunk, one a buffer view. */
enum view { VIEW_POSITION, VIEW_NORMAL, VIEW_TEXTURE, VIEW_INDEX, VIEW_COUNT };

static const int view_stride[VIEW_COUNT] = {12, 12, 8, 12}; /* an index view's: a triangle */

static size_t view_bytes(const struct mesh *mesh, enum view view)
{
	int count = view == VIEW_INDEX ? mesh->triangle_count : mesh->vertex_count;
	return (size_t)count * (size_t)view_stride[view];
}

/* ---- the JSON chunk ---- */

static json_t *bound(const struct mesh *mesh, const struct mesh_group *group, bool upper)
{
	float value[3];
	memcpy(value, &mesh->position_m[group->vertex_first], sizeof value);
	for (int v = 0; v < group->vertex_count; v++) {
		float at[3];
		memcpy(at, &mesh->position_m[group->vertex_first + v], sizeof at);
		for (int k = 0; k < 3; k++)
			value[k] = upper ? float_max(value[k], at[k]) : float_min(value[k], at[k]);
	}
	return json_pack("[f, f, f]", (double)value[0], (double)value[1], (double)value[2]);
}

static void add_accessor(json_t *accessors, enum view view, int first, int count)
{
	bool index = view == VIEW_INDEX;
	json_array_append_new(accessors,
			      json_pack("{s:i, s:I, s:i, s:i, s:s}", "bufferView", (int)view,
					"byteOffset", (json_int_t)first * view_stride[view],
					"componentType",
					index ? COMPONENT_UNSIGNED_INT : COMPONENT_FLOAT, "count",
					index ? 3 * count : count, "type",
					index                  ? "SCALAR"
					: view == VIEW_TEXTURE ? "VEC2"
							       : "VEC3"));
}

/* A group's four accessors, its material, and the primitive that holds them together. */
static void add_group(const struct mesh *mesh, const struct mesh_group *group, json_t *accessors,
		      json_t *materials, json_t *primitives)
{
	int base = (int)json_array_size(accessors);
	add_accessor(accessors, VIEW_POSITION, group->vertex_first, group->vertex_count);
	add_accessor(accessors, VIEW_NORMAL, group->vertex_first, group->vertex_count);
	add_accessor(accessors, VIEW_TEXTURE, group->vertex_first, group->vertex_count);
	add_accessor(accessors, VIEW_INDEX, group->triangle_first, group->triangle_count);
	json_t *position = json_array_get(accessors, (size_t)base);
	json_object_set_new(position, "min", bound(mesh, group, false));
	json_object_set_new(position, "max", bound(mesh, group, true));
	json_array_append_new(primitives,
			      json_pack("{s:{s:i, s:i, s:i}, s:i, s:i}", "attributes", "POSITION",
					base, "NORMAL", base + 1, "TEXCOORD_0", base + 2, "indices",
					base + 3, "material", (int)json_array_size(materials)));
	json_array_append_new(materials,
			      json_pack("{s:s, s:b, s:{s:[f, f, f, f], s:f, s:f}}", "name",
					group->name, "doubleSided", 1, "pbrMetallicRoughness",
					"baseColorFactor", 0.62, 0.69, 0.73, 1.0, "metallicFactor",
					0.0, "roughnessFactor", 0.9));
}

static json_t *buffer_views(const struct mesh *mesh, size_t *total)
{
	json_t *views = json_array();
	*total = 0;
	for (int view = 0; view < VIEW_COUNT; view++) {
		size_t size = view_bytes(mesh, (enum view)view);
		json_array_append_new(
			views,
			json_pack("{s:i, s:I, s:I, s:i}", "buffer", 0, "byteOffset",
				  (json_int_t)*total, "byteLength", (json_int_t)size, "target",
				  view == VIEW_INDEX ? TARGET_INDICES : TARGET_VERTICES));
		*total += size;
	}
	return views;
}

/* The document as text from malloc; NULL: no memory. */
static char *write_json(const struct mesh *mesh, const char *title, size_t *binary_size)
{
	json_t *accessors = json_array(), *materials = json_array(), *primitives = json_array();
	for (int g = 0; g < mesh->group_count; g++)
		add_group(mesh, &mesh->group[g], accessors, materials, primitives);
	json_t *views = buffer_views(mesh, binary_size);
	json_t *root = json_pack(
		"{s:{s:s, s:s}, s:i, s:[{s:[i]}], s:[{s:i, s:s}], s:[{s:s, s:o}], s:o, s:o, s:o, "
		"s:[{s:I}]}",
		"asset", "version", "2.0", "generator", title, "scene", 0, "scenes", "nodes", 0,
		"nodes", "mesh", 0, "name", "garment", "meshes", "name", "garment", "primitives",
		primitives, "materials", materials, "accessors", accessors, "bufferViews", views,
		"buffers", "byteLength", (json_int_t)*binary_size);
	char *text = root ? json_dumps(root, JSON_COMPACT | JSON_REAL_PRECISION(JSON_REAL_DIGITS))
			  : NULL;
	json_decref(root);
	return text;
}

/* ---- the file ---- */

static uint8_t *put_u32(uint8_t *at, uint32_t value)
{
	for (int i = 0; i < 4; i++)
		*at++ = (uint8_t)(value >> (8 * i));
	return at;
}

static uint8_t *put_floats(uint8_t *at, const void *values, int count)
{
	const uint8_t *from = values;
	for (int i = 0; i < count; i++) {
		uint32_t bits;
		memcpy(&bits, from + 4 * (size_t)i, sizeof bits);
		at = put_u32(at, bits);
	}
	return at;
}

/* Indices count from the group's first vertex, where its accessors begin. */
static uint8_t *put_indices(uint8_t *at, const struct mesh *mesh)
{
	for (int g = 0; g < mesh->group_count; g++) {
		const struct mesh_group *group = &mesh->group[g];
		for (int t = 0; t < 3 * group->triangle_count; t++) {
			const int *v = mesh->triangle[group->triangle_first + t / 3].v;
			at = put_u32(at, (uint32_t)(v[t % 3] - group->vertex_first));
		}
	}
	return at;
}

static size_t round_up_to_4(size_t size)
{
	return (size + 3) & ~(size_t)3;
}

uint8_t *format_glb_write(const struct mesh *mesh, const char *title, size_t *size)
{
	MUST(mesh->group_count > 0 && mesh->normal && mesh->texture_m);
	size_t binary_size;
	char *json = write_json(mesh, title, &binary_size);
	if (!json)
		return NULL;
	size_t json_size = strlen(json), json_padded = round_up_to_4(json_size);
	*size = GLB_HEADER_BYTES + 2 * GLB_CHUNK_HEADER_BYTES + json_padded + binary_size;
	uint8_t *file = malloc(*size), *at = file;
	if (file) {
		at = put_u32(at, GLB_MAGIC);
		at = put_u32(at, GLB_VERSION);
		at = put_u32(at, (uint32_t)*size);
		at = put_u32(at, (uint32_t)json_padded);
		at = put_u32(at, CHUNK_JSON);
		memset(at, ' ', json_padded);
		memcpy(at, json, json_size);
		at = put_u32(at + json_padded, (uint32_t)binary_size);
		at = put_u32(at, CHUNK_BIN);
		at = put_floats(at, mesh->position_m, 3 * mesh->vertex_count);
		at = put_floats(at, mesh->normal, 3 * mesh->vertex_count);
		at = put_floats(at, mesh->texture_m, 2 * mesh->vertex_count);
		at = put_indices(at, mesh);
		MUST((size_t)(at - file) == *size);
	}
	free(json);
	return file;
}
