/* A card over the picture: that the station begins anew in so many seconds, or that it waits for a
 * visitor. */
#ifndef DRAW_NOTICE_H
#define DRAW_NOTICE_H

#include "draw_layer.h"

struct notice_sheet;

struct notice_sheet *notice_sheet_open(int width, int height, char fault[200]);
void notice_sheet_close(struct notice_sheet *sheet);
const struct layer *notice_sheet_update(struct notice_sheet *sheet, enum language language,
					int left_s, int whole_s);

#endif
