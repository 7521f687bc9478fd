#include "card_file.h"

#include "snapshot.h"
#include "take_home_card.h"
#include "take_home_content.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

void card_date(char date[], size_t size)
{
	struct tm parts;
	time_t now = time(NULL);
	localtime_r(&now, &parts);
	strftime(date, size, "%Y.%m.%d", &parts);
}

/* Without GL the card has no figure, and is a card all the same. */
static void take_portraits(struct card *card, const struct session *session)
{
	struct snapshot snapshot;
	char fault[FAULT_BYTES];
	if (!snapshot_open(&snapshot, 640, 360, fault)) {
		fprintf(stderr, "kitsuke dress: note: a card without its figure: %s\n", fault);
		return;
	}
	for (int i = 0; i < PORTRAITS; i++) {
		draw_portrait(snapshot.draw, session, PORTRAIT_AZIMUTH + (float)i * PI_F);
		card->portrait[i] = draw_portrait_fetch(snapshot.draw);
	}
	draw_portrait_end(snapshot.draw);
	snapshot_close(&snapshot);
}

static void print_code(const struct card_made *made)
{
	const struct code_figures *figures = &made->figures;
	printf("code %d bytes, packed %d, %d characters, 1/%d mm%s, ", figures->raw_bytes,
	       figures->packed_bytes, figures->characters, figures->per_mm,
	       figures->exact ? " to the bit" : "");
	if (made->qr_version)
		printf("QR version %d-%c\n", made->qr_version, made->qr_level);
	else
		printf("too large for a QR code\n");
}

static bool write_card(struct card_made *made, const struct session *session, const char *path,
		       char fault[FAULT_BYTES])
{
	size_t size;
	take_portraits(&made->card, session);
	uint8_t *png = card_png(made, &size, fault);
	bool written = png && store_write(path, png, size, fault);
	free(png);
	for (int i = 0; i < PORTRAITS; i++)
		free(made->card.portrait[i]);
	if (written)
		print_code(made);
	return written;
}

bool card_file_write(const struct session *session, const char *body, const char *journal,
		     const char *path, char fault[FAULT_BYTES])
{
	struct card_made *made = calloc(1, sizeof *made);
	struct code_content *content = calloc(1, sizeof *content);
	bool written = false;
	snprintf(fault, FAULT_BYTES, "not enough memory for a card");
	if (made && content) {
		content_take(content, &session->document, session->cloth.worn, body);
		if (card_begin(made, content, fault)) {
			card_date(made->card.date, sizeof made->card.date);
			snprintf(made->card.file, sizeof made->card.file, "%.63s",
				 store_name(journal));
			written = write_card(made, session, path, fault);
			card_end(made);
		}
	}
	free(content);
	free(made);
	return written;
}
