/* The rows of the table that `make bench-peers` prints and writes. */
#ifndef PEERS_ROWS_H
#define PEERS_ROWS_H

#include "peers.h"

struct body;

enum better { LESS, MORE };

/* A figure of kitsuke with its target; a peer's figure and how many times better ours should be.
 * A target or ratio of NO_TARGET, a peer of NULL: none. */
#define NO_TARGET (-1.0)
struct peers_row {
	char what[64];
	const char *unit;
	enum better better;
	double figure, target;
	const char *peer;
	double peer_figure, ratio_target;
};

void peers_add(const struct peers_row *row);

/* Each adds its rows. */
void peers_drapes(const struct peers_body *body, bool with_peers);
void peers_tracks(const struct peers_body *body, bool with_peers);
void peers_dressing(void);
void peers_drag(void);
void peers_meshing(bool with_peers);

#endif
