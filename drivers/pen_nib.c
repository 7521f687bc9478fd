/* Pressure of a nib that has worn down: it never lets go of its switch any more, and shows pressure
 * in the air. What it shows there counts as none.
 *
 * A pen that comes into range three times in a row with pressure, and never shows less in between,
 * is worn; a healthy one shows none sooner or later while it hovers, however fast it comes down.
 * More than half of the range is no wear but a fault, and stays as it is. Less than before is taken
 * at once: a new nib needs no telling. (libinput's rule, without the distance that few tablets
 * report.) */
#include "pen_filter.h"

enum { NIB_APPROACHES = 3 };

int pen_nib(struct pen_device *device, const struct pen_layout *layout,
	    const struct pen_fields *fields, bool entering, int *range)
{
	struct pen_nib *nib = &device->nib[fields->invert || fields->eraser];
	int64_t most = (int64_t)layout->pressure.maximum - layout->pressure.minimum;
	int64_t above = (int64_t)fields->pressure - layout->pressure.minimum;
	int pressed = above < 0 ? 0 : above > INT32_MAX ? INT32_MAX : (int)above;
	*range = most > INT32_MAX ? INT32_MAX : (int)most;
	if (entering) {
		nib->least = nib->approaches ? int_min(nib->least, pressed) : pressed;
		nib->approaches = int_min(nib->approaches + 1, NIB_APPROACHES);
	}
	nib->least = int_min(nib->least, pressed);
	if (nib->least == 0 || nib->least > *range / 2)
		nib->approaches = 0;
	if (nib->approaches == 0)
		nib->offset = 0;
	else if (nib->approaches == NIB_APPROACHES)
		nib->offset = nib->least;
	*range -= nib->offset;
	return pressed - nib->offset;
}
