/* The operator's page: what it shows and what the pen does on it. The host fills in the words; the
 * session knows nothing of it, and no pen that is on the page reaches the visit. Pure. */
#ifndef SERVICE_PAGE_H
#define SERVICE_PAGE_H

#include "ui.h"

enum {
	SERVICE_LINES_MAX = 16,
	SERVICE_CROSSES_MAX = 25,
	SERVICE_PIN_MAX = 8,
	SERVICE_KEY_BYTES = 32,
	SERVICE_VALUE_BYTES = 200,
};

enum service_view {
	SERVICE_PIN,     /* asks for the PIN */
	SERVICE_HOME,    /* everything at a glance */
	SERVICE_CROSSES, /* calibration: one cross after the other */
	SERVICE_RESULT,  /* what it leaves: accept or repeat */
};

enum service_level { SERVICE_PLAIN, SERVICE_GREEN, SERVICE_AMBER, SERVICE_RED };

enum service_card {
	SERVICE_CARD_PENS,
	SERVICE_CARD_BUTTONS,
	SERVICE_CARD_DISPLAY,
	SERVICE_CARD_LOG,
	SERVICE_CARD_SOLVER,
	SERVICE_CARD_VISITS,
	SERVICE_CARDS,
};

enum service_check {
	SERVICE_CHECK_DISPLAY,
	SERVICE_CHECK_PEN,
	SERVICE_CHECK_BUTTONS,
	SERVICE_CHECK_STORAGE,
	SERVICE_CHECK_SOLVER,
	SERVICE_CHECKS,
};

/* What can be tapped. */
enum service_key {
	SERVICE_KEY_NONE,
	SERVICE_KEY_LEAVE,
	SERVICE_KEY_CALIBRATE,
	SERVICE_KEY_LANGUAGE,
	SERVICE_KEY_IDLE,
	SERVICE_KEY_TURN,
	SERVICE_KEY_NEW,
	SERVICE_KEY_ACCEPT,
	SERVICE_KEY_REPEAT,
	SERVICE_KEY_DIGIT_0,
	SERVICE_KEY_DIGIT_9 = SERVICE_KEY_DIGIT_0 + 9,
	SERVICE_KEY_BACK, /* the last digit */
	SERVICE_KEYS,
};

struct service_line {
	enum service_level level;
	char key[SERVICE_KEY_BYTES]; /* "": the value has the whole line */
	char value[SERVICE_VALUE_BYTES];
};

struct service_list {
	int count;
	struct service_line line[SERVICE_LINES_MAX];
};

struct service_cross {
	struct v2 meant_px, seen_px; /* of the picture */
};

struct service_page {
	enum service_view view;
	enum language language;
	int width, height;
	float unit;                    /* pixels for a pixel at 1080 lines */
	int changed;                   /* counts whatever looks different */
	int silent;                    /* frames without a moving pen */
	struct rect key[SERVICE_KEYS]; /* w == 0: not on this view */
	bool dull[SERVICE_KEYS];       /* shown, and can't be used now */
	char value[SERVICE_KEYS][32];  /* what is set, on its key */
	struct service_list card[SERVICE_CARDS], check;

	/* the pen */
	enum service_key hover, pressed;
	bool touching;
	struct v2 pen_px, still_px;

	char pin[SERVICE_PIN_MAX + 1], typed[SERVICE_PIN_MAX + 1];
	bool pin_wrong;

	int cross, cross_count; /* asked for now */
	struct service_cross crosses[SERVICE_CROSSES_MAX];
	struct v2 sum_px; /* of this touch */
	int sum_count;
	char result[SERVICE_VALUE_BYTES]; /* of the calibration */
	bool result_good;                 /* may be accepted */
};

/* Opens it: at the PIN when there is one. Calibration asks for 2 to 5 crosses a side. */
void service_page_open(struct service_page *page, int width, int height, enum language language,
		       const char *pin, int crosses_a_side);

/* One frame's samples. Returns the key whose work the host must do: LEAVE, LANGUAGE, IDLE, TURN,
 * NEW, REPEAT after the last cross was taken (the host then fills in the result), ACCEPT. */
enum service_key service_page_update(struct service_page *page, const struct frame_input *input);

void service_page_show(struct service_page *page, enum service_view view);

/* Rectangles of cards and of the checks' strip. */
struct rect service_page_card(const struct service_page *page, enum service_card card);
struct rect service_page_check(const struct service_page *page, enum service_check check);

/* A line of a card, formatted. */
void service_list_add(struct service_list *list, enum service_level level, const char *key,
		      const char *format, ...) __attribute__((format(printf, 4, 5)));

#endif
