/* kitsuke help [TOPIC]: what the program itself knows better than any page about it. */
#include "commands.h"

#include "board.h"
#include "kiosk.h"
#include "measure.h"

#include <stdio.h>
#include <stdlib.h>

static void help_commands(void)
{
	puts("kitsuke dresses a figure: draw cloth, mark it and the body, press WRAP.\n"
	     "\n"
	     "  kitsuke [--board FILE]        the station: on a free display, else in a window\n"
	     "  kitsuke replay TAPE... --out DIR [--no-pictures] [--pictures-every N]\n"
	     "                 [--body FILE] [--samples [--descriptor FILE]] [--jitter-mm N --seed "
	     "N] [--threads N]\n"
	     "                                plays recorded raw input headless; --samples: what\n"
	     "                                the pen says, as a line of JSON each\n"
	     "  kitsuke dress JOURNAL [--obj FILE] [--glb FILE] [--picture FILE] [--report FILE]\n"
	     "                 [--body FILE] [--body-obj FILE] [--bones FILE] [--bones-out FILE] "
	     "[--start OBJ]\n"
	     "                 [--card FILE] [--threads N] [--progress]\n"
	     "                                runs a document without input devices;\n"
	     "                                --start: from a drape of another program;\n"
	     "                                --card: the picture that visitors take home\n"
	     "  kitsuke import PATTERN [--marks FILE|guess] --journal FILE\n"
	     "                                reads a pattern file into a document\n"
	     "  kitsuke import CARD|CODE --journal FILE\n"
	     "                                the same of a card's PNG, or the text of its QR "
	     "code\n"
	     "  kitsuke check FILE...         are bodies, patterns, journals, tapes, boards "
	     "sound?\n"
	     "  kitsuke record --out TAPE     records attached tablets and buttons\n"
	     "  kitsuke record --visits [--board FILE]\n"
	     "                                the station; each visit's tape beside its journal\n"
	     "  kitsuke devices [--descriptor FILE]\n"
	     "                                what is attached, and what a descriptor yields\n"
	     "  kitsuke calibrate [BOARD]     how much work fits a frame of this machine; into "
	     "BOARD\n"
	     "  kitsuke help [journal|landmarks|marks|tape|board|limits]\n"
	     "\n"
	     "Exit status: 0 done, 1 the input is at fault, 2 usage, 3 the machine is at fault.");
}

/* ---- journal ---- */

struct edit_help {
	const char *arguments, *meaning;
};

