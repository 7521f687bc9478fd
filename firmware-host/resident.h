/* Memory that is there before it is needed: a frame never waits for a page. */
#ifndef RESIDENT_H
#define RESIDENT_H

#include "store.h"

/* Before anything else: the heap keeps the pages that it has, and the stack those it may need. */
void resident_begin(void);

/* All that is mapped now stays in memory, code and libraries too. False: the system does not allow
 * it, and fault says what to do about it; the program runs on without. */
bool resident_lock(char fault[FAULT_BYTES]);

#endif
