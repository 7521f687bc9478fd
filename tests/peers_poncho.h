#ifndef PEERS_PONCHO_H
#define PEERS_PONCHO_H

#include "peers.h"
#include "session.h"

/* Meshes the poncho with about so many vertices and lays it over the session's body, worn. */
void poncho_lay(struct session *session, int vertices);

/* The session's cloth as one welded mesh, as peers take it; to be given to poncho_free. */
void poncho_take(const struct session *session, struct peers_cloth *poncho);
void poncho_free(struct peers_cloth *poncho);

/* A drape of kitsuke's own frames; drape->ms is set. */
void poncho_fall(struct session *session, struct drape *drape);

#endif
