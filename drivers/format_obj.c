#include "format_obj.h"

#include "journal.h"

#include <stdio.h>
#include <stdlib.h>

/* ---- reading ----
 * Two passes over the text: the first counts vertices and triangles, the second fills arrays of
 * just that size. Between two line ends there may be several physical lines, joined by '\'. */

struct scan {
	const char *at, *end; /* of the text */
	int line;             /* where the current statement begins, from 1 */
	int line_next;
	struct mesh *mesh; /* NULL in the counting pass */
	int vertex_total;  /* of the whole file; known in the second pass */
	int vertex_count, triangle_count;
	bool textured;    /* every corner becomes a vertex of its own, with its texture point */
	struct v3 *place; /* the file's vertices and texture points then */
	struct v2 *texture;
	int texture_total, texture_count;
	char *fault;
};

static bool fail(struct scan *scan, const char *what)
{
	snprintf(scan->fault, 200, "line %d: %s", scan->line, what);
	return false;
}

static bool is_line_end(char c)
{
	return c == '\n' || c == '\r';
}

/* One physical line end: LF, CR LF or CR. */
static void pass_line_end(struct scan *scan)
{
	char c = *scan->at++;
	if (c == '\r' && scan->at < scan->end && *scan->at == '\n')
		scan->at++;
	scan->line_next++;
}

/* Blanks within a statement; a backslash before a line end is one of them. */
static void pass_blanks(struct scan *scan)
{
	while (scan->at < scan->end) {
		char c = *scan->at;
		if (c == ' ' || c == '\t') {
			scan->at++;
		} else if (c == '\\' && scan->at + 1 < scan->end && is_line_end(scan->at[1])) {
			scan->at++;
			pass_line_end(scan);
		} else {
			break;
		}
	}
}

static bool is_one_of(char c, const char *set)
{
	return c && strchr(set, c);
}

static bool at_separator(const struct scan *scan)
{
	return scan->at == scan->end || is_one_of(*scan->at, " \t\r\n\\#");
}

static bool at_end_of_statement(struct scan *scan)
{
	pass_blanks(scan);
	return scan->at == scan->end || is_line_end(*scan->at) || *scan->at == '#';
}

/* The rest of the statement; a comment ends with its line, backslash or not. */
static void pass_statement(struct scan *scan)
{
	bool comment = false;
	while (scan->at < scan->end && !is_line_end(*scan->at)) {
		comment = comment || *scan->at == '#';
		scan->at++;
		if (!comment)
			pass_blanks(scan);
	}
	if (scan->at < scan->end)
		pass_line_end(scan);
	scan->line = scan->line_next;
}

/* "v x y z"; a fourth number (weight) or colours may follow and mean nothing here. */
static bool read_vertex(struct scan *scan)
{
	float value[3];
	if (scan->vertex_count == MESH_VERTICES_MAX)
		return fail(scan, "more than 4 million vertices; simplify the mesh first");
	for (int i = 0; i < 3; i++) {
		pass_blanks(scan);
		if (!number_read(&scan->at, scan->end, &value[i]) || !at_separator(scan))
			return fail(scan, "a vertex needs three finite numbers with blanks between "
					  "and decimal points, not commas");
	}
	struct v3 *place = scan->textured ? scan->place
			   : scan->mesh   ? scan->mesh->position_m
					  : NULL;
	if (scan->mesh)
		place[scan->vertex_count] = (struct v3){value[0], value[1], value[2]};
	scan->vertex_count++;
	return true;
}

/* "vt u v", perhaps with a third number. */
static bool read_texture(struct scan *scan)
{
	float value[2];
	if (scan->texture_count == MESH_VERTICES_MAX)
		return fail(scan, "more than 4 million texture points; simplify the mesh first");
	for (int i = 0; i < 2; i++) {
		pass_blanks(scan);
		if (!number_read(&scan->at, scan->end, &value[i]) || !at_separator(scan))
			return fail(scan, "a texture point needs two finite numbers with blanks "
					  "between and decimal points, not commas");
	}
	if (scan->mesh)
		scan->texture[scan->texture_count] = (struct v2){value[0], value[1]};
	scan->texture_count++;
	return true;
}

