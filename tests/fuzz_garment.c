/* Any bytes as a garment file: read, then meshed with a small budget. */
#include "format_garment.h"
#include "garment.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static unsigned char memory[8 << 20];
	static struct pattern pattern;
	static struct garment garment;
	static struct garment_job *job;
	if (!job) {
		struct arena arena;
		arena_init(&arena, memory, sizeof memory);
		garment_init(&garment, &arena);
		job = garment_job_init(&arena);
	}
	char fault[200];
	if (!format_garment_read(&pattern, (const char *)data, size, fault))
		return 0;
	bool done = garment_start(job, &garment, &pattern, 300) != NULL;
	while (!done)
		garment_advance(job, 1 << 20, &done);
	return 0;
}
