/* Any reports of any maker's protocol, through the pen module: samples stay on the screen and
 * finite. The input: the family, three ranges, then reports with a byte of size and one of
 * milliseconds. */
#include "pen.h"
#include "samples.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static struct pen pen;
	static struct frame_reports reports;
	static struct frame_input input;
	if (size < 9)
		return 0;
	struct pen_vendor vendor = {
		.family = (enum pen_family)(1 + data[0] % (PEN_FAMILIES - 1)),
		.x_maximum = pen_le24(data + 1),
		.y_maximum = pen_le24(data + 4),
		.pressure_maximum = pen_le16(data + 7),
	};
	if (!pen_vendor_sound(&vendor))
		return 0;
	pen_init(&pen, 1920, 1080);
	pen_describe(&pen, 0, mouse_descriptor, mouse_descriptor_size);
	pen_vendor_set(&pen, 0, &vendor);
	int64_t time_us = 0;
	for (size_t at = 9; at + 2 < size;) {
		size_t bytes = data[at] % (REPORT_BYTES_MAX + 1);
		time_us += data[at + 1] * INT64_C(1000);
		at += 2;
		bytes = bytes > size - at ? size - at : bytes;
		/* just as long as it is, so that the sanitizer sees what reads on */
		uint8_t *exact = bytes ? __builtin_alloca(bytes) : NULL;
		struct pen_memory memory = pen.device[0].memory;
		struct pen_fields fields = {0};
		if (bytes) {
			memcpy(exact, data + at, bytes);
			pen_family_rule(vendor.family)
				->read(exact, (int)bytes, &vendor, &memory, &fields);
		}
		reports.count = 1;
		reports.report[0] = (struct raw_report){0, time_us, (int)bytes, {0}};
		memcpy(reports.report[0].bytes, data + at, bytes);
		at += bytes;
		input = (struct frame_input){0};
		pen_read(&pen, &reports, time_us, &input);
		samples_check(&input, 1920, 1080);
	}
	input = (struct frame_input){0};
	pen_unplugged(&pen, 0, &input);
	samples_check(&input, 1920, 1080);
	return 0;
}