/* "g name": a new group, unless the one before has no triangle. */
static bool read_group(struct scan *scan)
{
	struct mesh *mesh = scan->mesh;
	char name[NAME_BYTES_MAX] = "";
	int length = 0;
	pass_blanks(scan);
	for (; !at_separator(scan); scan->at++)
		if (length < NAME_BYTES_MAX - 1)
			name[length++] = *scan->at;
	if (!mesh)
		return true;
	if (mesh->group_count > 0 &&
	    mesh->group[mesh->group_count - 1].triangle_first == scan->triangle_count)
		mesh->group_count--;
	if (mesh->group_count == PIECES_MAX)
		return fail(scan, "more groups than a pattern may have pieces");
	struct mesh_group *group = &mesh->group[mesh->group_count++];
	memcpy(group->name, name, sizeof name);
	group->triangle_first = scan->triangle_count;
	return true;
}

/* The texture point of a corner, whose text goes on at `at`. */
static bool read_corner_texture(struct scan *scan, const char *at, int *texture)
{
	bool negative = at + 1 < scan->end && at[0] == '/' && at[1] == '-';
	long value = 0;
	for (at += 1 + negative; at < scan->end && *at >= '0' && *at <= '9'; at++)
		value = value > MESH_VERTICES_MAX ? value : value * 10 + (*at - '0');
	value = negative ? scan->texture_count - value : value - 1;
	if (value < 0 || (scan->mesh && value >= scan->texture_total))
		return fail(scan, "a corner has no texture point; export the garment with its "
				  "pattern as texture coordinates (v/vt)");
	*texture = (int)value;
	return true;
}

struct corner {
	int vertex, texture;
};

/* The vertex of a corner "v", "v/vt", "v//vn" or "v/vt/vn" as an index from 0. Negative ones count
 * back from the last vertex so far. */
static bool read_corner(struct scan *scan, struct corner *corner)
{
	bool negative = scan->at < scan->end && *scan->at == '-';
	scan->at += negative;
	const char *digits = scan->at;
	long value = 0;
	for (; scan->at < scan->end && *scan->at >= '0' && *scan->at <= '9'; scan->at++)
		value = value > MESH_VERTICES_MAX ? value : value * 10 + (*scan->at - '0');
	if (scan->at == digits)
		return fail(scan, "a face needs whole numbers: v, v/vt, v//vn or v/vt/vn");
	const char *rest = scan->at;
	while (scan->at < scan->end && is_one_of(*scan->at, "/-0123456789"))
		scan->at++;
	if (!at_separator(scan))
		return fail(scan, "a face needs whole numbers: v, v/vt, v//vn or v/vt/vn");
	if (value == 0)
		return fail(scan, "a face names vertex 0, but they are counted from 1");
	value = negative ? scan->vertex_count - value : value - 1;
	if (scan->mesh && (value < 0 || value >= scan->vertex_total))
		return fail(scan, "a face names a vertex that the file does not have; export it "
				  "again, this one is damaged");
	corner->vertex = (int)value;
	corner->texture = 0;
	return !scan->textured || read_corner_texture(scan, rest, &corner->texture);
}

static void put_triangle(struct scan *scan, const struct corner corner[3])
{
	struct triangle *triangle = &scan->mesh->triangle[scan->triangle_count];
	for (int k = 0; k < 3; k++) {
		int at = 3 * scan->triangle_count + k;
		triangle->v[k] = scan->textured ? at : corner[k].vertex;
		if (!scan->textured)
			continue;
		scan->mesh->position_m[at] = scan->place[corner[k].vertex];
		scan->mesh->texture_m[at] = scan->texture[corner[k].texture];
	}
}

