/* The page with the finished card as a layer over the whole screen. It is painted when the station
 * starts, and then where it changes: a typeface and a screenful take longer than a frame. */
#ifndef DRAW_TAKE_HOME_H
#define DRAW_TAKE_HOME_H

#include "draw_layer.h"
#include "take_home_page.h"

struct take_home_sheet;

/* NULL with a line in fault: no font, no memory. */
struct take_home_sheet *take_home_sheet_open(int width, int height, char fault[200]);
void take_home_sheet_close(struct take_home_sheet *sheet);

/* It has left the screen: all of it goes up once more. */
void take_home_sheet_again(struct take_home_sheet *sheet);

/* Drawn anew where it looks different. */
const struct layer *take_home_sheet_update(struct take_home_sheet *sheet, const struct ui *ui,
					   const struct take_home_page *page);

#endif
