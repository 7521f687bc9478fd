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
	if (scan->mesh)
		scan->mesh->position_m[scan->vertex_count] = (struct v3){value[0], value[1],
									 value[2]};
	scan->vertex_count++;
	return true;
}

/* The vertex of a corner "v", "v/vt", "v//vn" or "v/vt/vn" as an index from 0. Negative ones count
 * back from the last vertex so far. */
static bool read_corner(struct scan *scan, int *vertex)
{
	bool negative = scan->at < scan->end && *scan->at == '-';
	scan->at += negative;
	const char *digits = scan->at;
	long value = 0;
	for (; scan->at < scan->end && *scan->at >= '0' && *scan->at <= '9'; scan->at++)
		value = value > MESH_VERTICES_MAX ? value : value * 10 + (*scan->at - '0');
	if (scan->at == digits)
		return fail(scan, "a face needs whole numbers: v, v/vt, v//vn or v/vt/vn");
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
	*vertex = (int)value;
	return true;
}

/* A polygon as a fan about its first corner. A triangle that names a vertex twice has no area and
 * is left out. */
static bool read_face(struct scan *scan)
{
	int first = 0, previous = 0, vertex, corner = 0;
	for (; !at_end_of_statement(scan); corner++) {
		if (!read_corner(scan, &vertex))
			return false;
		if (corner == 0)
			first = vertex;
		bool flat = first == previous || previous == vertex || vertex == first;
		if (corner >= 2 && !flat) {
			if (scan->triangle_count == MESH_TRIANGLES_MAX)
				return fail(scan, "more than 8 million triangles; simplify the "
						  "mesh first");
			if (scan->mesh)
				scan->mesh->triangle[scan->triangle_count] = (struct triangle){
					{first, previous, vertex}};
			scan->triangle_count++;
		}
		previous = vertex;
	}
	return corner >= 3 ? true : fail(scan, "a face needs at least three corners");
}

/* Is the statement's keyword this letter? Steps over it. */
static bool keyword(struct scan *scan, char letter)
{
	if (scan->end - scan->at < 2 || scan->at[0] != letter)
		return false;
	char next = scan->at[1];
	if (next != ' ' && next != '\t' && next != '\\')
		return false;
	scan->at++;
	return true;
}

static bool read_pass(struct scan *scan)
{
	scan->vertex_count = scan->triangle_count = 0;
	scan->line = scan->line_next = 1;
	while (scan->at < scan->end) {
		pass_blanks(scan);
		if (keyword(scan, 'v') ? !read_vertex(scan)
				       : keyword(scan, 'f') && !read_face(scan))
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

bool format_obj_read(struct mesh *mesh, const char *text, size_t size, char fault[200])
{
	memset(mesh, 0, sizeof *mesh);
	const char *wrong = encoding_fault(text, size);
	if (wrong) {
		snprintf(fault, 200, "%s", wrong);
		return false;
	}
	const char *begin = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? text + 3 : text;
	struct scan scan = {.at = begin, .end = text + size, .fault = fault};
	if (!read_pass(&scan))
		return false;
	if (scan.vertex_count == 0 || scan.triangle_count == 0) {
		snprintf(fault, 200, "line %d: the file ends with %d vertices and %d triangles; %s",
			 scan.line, scan.vertex_count, scan.triangle_count,
			 "an OBJ body needs both, as lines that begin with v and f");
		return false;
	}
	if (!mesh_take(mesh, scan.vertex_count, scan.triangle_count, false)) {
		snprintf(fault, 200, "not enough memory for %d vertices; simplify the mesh first",
			 scan.vertex_count);
		return false;
	}
	scan.at = begin;
	scan.mesh = mesh;
	scan.vertex_total = scan.vertex_count;
	if (!read_pass(&scan)) {
		mesh_free(mesh);
		return false;
	}
	return true;
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
