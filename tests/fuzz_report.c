/* Any reports through a device that any bytes describe: samples stay on the screen and finite.
 * The input: one byte of size, that many bytes of descriptor, then reports with a byte of size and
 * a byte of milliseconds each. */
#include "pen.h"
#include "samples.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static struct pen pen;
	static struct frame_reports reports;
	static struct frame_input input;
	size_t at = size ? 1 + (size_t)data[0] : 0;
	if (!size || at > size)
		return 0;
	pen_init(&pen, 1920, 1080);
	pen_describe(&pen, 0, data + 1, data[0]);
	pen_describe(&pen, 1, mouse_descriptor, mouse_descriptor_size);
	int64_t time_us = 0;
	while (at + 2 < size) {
		size_t bytes = data[at] % (REPORT_BYTES_MAX + 1);
		time_us += data[at + 1] * INT64_C(1000);
		at += 2;
		bytes = bytes > size - at ? size - at : bytes;
		struct raw_report report = {bytes & 1, time_us, (int)bytes, {0}};
		memcpy(report.bytes, data + at, bytes);
		at += bytes;
		input = (struct frame_input){0};
		reports.count = 1;
		reports.report[0] = report;
		pen_read(&pen, &reports, time_us, &input);
		samples_check(&input, 1920, 1080);
	}
	input = (struct frame_input){0};
	pen_unplugged(&pen, 0, &input);
	samples_check(&input, 1920, 1080);
	MUST(pen.device[0].state == PEN_AWAY);
	return 0;
}
