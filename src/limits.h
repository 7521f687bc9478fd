/* Every capacity and every per-frame quota, on one page, with its price.
 *
 * All memory is taken at start from one arena (`kitsuke help limits` prints the bill). "Full" is an
 * answer that the visitor sees, never an error. */
#ifndef LIMITS_H
#define LIMITS_H

/* One block for everything but the C library, GL and the window system. */
#define KIOSK_MEMORY_BYTES ((size_t)64 << 20)

enum {
	FRAME_RATE_HZ = 60, /* frames are the only clock inside the program */

	/* Input: one frame's worth. A 500 Hz pen brings 9 reports in a 60 Hz frame. */
	REPORT_BYTES_MAX = 192,    /* the longest pen report known (Wacom Intuos Pro 2) */
	FRAME_REPORTS_MAX = 64,    /* 13 kB; the rest waits for the next frame */
	FRAME_SAMPLES_MAX = 64,    /* one a report */
	FRAME_EDITS_MAX = 16,      /* 108 kB */
	STROKE_SAMPLES_MAX = 8192, /* 33 s of drawing without a lift at 250 Hz */

	/* The pattern. */
	PIECES_MAX = 24,
	OUTLINE_POINTS_MAX = 512, /* a piece: 4.7 kB */
	SEAMS_MAX = 64,
	MARKS_MAX = 32,       /* on cloth, and as many on the body */
	MARK_POINTS_MAX = 96, /* a body mark: 2.3 kB */
	PINS_MAX = 32,
	NAME_BYTES_MAX = 32,

	/* The garment: every piece of the pattern, meshed and sewn. */
	GARMENT_VERTICES_MAX = 8192,
	GARMENT_TRIANGLES_MAX = 16384,
	GARMENT_EDGES_MAX = 3 * 8192,
	SEAM_PAIRS_MAX = 4096,

	/* The body. */
	BODY_VERTICES_MAX = 65536,
	BODY_TRIANGLES_MAX = 131072,
	BODY_BONES_MAX = 32,

	/* Undo: whole states, so that going back is a copy. */
	UNDO_STATES_MAX = 32,
	EDIT_POINTS_MAX = 512,
};

#endif
