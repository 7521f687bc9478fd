/* What a device of a tape, or a live one, is to the pen module. */
#ifndef TAPE_LEARN_H
#define TAPE_LEARN_H

#include "pen.h"
#include "tape.h"

/* Describes the device to the pen: descriptor, its maker's protocol, size. Where the tape does not
 * say which protocol it speaks (other programs' tapes do not), it is what the model is known for.
 */
void tape_learn(struct pen *pen, int device, const struct tape_device *told);

/* The protocol by model alone; PEN_BY_DESCRIPTOR when that does not tell. */
struct pen_vendor tape_speaks(const struct tape_device *told, float *width_mm, float *height_mm);

/* For dumps that have neither descriptors nor ids: the protocol that most reports of the device
 * have the form of, with what was seen as its ranges. PEN_BY_DESCRIPTOR: none. */
struct pen_vendor tape_guess(const struct tape *tape, int device);

#endif
