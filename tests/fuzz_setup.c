/* Any descriptor, any ids, and any answers to what its recipe asks: a protocol with sound ranges,
 * or a reason. The input: ids, the descriptor's length and bytes, then answers with a byte of what
 * happens (its length, or an error) each. */
#include "pen_setup.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

struct source {
	const uint8_t *data;
	size_t size;
	int asked;
};

static int byte_next(struct source *source)
{
	if (!source->size)
		return -1;
	source->size--;
	return *source->data++;
}

static int moved(struct source *source, uint8_t *bytes, int capacity)
{
	int what = byte_next(source);
	MUST(++source->asked < 1000);
	if (what < 0)
		return -PEN_SETUP_GONE;
	if (what >= 250)
		return what == 255 ? 70000 : -(what - 249);
	int size = int_min(int_min(what, capacity), (int)source->size);
	memcpy(bytes, source->data, (size_t)size);
	source->data += size;
	source->size -= (size_t)size;
	return size;
}

static int string_get(void *context, int index, uint8_t *bytes, int capacity)
{
	(void)index;
	return moved(context, bytes, capacity);
}

static int bytes_send(void *context, const uint8_t *bytes, int size)
{
	uint8_t copy[64];
	MUST(size > 0 && size <= 64);
	memcpy(copy, bytes, (size_t)size);
	return moved(context, copy, size);
}

static int feature_get(void *context, uint8_t *bytes, int size)
{
	return moved(context, bytes, size);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	if (size < 6 || size - 6 < data[5])
		return 0;
	struct pen_identity identity = {
		.bus = data[0] % 4,
		.vendor = data[1] << 8 | data[2],
		.product = data[3] << 8 | data[4],
		.driver = "",
		.descriptor = data + 6,
		.descriptor_size = data[5],
	};
	struct source source = {data + 6 + data[5], size - 6 - data[5], 0};
	struct pen_transport transport = {&source,    string_get,  bytes_send,
					  bytes_send, feature_get, NULL};
	struct pen_setup_result result;
	struct pen_recipe recipe;
	struct pen_block block;
	char reason[160] = "";
	int left = (int)(source.size > 300 ? 300 : source.size);
	if (!pen_block_1_read(source.data, left, &block, reason))
		MUST(reason[0]);
	if (!pen_block_2_read(source.data, left, &block, reason))
		MUST(reason[0]);
	reason[0] = 0;
	if (!pen_identify(&identity, &recipe, reason)) {
		MUST(reason[0]);
		return 0;
	}
	pen_setup(&identity, &recipe, &transport, &result);
	MUST(result.done || result.reason[0]);
	MUST(!result.done || recipe.family == PEN_BY_DESCRIPTOR ||
	     (pen_vendor_sound(&result.vendor) && result.width_mm > 0.0f));
	return 0;
}
