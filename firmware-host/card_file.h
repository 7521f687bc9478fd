/* A card without a station: of what a journal has dressed. */
#ifndef CARD_FILE_H
#define CARD_FILE_H

#include "session.h"
#include "store.h"

/* Writes the card's PNG and prints what its code is like. `journal`: the file that the card names
 * when no code holds the pattern. False: the fault names the file. */
bool card_file_write(const struct session *session, const char *body, const char *journal,
		     const char *path, char fault[FAULT_BYTES]);

/* Today, as it stands on a card. */
void card_date(char date[], size_t size);

#endif
