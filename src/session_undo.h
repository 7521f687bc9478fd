/* Whole states of the document and the cloth, so that going back is a copy. */
#ifndef SESSION_UNDO_H
#define SESSION_UNDO_H

#include "session_private.h"

struct undo *undo_init(struct arena *arena);

/* Keeps the present before an edit changes it; what could be redone is forgotten. */
void undo_keep(struct session *session);

/* Takes the last undo_keep back: the state is as it was then. */
void undo_cancel(struct session *session);

/* One state back or forward. False: there is none. */
bool undo_back(struct session *session);
bool undo_forward(struct session *session);

#endif
