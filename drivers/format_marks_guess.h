/* Marks for a garment that nobody has marked yet, guessed from what its file says of each piece
 * (`id`, `piece`, `wear`: front, back, sleeve, leg, hood; left and right) and from its seams: a
 * seam high up between front and back is a shoulder, two seams that meet between the legs a crotch.
 */
#ifndef FORMAT_MARKS_GUESS_H
#define FORMAT_MARKS_GUESS_H

#include "pattern.h"

enum { GUESS_BYTES_MAX = 16384 };

/* Writes lines as format_marks_read takes them, the pattern being what format_garment_read made of
 * the same bytes. Returns their length without the final zero; 0: nothing says where any piece is
 * worn. */
int format_marks_guess(char out[GUESS_BYTES_MAX], const struct pattern *pattern, const char *text,
		       size_t size);

#endif
