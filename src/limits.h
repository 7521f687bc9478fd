/* Every capacity and every per-frame quota, on one page, with its price.
 *
 * All memory is taken at start from one arena (`kitsuke help limits` prints the bill). "Full" is an
 * answer that the visitor sees, never an error. */
#ifndef LIMITS_H
#define LIMITS_H

/* Vertices of a garment: the capacity that a station may want otherwise, 64 to 65535. Everything
 * that hangs on it grows with it: make CFLAGS=-DGARMENT_VERTICES_MAX=50000 build=build/large */
#ifndef GARMENT_VERTICES_MAX
#define GARMENT_VERTICES_MAX 16384
#endif

/* Whole states for undo: a document is 0.2 MB, a vertex's share of a garment about 64 bytes. Holds
 * 32 states of up to 8,000 vertices, 20 of 16,000. */
#define UNDO_DOCUMENT_BYTES ((size_t)8 << 20)
#define UNDO_GARMENT_BYTES ((size_t)1024 * GARMENT_VERTICES_MAX)

/* One block for everything but the C library, GL and the window system: the body, and a share for
 * every vertex of the garment. `kitsuke help limits` says what is used of it. */
#define KIOSK_MEMORY_BYTES (((size_t)64 << 20) + (size_t)4736 * GARMENT_VERTICES_MAX)

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
	GARMENT_TRIANGLES_MAX = 2 * GARMENT_VERTICES_MAX,
	GARMENT_EDGES_MAX = 3 * GARMENT_VERTICES_MAX,
	SEAM_PAIRS_MAX = GARMENT_VERTICES_MAX / 2,

	/* The body. */
	BODY_VERTICES_MAX = 65536,
	BODY_TRIANGLES_MAX = 131072,
	BODY_BONES_MAX = 32,

	/* Undo: whole states, so that going back is a copy; as many as fit UNDO_BYTES_MAX. */
	UNDO_STATES_MAX = 32,
	EDIT_POINTS_MAX = 512,
};

#endif