/* A polygon as a fan about its first corner. A triangle that names a vertex twice has no area and
 * is left out. */
static bool read_face(struct scan *scan)
{
	struct corner fan[3] = {{0, 0}, {0, 0}, {0, 0}}; /* first, previous, this one */
	int corner = 0;
	for (; !at_end_of_statement(scan); corner++) {
		if (!read_corner(scan, &fan[2]))
			return false;
		if (corner == 0)
			fan[0] = fan[2];
		bool flat = fan[0].vertex == fan[1].vertex || fan[1].vertex == fan[2].vertex ||
			    fan[2].vertex == fan[0].vertex;
		if (corner >= 2 && !flat) {
			if (scan->triangle_count == MESH_TRIANGLES_MAX)
				return fail(scan, "more than 8 million triangles; simplify the "
						  "mesh first");
			if (scan->mesh)
				put_triangle(scan, fan);
			scan->triangle_count++;
		}
		fan[1] = fan[2];
	}
	return corner >= 3 ? true : fail(scan, "a face needs at least three corners");
}

/* Is this the statement's keyword? Steps over it. */
static bool keyword(struct scan *scan, const char *word)
{
	size_t length = strlen(word);
	if ((size_t)(scan->end - scan->at) <= length || memcmp(scan->at, word, length) != 0)
		return false;
	char next = scan->at[length];
	if (next != ' ' && next != '\t' && next != '\\')
		return false;
	scan->at += length;
	return true;
}

static bool read_statement(struct scan *scan)
{
	if (keyword(scan, "v"))
		return read_vertex(scan);
	if (keyword(scan, "f"))
		return read_face(scan);
	if (scan->textured && keyword(scan, "vt"))
		return read_texture(scan);
	if (scan->textured && (keyword(scan, "g") || keyword(scan, "o")))
		return read_group(scan);
	return true;
}

static bool read_pass(struct scan *scan)
{
	scan->vertex_count = scan->triangle_count = scan->texture_count = 0;
	scan->line = scan->line_next = 1;
	while (scan->at < scan->end) {
		pass_blanks(scan);
		if (!read_statement(scan))
			return false;
		pass_statement(scan);
	}
	return true;
}

/* What is certainly no OBJ, told by its first bytes. */
static const char *encoding_fault(const char *text, size_t size)
{
	if (size == 0)
		return "the file is empty";
	if (size >= 2 && (memcmp(text, "\xff\xfe", 2) == 0 || memcmp(text, "\xfe\xff", 2) == 0))
		return "line 1: this is UTF-16 text; save it as UTF-8 or plain ASCII";
	if (size >= 4 && memcmp(text, "glTF", 4) == 0)
		return "line 1: this is a GLB, not an OBJ; name it .glb";
	return NULL;
}

static bool take_memory(struct scan *scan, struct mesh *mesh)
{
	int vertices = scan->vertex_count;
	if (scan->textured) {
		vertices = 3 * scan->triangle_count;
		scan->place = calloc((size_t)scan->vertex_count, sizeof *scan->place);
		scan->texture = calloc((size_t)scan->texture_count + 1, sizeof *scan->texture);
	}
	return (!scan->textured ||
		(scan->place && scan->texture && vertices <= MESH_VERTICES_MAX)) &&
	       mesh_take(mesh, vertices, scan->triangle_count, scan->textured);
}

/* The triangles of a group go on to where the next one begins. */
static void close_groups(struct mesh *mesh)
{
	for (int g = 0; g < mesh->group_count; g++) {
		int end = g + 1 < mesh->group_count ? mesh->group[g + 1].triangle_first
						    : mesh->triangle_count;
		mesh->group[g].triangle_count = end - mesh->group[g].triangle_first;
	}
}

