/* The GLB that we write, taken apart again by the rules of the specification. */
#include "format_glb.h"
#include "test.h"

#include <jansson.h>

static uint32_t u32(const uint8_t *at)
{
	return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

static float f32(const uint8_t *at)
{
	uint32_t bits = u32(at);
	float value;
	memcpy(&value, &bits, sizeof value);
	return value;
}

static void make_mesh(struct mesh *mesh)
{
	CHECK(mesh_take(mesh, 7, 3, true));
	for (int v = 0; v < 7; v++) {
		mesh->position_m[v] = (struct v3){0.1f * (float)v, 1.0f - 0.3f * (float)(v % 3),
						  0.01f};
		mesh->normal[v] = (struct v3){0.6f, 0.0f, 0.8f};
		mesh->texture_m[v] = (struct v2){0.1f * (float)v, -0.2f};
	}
	mesh->triangle[0] = (struct triangle){{0, 1, 2}};
	mesh->triangle[1] = (struct triangle){{3, 5, 4}};
	mesh->triangle[2] = (struct triangle){{4, 5, 6}};
	mesh->group_count = 2;
	mesh->group[0] = (struct mesh_group){"front", 0, 3, 0, 1};
	mesh->group[1] = (struct mesh_group){"back", 3, 4, 1, 2};
}

static json_int_t integer(json_t *object, const char *key)
{
	json_t *value = json_object_get(object, key);
	CHECK(json_is_integer(value));
	return json_integer_value(value);
}

/* The bytes an accessor begins at; checks that it is aligned and lies within its view. */
static const uint8_t *accessor_data(json_t *root, json_int_t index, int element_bytes,
				    json_int_t *count, const uint8_t *binary)
{
	json_t *accessor = json_array_get(json_object_get(root, "accessors"), (size_t)index);
	json_t *view = json_array_get(json_object_get(root, "bufferViews"),
				      (size_t)integer(accessor, "bufferView"));
	json_int_t offset = integer(accessor, "byteOffset");
	*count = integer(accessor, "count");
	CHECK(offset % 4 == 0 && integer(view, "byteOffset") % 4 == 0);
	CHECK(offset + *count * element_bytes <= integer(view, "byteLength"));
	return binary + integer(view, "byteOffset") + offset;
}

static void check_bounds(json_t *root, json_int_t index, const uint8_t *data, json_int_t count)
{
	json_t *accessor = json_array_get(json_object_get(root, "accessors"), (size_t)index);
	for (int k = 0; k < 3; k++) {
		float low = f32(data + 4 * k), high = low;
		for (json_int_t v = 0; v < count; v++) {
			low = float_min(low, f32(data + 12 * v + 4 * k));
			high = float_max(high, f32(data + 12 * v + 4 * k));
		}
		json_t *min = json_array_get(json_object_get(accessor, "min"), (size_t)k);
		json_t *max = json_array_get(json_object_get(accessor, "max"), (size_t)k);
		CHECK(low == (float)json_number_value(min));
		CHECK(high == (float)json_number_value(max));
	}
}

static void check_primitive(json_t *root, const struct mesh *mesh, int g, const uint8_t *binary)
{
	const struct mesh_group *group = &mesh->group[g];
	json_t *first = json_array_get(json_object_get(root, "meshes"), 0);
	json_t *primitive = json_array_get(json_object_get(first, "primitives"), (size_t)g);
	json_t *attributes = json_object_get(primitive, "attributes");
	json_t *material = json_array_get(json_object_get(root, "materials"),
					  (size_t)integer(primitive, "material"));
	const char *name = json_string_value(json_object_get(material, "name"));
	CHECK(name && strcmp(name, group->name) == 0);
	json_int_t count, position = integer(attributes, "POSITION");
	const uint8_t *data = accessor_data(root, position, 12, &count, binary);
	CHECK(count == group->vertex_count);
	check_bounds(root, position, data, count);
	for (int v = 0; v < group->vertex_count; v++)
		CHECK(f32(data + 12 * v) == mesh->position_m[group->vertex_first + v].x);
	data = accessor_data(root, integer(attributes, "NORMAL"), 12, &count, binary);
	CHECK(count == group->vertex_count && f32(data) == 0.6f && f32(data + 8) == 0.8f);
	data = accessor_data(root, integer(attributes, "TEXCOORD_0"), 8, &count, binary);
	CHECK(count == group->vertex_count);
	CHECK(f32(data) == mesh->texture_m[group->vertex_first].x && f32(data + 4) == -0.2f);
	data = accessor_data(root, integer(primitive, "indices"), 4, &count, binary);
	CHECK(count == 3 * group->triangle_count);
	for (json_int_t i = 0; i < count; i++)
		CHECK((int)u32(data + 4 * i) + group->vertex_first ==
		      mesh->triangle[group->triangle_first + i / 3].v[i % 3]);
}

int main(void)
{
	struct mesh mesh;
	size_t size = 0;
	make_mesh(&mesh);
	uint8_t *file = format_glb_write(&mesh, "a test", &size);
	CHECK(file && size > 28);
	CHECK(memcmp(file, "glTF", 4) == 0 && u32(file + 4) == 2 && u32(file + 8) == size);
	uint32_t json_size = u32(file + 12);
	CHECK(json_size % 4 == 0 && memcmp(file + 16, "JSON", 4) == 0);
	const uint8_t *chunk = file + 20 + json_size;
	CHECK(memcmp(chunk + 4, "BIN", 4) == 0);
	CHECK(20 + json_size + 8 + u32(chunk) == size);
	json_error_t error;
	json_t *root = json_loadb((const char *)file + 20, json_size, 0, &error);
	CHECK(root);
	json_t *buffer = json_array_get(json_object_get(root, "buffers"), 0);
	CHECK(integer(buffer, "byteLength") == u32(chunk));
	for (int g = 0; g < mesh.group_count; g++)
		check_primitive(root, &mesh, g, chunk + 8);
	json_decref(root);
	free(file);
	mesh_free(&mesh);
	return test_end();
}