static const struct edit_help edit_help[EDIT_KIND_COUNT] = {
	[EDIT_BODY] = {"NAME", "who is dressed: mannequin, or an OBJ file beside the journal"},
	[EDIT_PIECE] = {"NAME SWATCH OVER X Y TURN OUTLINE", "a new piece, local outline, OVER 1: "
							     "inside up; X Y mm, TURN rad"},
	[EDIT_OUTLINE] = {"PIECE OUTLINE", "a piece gets this outline"},
	[EDIT_SCALE] = {"PIECE SX SY X Y", "larger or smaller about X Y, its marks with it"},
	[EDIT_POINT] = {"PIECE CORNER X Y", "a corner moves there, both its edges follow"},
	[EDIT_BEND] = {"PIECE EDGE X Y", "the edge bends so that its middle lies there"},
	[EDIT_SPLIT] = {"PIECE EDGE SHARE", "a new corner there, 0..1 of the edge's length; a "
					    "seam and its other edge are divided, too"},
	[EDIT_JOIN] = {"PIECE CORNER", "the corner goes, its two edges become one"},
	[EDIT_FOLD] = {"PIECE ON X Y RAD", "ON 1: the piece is symmetric from here on, about the "
					   "axis through X Y; ON 0: no longer"},
	[EDIT_PLACE] = {"PIECE OVER X Y TURN", "where a piece lies on the sheet, which side up"},
	[EDIT_COPY] = {"PIECE X Y", "a copy, X Y mm aside"},
	[EDIT_MIRROR] = {"PIECE", "its shape becomes its mirror image"},
	[EDIT_DELETE] = {"PIECE", "away with it, its seams and its marks"},
	[EDIT_SWATCH] = {"PIECE SWATCH", "another cloth"},
	[EDIT_LAYER] = {"PIECE LAYER", "its garment is worn over those of lower layers; equal "
				       "ones as they were drawn"},
	[EDIT_SEW] = {"PIECE EDGE PIECE EDGE SWAPPED", "sews two edges; the start of one meets "
						       "the end of the other, or its start if "
						       "SWAPPED is 1"},
	[EDIT_EVEN] = {"SEAM ON", "ON 1: its edges are kept equally long while one is edited; ON "
				  "0: the longer is eased in"},
	[EDIT_UNSEW] = {"SEAM", "opens a seam"},
	[EDIT_MARK_CLOTH] = {"NUMBER PIECE X Y ...", "a line on the cloth, mm on the piece"},
	[EDIT_MARK_BODY] = {"NUMBER X Y Z ...", "a line on the body, m; snaps to the surface"},
	[EDIT_MARK_AT] = {"NUMBER LANDMARK FROM TO ALONG ASIDE",
			  "the same, along a landmark: `kitsuke help landmarks`"},
	[EDIT_UNMARK] = {"SIDE NUMBER", "erases a mark; SIDE 0 cloth, 1 body"},
	[EDIT_WRAP] = {"", "lays the garment on the body, equal numbers together"},
	[EDIT_GRAB] = {"PIECE X Y", "takes hold of a cloth point, mm on the piece"},
	[EDIT_DRAG] = {"X Y Z", "pulls it there, m"},
	[EDIT_RELEASE] = {"", "lets go"},
	[EDIT_PIN] = {"PIECE X Y", "holds a cloth point where it is"},
	[EDIT_UNPIN] = {"PIN", "takes a pin out"},
	[EDIT_RELAX] = {"ON", "1: the cloth finds its own shape, 0: no longer"},
	[EDIT_FABRIC] = {"NAME",
			 "what the garment is made of: jersey, silk, denim, wool, leather or "
			 "elastic"},
	[EDIT_UNDO] = {"", "one step back"},
	[EDIT_REDO] = {"", "and forward again"},
	[EDIT_CLEAR] = {"", "starts over; can be undone"},
	[EDIT_BUDGET] = {"UNITS", "work units a frame from here on"},
	[EDIT_STEP] = {"FRAMES", "so many frames pass"},
	[EDIT_WORN] = {"", "frames pass until the wrap is done; then cloth can be pinned"},
	[EDIT_SETTLE] = {"", "frames pass until the wrap is done and the cloth rests"},
};

static void help_journal(void)
{
	puts("A journal is the save file, the undo history, a script and a crash report: text, "
	     "one\n"
	     "edit a line, played from the top. Pieces, seams and pins count from 0 in the order "
	     "in\nwhich they were made (freed places are used again).\n"
	     "\n"
	     "  " JOURNAL_HEADER "  # a comment\n"
	     "  piece front 0 0 0 0 0  -200 -300 1  200 -300 1  200 300 1  -200 300 1\n"
	     "\n"
	     "An OUTLINE is a list of X Y CORNER (mm, y up, counter-clockwise seen from the "
	     "outside;\nCORNER 1 where one edge ends and the next begins, else 0; edge 0 starts at "
	     "the first\ncorner). A line may end in *1a2b3c4d, its checksum (FNV-1a, 32 bit, of "
	     "all "
	     "before the\nblanks in front of it): the station writes one, a person need not.\n");
	for (int kind = 0; kind < EDIT_KIND_COUNT; kind++)
		printf("  %s %s\n      %s\n", edit_word[kind], edit_help[kind].arguments,
		       edit_help[kind].meaning);
}

/* ---- landmarks ---- */

static void help_landmarks(void)
{
	puts("A landmark is a named line on the body, found from its bones, so that a mark can be "
	     "\nstated once for every body. Left is the wearer's left.\n"
	     "\n"
	     "  mark-at NUMBER LANDMARK FROM TO ALONG ASIDE\n"
	     "\n"
	     "FROM and TO count the landmark's stops from 0: on front-centre (neck pit, waist,\n"
	     "crotch) 0 0.6 is 60 % of the way from neck pit to waist, 1 2 from waist to crotch;\n"
	     "FROM above TO runs the other way. A line round the body begins in front, goes to\n"
	     "the wearer's left, is closed, and 1 is once round. ALONG moves both ends so many\n"
	     "metres on towards the landmark's end, ASIDE moves the line over the surface, metres\n"
	     "to the left of the landmark's way as one sees it from outside. Mark 1 from 2 cm\n"
	     "below the neck pit, mark 2 a hand's breadth beside it on the wearer's left:\n"
	     "\n"
	     "  mark-at 1 front-centre 0 1 0.02 0\n"
	     "  mark-at 2 front-centre 0 1 0.02 0.09\n");
	for (int i = 0; i < LANDMARK_COUNT; i++)
		printf("  %-24s %s\n", landmark_name[i], landmark_stops[i]);
	puts("\nBones are found by themselves. Where they are wrong, write them out with `kitsuke\n"
	     "dress JOURNAL --bones-out FILE`, mend the text, and give it back with --bones, or\n"
	     "name it BODY.bones beside BODY.obj: every command then takes it.");
}

