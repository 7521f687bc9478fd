/* Every word that a visitor reads, in Japanese and in English, in one table. */
#ifndef TEXT_H
#define TEXT_H

#include "ui.h"

struct phrase {
	const char *japanese, *english; /* UTF-8 */
};

enum text {
	TEXT_NONE,
	/* The steps' hints: what to do next. */
	TEXT_HINT_DRAW,
	TEXT_HINT_DRAW_SELECTED,
	TEXT_HINT_GRIPS,
	TEXT_HINT_AXIS,
	TEXT_HINT_POINTS,
	TEXT_HINT_POINTS_NONE,
	TEXT_HINT_CORNER,
	TEXT_HINT_BOX,
	TEXT_HINT_SEW,
	TEXT_HINT_SEW_SELECTED,
	TEXT_HINT_SEW_EASED,
	TEXT_HINT_SEW_EVEN,
	TEXT_HINT_MARK_CLOTH,
	TEXT_HINT_MARK_BODY,
	TEXT_HINT_MARK_PARTNER,
	TEXT_HINT_MARK_PAIR,
	TEXT_HINT_ERASE,
	TEXT_HINT_LASER,
	TEXT_HINT_DRESS,
	TEXT_HINT_DRESSING,
	TEXT_HINT_WORN,
	TEXT_HINT_ADJUST,
	TEXT_HINT_PIN,
	TEXT_HINT_RELAX,
	/* Notices: why something did not happen, and the remedy. */
	TEXT_AGAIN,
	TEXT_CROSSES,
	TEXT_SMALL,
	TEXT_ENDS_APART,
	TEXT_OVERSKETCH,
	TEXT_POINT_NEAR,
	TEXT_LAST_POINTS,
	TEXT_NO_FOLD,
	TEXT_NO_PIECE,
	TEXT_NO_SEAM,
	TEXT_SELF_SEAM,
	TEXT_EDGE_SEWN,
	TEXT_SEW_ENDS,
	TEXT_OFF_CLOTH,
	TEXT_OFF_BODY,
	TEXT_NO_PAIR,
	TEXT_NOT_WORN,
	TEXT_NOTHING,
	TEXT_FULL,
	TEXT_MESH,
	/* What a wrap found (struct diagnosis; S10). */
	TEXT_UNREACHED,
	TEXT_DISAGREE,
	TEXT_LENGTHS,
	TEXT_NO_PARTNER,
	TEXT_DIRECTIONS,
	TEXT_NOT_SEWN,
	TEXT_HEAD_OUTSIDE,
	TEXT_LIMB_OUTSIDE,
	TEXT_NOT_REACHED,
	TEXT_MARK_IGNORED,
	TEXT_SWAPPED,
	TEXT_LET_OUT,
	TEXT_GATHERED,
	/* Names on the sheet and the bars. */
	TEXT_INSIDE_UP,
	TEXT_CLOTH,
	TEXT_STRAIN,
	TEXT_TITLE,
	TEXT_COUNT,
};

extern const struct phrase text_phrase[TEXT_COUNT];
extern const struct phrase text_target[TARGET_COUNT];

/* The visitor's words for why an edit was refused (session->notice, piece_fault and their like). */
enum text text_refusal(const char *reason);

/* The hint for what the visitor can do now, or what the last wrap has to say; mark: the numbers it
 * is about, 0 where there are none. */
enum text text_hint(const struct ui *ui, const struct session *session, int mark[2]);

#endif
