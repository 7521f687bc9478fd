/* kitsuke beside its peers, on the same body and garment, in one run of one thread:
 *
 *   peers [--alone] [JSON]      --alone: without the peers, for a quick look at our own figures
 *
 * Times are thread CPU time; on a machine that does other things too, ratios count. A target is
 * met or it is not: this program measures, and no figure makes it fail. */
#include "peers_rows.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { ROWS_MAX = 64 };

static struct peers_row rows[ROWS_MAX];
static int row_count;

double peers_ms(void)
{
	struct timespec now;
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
	return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

void peers_add(const struct peers_row *row)
{
	MUST(row_count < ROWS_MAX);
	rows[row_count++] = *row;
	fprintf(stderr, "%s: %.3g %s\n", row->what, row->figure, row->unit);
}

/* How many times better than the peer. */
static double ratio(const struct peers_row *row)
{
	return row->better == LESS ? row->peer_figure / row->figure
				   : row->figure / row->peer_figure;
}

static bool met(const struct peers_row *row)
{
	bool reached = row->target == NO_TARGET ||
		       (row->better == LESS ? row->figure <= row->target
					    : row->figure >= row->target);
	return reached &&
	       (!row->peer || row->ratio_target == NO_TARGET || ratio(row) >= row->ratio_target);
}

static bool has_target(const struct peers_row *row)
{
	return row->target != NO_TARGET || (row->peer && row->ratio_target != NO_TARGET);
}

static void print_rows(void)
{
	printf("%-46s %9s %-6s %9s  %-14s %9s %7s %7s\n", "", "kitsuke", "", "target", "peer",
	       "figure", "times", "target");
	for (int i = 0; i < row_count; i++) {
		const struct peers_row *row = &rows[i];
		char target[16] = "", times[16] = "", wanted[16] = "", peer[16] = "";
		if (row->target != NO_TARGET)
			snprintf(target, sizeof target, "%.4g", row->target);
		if (row->peer) {
			snprintf(peer, sizeof peer, "%.2f", row->peer_figure);
			snprintf(times, sizeof times, "%.1f", ratio(row));
		}
		if (row->peer && row->ratio_target != NO_TARGET)
			snprintf(wanted, sizeof wanted, "%.4g", row->ratio_target);
		printf("%-46s %9.2f %-6s %9s  %-14s %9s %7s %7s  %s\n", row->what, row->figure,
		       row->unit, target, row->peer ? row->peer : "", peer, times, wanted,
		       !has_target(row) ? ""
		       : met(row)       ? "met"
					: "MISSED");
	}
}

static void json_number(FILE *file, const char *name, double value, bool known)
{
	fprintf(file, ", \"%s\": ", name);
	if (known)
		fprintf(file, "%.6g", value);
	else
		fputs("null", file);
}

static bool write_json(const char *path)
{
	FILE *file = fopen(path, "w");
	if (!file)
		return false;
	fputs("[\n", file);
	for (int i = 0; i < row_count; i++) {
		const struct peers_row *row = &rows[i];
		fprintf(file, "  {\"what\": \"%s\", \"unit\": \"%s\", \"better\": \"%s\"",
			row->what, row->unit, row->better == LESS ? "less" : "more");
		json_number(file, "figure", row->figure, true);
		json_number(file, "target", row->target, row->target != NO_TARGET);
		fprintf(file, ", \"peer\": \"%s\"", row->peer ? row->peer : "");
		json_number(file, "peer_figure", row->peer_figure, row->peer);
		json_number(file, "ratio", row->peer ? ratio(row) : 0.0, row->peer);
		json_number(file, "ratio_target", row->ratio_target,
			    row->peer && row->ratio_target != NO_TARGET);
		fprintf(file, ", \"met\": %s}%s\n",
			!has_target(row) ? "null"
			: met(row)       ? "true"
					 : "false",
			i + 1 < row_count ? "," : "");
	}
	fputs("]\n", file);
	return fclose(file) == 0;
}

int main(int argc, char **argv)
{
	const char *json = NULL;
	bool with_peers = true;
	for (int i = 1; i < argc; i++) {
		if (strcmp(argv[i], "--alone") == 0)
			with_peers = false;
		else
			json = argv[i];
	}
	struct peers_body body;
	peers_make_body(&body);
	peers_drapes(&body, with_peers);
	peers_tracks(&body, with_peers);
	peers_dressing();
	peers_drag();
	peers_meshing(with_peers);
	printf("body of %d triangles; a drape of %d frames; thread CPU time\n", body.triangle_count,
	       DRAPE_FRAMES);
	print_rows();
	free(body.position_m);
	free(body.triangle);
	if (json && !write_json(json)) {
		fprintf(stderr, "peers: %s cannot be written\n", json);
		return EXIT_FAILURE;
	}
	return EXIT_SUCCESS;
}
