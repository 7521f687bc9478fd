/* The picture: body, cloth and marks by GLES; pattern sheet, bars and text by cairo and Pango on
 * cached layers that are redrawn only where they changed. Needs a current GLES 3.0 context (used in
 * a GLES 2 shape). All GL objects can be made again from CPU data. */
#ifndef DRAW_H
#define DRAW_H

#include "service_page.h"
#include "take_home_page.h"
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

/* The figure alone, into memory of GL that is taken for it: PORTRAIT_WIDTH x PORTRAIT_HEIGHT pixels
 * on nothing (draw_card.h), from azimuth_rad as view_look has it. Costs about a frame's drawing. A
 * frame or two later draw_portrait_fetch gives its pixels from malloc, in cairo's ARGB32; NULL: no
 * memory. Nothing of it stays after draw_portrait_end. */
bool draw_portrait(struct draw *draw, const struct session *session, float azimuth_rad);
unsigned char *draw_portrait_fetch(struct draw *draw);
void draw_portrait_end(struct draw *draw);

/* The page with the finished card in place of a frame; its texture is given back in the end. */
void draw_take_home(struct draw *draw, const struct ui *ui, const struct take_home_page *page);
void draw_take_home_end(struct draw *draw);

/* The body's mesh changed (start, another character). */
void draw_body_changed(struct draw *draw);

/* Shows the bones over the figure (S19), for the operator and for pictures in documents. */
void draw_bones(struct draw *draw, bool shown);

#endif
