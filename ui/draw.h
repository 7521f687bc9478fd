/* The picture: body, cloth and marks by GLES; pattern sheet, bars and text by cairo and Pango on
 * cached layers that are redrawn only where they changed. Needs a current GLES 3.0 context (used in
 * a GLES 2 shape). All GL objects can be made again from CPU data. */
#ifndef DRAW_H
#define DRAW_H

#include "service_page.h"
#include "ui.h"

struct draw;

/* Everything drawing will need for this screen size. NULL with a line in fault when GL or a font is
 * at fault. Memory: malloc at start, none of ours per frame. */
struct draw *draw_open(int width, int height, char fault[200]);

/* Draws one whole frame into the currently bound framebuffer. */
void draw_frame(struct draw *draw, const struct ui *ui, const struct session *session);
void draw_close(struct draw *draw);

/* The operator's page in place of a frame. Its memory is taken when it is first shown, and given
 * back by draw_service_end. False with a line in fault: it can't be shown. */
bool draw_service(struct draw *draw, const struct service_page *page, char fault[200]);
void draw_service_end(struct draw *draw);

/* A card over the frame just drawn: so many of whole_s seconds are left before the station begins
 * anew; 0: it waits for a visitor. Taken and given back like the page. */
bool draw_notice(struct draw *draw, enum language language, int left_s, int whole_s,
		 char fault[200]);
void draw_notice_end(struct draw *draw);

/* The body's mesh changed (start, another character). */
void draw_body_changed(struct draw *draw);

/* Shows the bones over the figure (S19), for the operator and for pictures in documents. */
void draw_bones(struct draw *draw, bool shown);

#endif