/* ---- marks ---- */

static void help_marks(void)
{
	puts("A file of marks says once for a garment's design where it is worn, whatever its "
	     "size\n"
	     "and whoever wears it: on the cloth between named places of the pieces, on the body\n"
	     "along a landmark (`kitsuke help landmarks`). A line is a mark:\n"
	     "\n"
	     "  PIECE PLACE PLACE ... on LANDMARK [FROM TO]\n"
	     "\n"
	     "  # a comment line\n"
	     "  front neck/neck_m cfHem on front-centre\n"
	     "  yoke cbNeck cbYoke + back cbYoke cbHem on back-centre\n"
	     "  front.R fork .. waistIn on front-centre 2 0\n"
	     "\n"
	     "A blank in a piece's name is written _.\n"
	     "A PLACE is a name in the pattern file's `named_vertices`, or @X,Y in mm. A/B lies "
	     "halfway from A "
	     "to\n"
	     "B, A/B/0.3 after that share of the way, A/B/1.1 beyond B. `up` and `down` go "
	     "straight\n"
	     "from the place before to the far rim. The line is straight from place to place, or\n"
	     "along the outline, the shorter way round, with `..` between them. Behind a + it "
	     "goes\n"
	     "on in another piece, as though both lay end to end. Cloth and landmark meet by "
	     "their\n"
	     "distance from the start, so a line may begin beyond the cloth and end where it "
	     "likes.\n"
	     "FROM and TO are stops of the landmark; without them it is taken whole. A line\n"
	     "\n"
	     "  pin PIECE PLACE\n"
	     "\n"
	     "holds the cloth there once it is worn: an ear loop, a button.\n"
	     "\n"
	     "--marks guess makes the lines up from what the pattern file says of its pieces and\n"
	     "from its seams, and prints them, so that they can be kept and made better.\n"
	     "\n"
	     "  kitsuke import shirt.garment.json --marks shirt.marks --journal shirt.kitsuke\n"
	     "  kitsuke dress shirt.kitsuke --body anyone.obj --picture shirt.png");
}

/* ---- limits ---- */

enum { VERTICES_ASKED = 50000 }; /* the garment that a larger station may want */

struct bill {
	struct arena arena;
	size_t counted;
};

/* What a garment of so many vertices would need: all that goes with the garment is proportional. */
static void print_larger(size_t used, size_t fixed)
{
	double vertex = (double)(used - fixed) / GARMENT_VERTICES_MAX;
	char what[40];
	snprintf(what, sizeof what, "or built for %d vertices", VERTICES_ASKED);
	printf("  %-34s %9.2f MB\n", what, ((double)fixed + vertex * VERTICES_ASKED) / 1e6);
	printf("  %-34s %9.0f bytes\n", "a vertex, undo included", vertex);
}

/* What the last step took. */
static void print_share(struct bill *bill, const char *what)
{
	printf("  %-34s %9.2f MB\n", what, (double)(bill->arena.used - bill->counted) / 1e6);
	bill->counted = bill->arena.used;
}

static void print_memory(void *memory)
{
	static struct session session;
	static struct kiosk kiosk;
	struct bill bill = {.counted = 0};
	arena_init(&bill.arena, memory, KIOSK_MEMORY_BYTES);
	body_init(&session.body, &bill.arena);
	print_share(&bill, "body and its tree");
	size_t fixed = bill.counted;
	garment_init(&session.garment, &bill.arena);
	garment_job_init(&bill.arena);
	print_share(&bill, "garment and its mesher");
	cloth_init(&session.cloth, &bill.arena);
	print_share(&bill, "cloth and its constraints");
	wrap_init(&session.wrap, &bill.arena);
	drag_init(&session.drag, &bill.arena);
	print_share(&bill, "wrap and drag");
	size_t parts = bill.arena.used, grown = parts - fixed;
	arena_init(&bill.arena, memory, KIOSK_MEMORY_BYTES);
	bill.counted = parts;
	session_init(&session, &bill.arena);
	grown += bill.arena.used - parts - UNDO_DOCUMENT_BYTES;
	print_share(&bill, "undo and the rest of a session");
	kiosk_init(&kiosk, memory, 1920, 1080);
	bill.arena = kiosk.arena;
	print_share(&bill, "a frame's journal lines");
	printf("  %-34s %9.2f MB\n", "taken at start, in one block", (double)bill.arena.used / 1e6);
	printf("  %-34s %9.2f MB\n", "of a block of", (double)KIOSK_MEMORY_BYTES / 1e6);
	print_larger(bill.arena.used, bill.arena.used - grown);
	printf("  %-34s %9.2f MB\n", "and outside it, the kiosk itself",
	       (double)sizeof(struct kiosk) / 1e6);
}

