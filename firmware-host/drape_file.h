/* A drape from another program as the start of a wrap. */
#ifndef DRAPE_FILE_H
#define DRAPE_FILE_H

#include "session.h"
#include "store.h"

/* Reads an OBJ in which the session's meshed garment has been draped: a group per piece, named as
 * in the OBJ that garment_write makes, and texture coordinates = pattern coordinates in metres; its
 * mesh may be another one. Puts a place into position_m for every vertex of session->garment, as
 * the file has it, however tangled. False: the fault names file and place. */
bool drape_read(const struct session *session, const char *path, struct v3 *position_m,
		char fault[FAULT_BYTES]);

#endif
