/* The operator's page as a layer over the whole screen; made when it is first opened. */
#ifndef DRAW_SERVICE_H
#define DRAW_SERVICE_H

#include "draw_layer.h"
#include "service_page.h"

struct service_sheet;

/* NULL with a line in fault: no font, no memory. */
struct service_sheet *service_sheet_open(int width, int height, char fault[200]);
void service_sheet_close(struct service_sheet *sheet);

/* Drawn anew when page->changed has moved on. */
const struct layer *service_sheet_update(struct service_sheet *sheet,
					 const struct service_page *page);

#endif
