/* Shared between the session's own files only. */
#ifndef SESSION_PRIVATE_H
#define SESSION_PRIVATE_H

#include "session.h"

/* Brings the jobs and the pins into step with a document and a cloth that were just restored;
 * a wrap that was under way begins again. */
void session_resume(struct session *session, bool wrapping);

/* Something moved or may move: the cloth is awake. */
void session_wake(struct session *session);

/* Meshes the pattern and wraps it. Returns NULL or why it can't be. */
const char *session_wrap(struct session *session);

/* Ends a drag in progress, as when the pen is lifted. */
void session_release(struct session *session);

/* Every pin holds the triangle under it where it is now. */
void session_hold_pins(struct session *session);

/* What edits of the pattern share: the outline of one as a piece's, whether a place lies within 10
 * m of the sheet's middle and an angle is one. */
extern const char session_no_piece[];
void session_take_outline(struct piece *piece, const struct edit *edit);
bool session_is_place(float x_mm, float y_mm, float turn_rad);

/* The edits of each field; NULL or why the edit is refused (nothing has changed then). */
const char *session_edit_pattern(struct session *session, const struct edit *edit);
const char *session_edit_dress(struct session *session, const struct edit *edit);

#endif