static int help_limits(void)
{
	static const struct {
		const char *what;
		int limit;
	} capacity[] = {
		{"pieces of a pattern", PIECES_MAX},
		{"outline points of a piece", OUTLINE_POINTS_MAX},
		{"seams", SEAMS_MAX},
		{"marks on the cloth, on the body", MARKS_MAX},
		{"points of a mark", MARK_POINTS_MAX},
		{"pins", PINS_MAX},
		{"vertices of a garment", GARMENT_VERTICES_MAX},
		{"triangles of a garment", GARMENT_TRIANGLES_MAX},
		{"vertices of a body", BODY_VERTICES_MAX},
		{"triangles of a body", BODY_TRIANGLES_MAX},
		{"bones of a body", BODY_BONES_MAX},
		{"undo steps", UNDO_STATES_MAX},
		{"pen samples of a stroke", STROKE_SAMPLES_MAX},
		{"reports of a frame", FRAME_REPORTS_MAX},
		{"frames a second", FRAME_RATE_HZ},
	};
	void *memory = malloc(KIOSK_MEMORY_BYTES);
	if (!memory) {
		fputs("kitsuke help: not enough memory to make out the bill\n", stderr);
		return STATUS_MACHINE;
	}
	puts("At most:");
	for (int i = 0; i < COUNT_OF(capacity); i++)
		printf("  %-34s %9d\n", capacity[i].what, capacity[i].limit);
	puts("\nMemory:");
	print_memory(memory);
	free(memory);
	return STATUS_DONE;
}

/* ---- tape ---- */

static void help_tape(void)
{
	puts("A tape is recorded raw input as hid-recorder text, so that hid-replay of hid-tools\n"
	     "plays it too. What only kitsuke needs stands in comments:\n"
	     "\n"
	     "  # kitsuke-tape 1\n"
	     "  # board 1920 1080              the screen that the pen was mapped to, pixels\n"
	     "  # budget 600000                work units a frame\n"
	     "  # frames 2700                  length in frames of 1/60 s\n"
	     "  # tablet 0 203.2 127           size of device 0 in mm, if its descriptor is "
	     "silent\n"
	     "  # display 0                    device 0 is the screen\n"
	     "  # vendor 0 uclogic-2 50800 31750 8191\n"
	     "                                 the maker's protocol of device 0, and its ranges of "
	     "x, y, pressure\n"
	     "  D: 0                           the lines that follow are device 0's\n"
	     "  R: 234 05 0d 09 02 ...         report descriptor: length, bytes\n"
	     "  N: name                        I: bus vendor product\n"
	     "  E: 000001.230000 10 02 e0 ...  report: seconds, length, bytes\n"
	     "  # unplug 0 at 000002.000000\n"
	     "  # hash 4338e97ce0e20eaa        of the state at the end, if it is a visit's own\n"
	     "\n"
	     "The three buttons are a device of their own whose report is one byte: bit 0 WRAP,\n"
	     "bit 1 PIN, bit 2 RELAX. An event at time t belongs to frame floor(60 t).");
}

int command_help(int argc, char **argv)
{
	const char *topic = argc > 1 ? argv[1] : "commands";
	if (argc <= 2 && strcmp(topic, "commands") == 0)
		help_commands();
	else if (argc <= 2 && strcmp(topic, "journal") == 0)
		help_journal();
	else if (argc <= 2 && strcmp(topic, "landmarks") == 0)
		help_landmarks();
	else if (argc <= 2 && strcmp(topic, "marks") == 0)
		help_marks();
	else if (argc <= 2 && strcmp(topic, "tape") == 0)
		help_tape();
	else if (argc <= 2 && strcmp(topic, "board") == 0)
		fputs(board_text, stdout);
	else if (argc <= 2 && strcmp(topic, "limits") == 0)
		return help_limits();
	else {
		fputs("usage: kitsuke help [commands|journal|landmarks|marks|tape|board|limits]\n",
		      stderr);
		return STATUS_USAGE;
	}
	return STATUS_DONE;
}
