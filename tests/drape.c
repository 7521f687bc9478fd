/* drape GARMENT.obj BODY.obj [PICTURE.png]: an independent judge of one drape; JSON on stdout. */
#include "drape.h"

#include <stdio.h>

int main(int argc, char **argv)
{
	static struct drape_mesh garment, body;
	struct drape_figures f;
	if (argc < 3 || argc > 4) {
		fputs("usage: drape GARMENT.obj BODY.obj [PICTURE.png]\n", stderr);
		return 2;
	}
	drape_load(&garment, argv[1]);
	drape_load(&body, argv[2]);
	drape_measure(&f, &garment, &body);
	printf("{\"vertices_inside\": %d, \"midpoints_inside\": %d, \"centres_inside\": %d,\n"
	       " \"penetration_mm_max\": %.4f, \"edge_crossings_body\": %d,\n"
	       " \"strain_p95\": %.5f, \"strain_max\": %.5f, \"components\": %d}\n",
	       f.vertices_inside, f.midpoints_inside, f.centres_inside, f.penetration_mm_max,
	       f.edge_crossings, f.strain_p95, f.strain_max, f.components);
	return argc == 4 && !drape_picture(argv[3], &garment, &body) ? 3 : 0;
}
