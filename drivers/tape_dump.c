/* usbhid-dump's text, block by block; see tape_reader.h. */
#include "tape_reader.h"

bool reader_block_end(struct reader *r)
{
	struct block *block = &r->block;
	struct tape_device *device = &r->tape->device[block->device];
	if (!block->open)
		return true;
	block->open = false;
	if (block->descriptor) {
		device->used = block->size > 0;
		device->descriptor_size = block->size;
		memcpy(device->descriptor, block->bytes, (size_t)block->size);
		return true;
	}
	if (block->size == 0)
		return true;
	if (block->size > REPORT_BYTES_MAX)
		return reader_fault(r, "a report has 1 to %d bytes", REPORT_BYTES_MAX);
	return reader_event(r, block->time_us, block->device, block->size, block->bytes);
}

bool reader_block_bytes(struct reader *r)
{
	struct block *block = &r->block;
	int count = reader_bytes(r, block->bytes + block->size, TAPE_DESCRIPTOR_MAX - block->size);
	if (count < 0)
		return reader_fault(r, "no hex bytes, or more than %d; the dump is damaged",
				    TAPE_DESCRIPTOR_MAX);
	block->size += count;
	return true;
}

/* [[bus:]address:]interface:STREAM or :DESCRIPTOR and a time. Other lines of digits and colons are
 * what usbhid-dump tells about time-outs. */
bool reader_block_begin(struct reader *r)
{
	int64_t number[3] = {0};
	int count = 0;
	for (; count < 3 && r->c < r->stop && reader_digit(*r->c, 10) >= 0; count++) {
		number[count] = reader_number(r, 10, 3);
		if (number[count] < 0 || !reader_skip(r, ":"))
			return reader_fault(
				r, "unknown line; tapes are hid-recorder or usbhid-dump text");
	}
	bool stream = reader_skip(r, "STREAM"),
	     descriptor = !stream && reader_skip(r, "DESCRIPTOR");
	if (!stream && !descriptor)
		return true;
	if (number[count - 1] >= TAPE_DEVICES_MAX)
		return reader_fault(r, "an interface outside of 0 to %d", TAPE_DEVICES_MAX - 1);
	int bus = count == 3 ? (int)number[0] : 0, address = count > 1 ? (int)number[count - 2] : 0;
	if (r->dump_addressed && (bus != r->dump_bus || address != r->dump_address))
		return reader_fault(
			r, "a second device; record one at a time (usbhid-dump -s BUS:ADDRESS)");
	int64_t time_us = reader_time_us(r);
	if (time_us < 0)
		return reader_fault(r, "no time after STREAM or DESCRIPTOR");
	if (stream && !r->dump_begun) {
		r->dump_begun = true;
		r->dump_start_us = time_us;
	}
	r->dump_addressed = true;
	r->dump_bus = bus;
	r->dump_address = address;
	time_us -= r->dump_start_us;
	r->block.open = true;
	r->block.descriptor = descriptor;
	r->block.device = (int)number[count - 1];
	r->block.size = 0;
	r->block.time_us = time_us < 0 ? 0 : time_us;
	return true;
}
