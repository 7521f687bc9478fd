/* The one who is dressed: the mannequin of this house, or a body from a file. */
#ifndef CHARACTER_H
#define CHARACTER_H

#include "body.h"
#include "store.h"

#define CHARACTER_MANNEQUIN "mannequin"

/* Fills the body and finds its parts; or takes its bones from a file beside it, called like it but
 * for the ending .bones. `name` is CHARACTER_MANNEQUIN or an OBJ file; a name without
 * a slash is looked for in `folder` (NULL: the current one). `note` says what was mended, or that
 * no limbs were found; empty: nothing to say. False: the fault names the file. */
bool character_load(struct body *body, const char *name, const char *folder, char note[FAULT_BYTES],
		    char fault[FAULT_BYTES]);

/* Bones from a file in place of those that were found. False: the fault names file and line. */
bool character_read_bones(struct body *body, const char *path, char fault[FAULT_BYTES]);
bool character_write_bones(const struct body *body, const char *path, char fault[FAULT_BYTES]);

/* The body as an OBJ file. */
bool character_write_obj(const struct body *body, const char *path, char fault[FAULT_BYTES]);

#endif
