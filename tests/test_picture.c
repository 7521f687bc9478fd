/* Pictures as files: what is written is what is read; a full disk or a wrong path is told. */
#include "picture.h"
#include "leaks.h"
#include "test.h"

#include <cairo.h>
#include <errno.h>
#include <sys/stat.h>
#include <unistd.h>

enum { WIDTH = 33, HEIGHT = 17 };

static void fill(uint8_t *rgba, int shade)
{
	for (int y = 0; y < HEIGHT; y++)
		for (int x = 0; x < WIDTH; x++) {
			uint8_t *p = rgba + (y * WIDTH + x) * 4;
			p[0] = (uint8_t)(x * 7);
			p[1] = (uint8_t)(y * 13);
			p[2] = (uint8_t)shade;
			p[3] = 0;
		}
}

static void written_is_read(const char *folder)
{
	static uint8_t rgba[WIDTH * HEIGHT * 4];
	char path[256], fault[200];
	fill(rgba, 77);
	snprintf(path, sizeof path, "%s/frame.png", folder);
	CHECK(picture_write_png(path, WIDTH, HEIGHT, rgba, fault));
	cairo_surface_t *surface = cairo_image_surface_create_from_png(path);
	CHECK(cairo_image_surface_get_width(surface) == WIDTH);
	CHECK(cairo_image_surface_get_height(surface) == HEIGHT);
	const uint8_t *data = cairo_image_surface_get_data(surface);
	int stride = cairo_image_surface_get_stride(surface), wrong = 0;
	for (int y = 0; data && y < HEIGHT; y++)
		for (int x = 0; x < WIDTH; x++) {
			uint32_t pixel;
			memcpy(&pixel, data + y * stride + x * 4, 4);
			wrong += (pixel & 0xffffff) != (uint32_t)(x * 7 << 16 | y * 13 << 8 | 77);
		}
	CHECK(data && wrong == 0);
	cairo_surface_destroy(surface);
	snprintf(path, sizeof path, "%s/frame.png.part", folder);
	CHECK(access(path, F_OK) != 0);
}

static void faults_name_the_file(void)
{
	static uint8_t rgba[WIDTH * HEIGHT * 4];
	char fault[200] = "";
	CHECK(!picture_write_png("/nowhere/at/all.png", WIDTH, HEIGHT, rgba, fault));
	CHECK(strstr(fault, "/nowhere/at/all.png") && strstr(fault, "No such file"));
	if (access("/dev/full", F_OK) == 0) {
		fault[0] = 0;
		CHECK(!picture_write_png("/dev/full/x.png", WIDTH, HEIGHT, rgba, fault) &&
		      fault[0]);
	}
}

/* Five frames in four columns make two rows of room; what does not fit is dropped. */
static void contact_sheet_holds_its_frames(const char *folder)
{
	static uint8_t rgba[WIDTH * HEIGHT * 4];
	struct contact_sheet contact;
	char path[256], fault[200];
	CHECK(contact_open(&contact, 5, WIDTH, HEIGHT, 100));
	CHECK(contact.columns == 4 && contact.rows == 2 && contact.cell_h == 51);
	for (int i = 0; i < 9; i++) {
		fill(rgba, i * 40);
		contact_add(&contact, WIDTH, HEIGHT, rgba, "印 frame");
	}
	CHECK(contact.count == 8);
	const uint8_t *cell = contact.rgba +
			      ((size_t)(12 + 25) * (size_t)contact.width + 12 + 112) * 4;
	CHECK(cell[2] == 40);
	int width = contact.width, height = contact.height;
	snprintf(path, sizeof path, "%s/contact.png", folder);
	CHECK(contact_finish(&contact, path, fault));
	cairo_surface_t *surface = cairo_image_surface_create_from_png(path);
	CHECK(cairo_image_surface_get_width(surface) == width);
	CHECK(cairo_image_surface_get_height(surface) == height);
	cairo_surface_destroy(surface);
}

int main(int argc, char **argv)
{
	char folder[200], command[220];
	CHECK(argc == 1);
	snprintf(folder, sizeof folder, "%s.pictures", argv[0]);
	CHECK(mkdir(folder, 0777) == 0 || errno == EEXIST);
	written_is_read(folder);
	faults_name_the_file();
	contact_sheet_holds_its_frames(folder);
	snprintf(command, sizeof command, "rm -r %s", folder);
	CHECK(system(command) == 0);
	return test_end();
}