static bool read_obj(struct mesh *mesh, const char *text, size_t size, bool textured,
		     char fault[200])
{
	memset(mesh, 0, sizeof *mesh);
	const char *wrong = encoding_fault(text, size);
	if (wrong) {
		snprintf(fault, 200, "%s", wrong);
		return false;
	}
	const char *begin = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? text + 3 : text;
	struct scan scan = {.at = begin, .end = text + size, .fault = fault, .textured = textured};
	if (!read_pass(&scan))
		return false;
	if (scan.vertex_count == 0 || scan.triangle_count == 0) {
		snprintf(fault, 200, "line %d: the file ends with %d vertices and %d triangles; %s",
			 scan.line, scan.vertex_count, scan.triangle_count,
			 "an OBJ body needs both, as lines that begin with v and f");
		return false;
	}
	bool taken = take_memory(&scan, mesh);
	if (!taken)
		snprintf(fault, 200, "not enough memory for %d vertices; simplify the mesh first",
			 scan.vertex_count);
	scan.at = begin;
	scan.mesh = mesh;
	scan.vertex_total = scan.vertex_count;
	scan.texture_total = scan.texture_count;
	bool read = taken && read_pass(&scan);
	if (read)
		close_groups(mesh);
	else
		mesh_free(mesh);
	free(scan.place);
	free(scan.texture);
	return read;
}

bool format_obj_read(struct mesh *mesh, const char *text, size_t size, char fault[200])
{
	return read_obj(mesh, text, size, false, fault);
}

bool format_obj_read_garment(struct mesh *mesh, const char *text, size_t size, char fault[200])
{
	return read_obj(mesh, text, size, true, fault);
}

/* ---- writing ---- */

static void put_numbers(FILE *out, const char *word, const float *value, int count)
{
	char text[32];
	fputs(word, out);
	for (int i = 0; i < count; i++) {
		number_write(text, value[i]);
		fprintf(out, " %s", text);
	}
	fputc('\n', out);
}

static void put_vertices(FILE *out, const struct mesh *mesh, const struct mesh_group *group)
{
	int end = group->vertex_first + group->vertex_count;
	for (int v = group->vertex_first; v < end; v++)
		put_numbers(out, "v", &mesh->position_m[v].x, 3);
	for (int v = group->vertex_first; mesh->texture_m && v < end; v++)
		put_numbers(out, "vt", &mesh->texture_m[v].x, 2);
	for (int v = group->vertex_first; mesh->normal && v < end; v++)
		put_numbers(out, "vn", &mesh->normal[v].x, 3);
}

static void put_faces(FILE *out, const struct mesh *mesh, const struct mesh_group *group)
{
	for (int t = 0; t < group->triangle_count; t++) {
		const int *v = mesh->triangle[group->triangle_first + t].v;
		fputc('f', out);
		for (int k = 0; k < 3; k++)
			if (mesh->texture_m && mesh->normal)
				fprintf(out, " %d/%d/%d", v[k] + 1, v[k] + 1, v[k] + 1);
			else
				fprintf(out, " %d", v[k] + 1);
		fputc('\n', out);
	}
}

char *format_obj_write(const struct mesh *mesh, const char *title, size_t *size)
{
	char *text = NULL;
	FILE *out = open_memstream(&text, size);
	if (!out)
		return NULL;
	fprintf(out, "# %s\n# metres, +Y up, facing +Z", title);
	fputs(mesh->texture_m ? "; vt: pattern coordinates in metres\n" : "\n", out);
	struct mesh_group whole = {"", 0, mesh->vertex_count, 0, mesh->triangle_count};
	const struct mesh_group *group = mesh->group_count ? mesh->group : &whole;
	for (int g = 0; g < int_max(mesh->group_count, 1); g++) {
		if (mesh->group_count)
			fprintf(out, "g %s\n", group[g].name);
		put_vertices(out, mesh, &group[g]);
		put_faces(out, mesh, &group[g]);
	}
	if (fclose(out) != 0) {
		free(text);
		return NULL;
	}
	return text;
}
