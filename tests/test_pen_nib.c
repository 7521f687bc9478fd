/* Worn nibs: pressure in the air counts as none, per end of the pen, and only when it is there for
 * good. */
#include "pen_filter.h"
#include "test.h"

static struct pen_device device;
static struct pen_layout layout = {.pressure = {.size = 16, .minimum = 10, .maximum = 1010}};
static int range;

static int see(bool entering, int pressure, bool eraser)
{
	struct pen_fields fields = {.pressure = pressure, .invert = eraser};
	return pen_nib(&device, &layout, &fields, entering, &range);
}

/* Comes into range with these pressures in the air. */
static void approach(int first, int then, bool eraser)
{
	see(true, first, eraser);
	see(false, then, eraser);
}

static void worn_nibs_are_found(void)
{
	device = (struct pen_device){0};
	approach(130, 135, false);
	approach(140, 131, false);
	CHECK(device.nib[0].offset == 0 && see(false, 510, false) == 500 && range == 1000);
	approach(132, 140, false);
	CHECK(device.nib[0].offset == 120 && range == 880);
	CHECK(see(false, 130, false) == 0 && see(false, 1010, false) == 880);
	CHECK(device.nib[1].offset == 0 && see(true, 500, true) == 490 && range == 1000);
	/* still less, and then a new nib */
	CHECK(see(false, 110, false) == 0 && device.nib[0].offset == 100);
	CHECK(see(true, 10, false) == 0 && device.nib[0].offset == 0);
	CHECK(see(false, 510, false) == 500 && range == 1000);
	approach(130, 130, false);
	CHECK(device.nib[0].offset == 0);
}

/* A visitor who stabs at the tablet comes into range with pressure, too. */
static void healthy_nibs_are_left_alone(void)
{
	device = (struct pen_device){0};
	for (int i = 0; i < 10; i++) {
		approach(300 + 20 * i, 700, false);
		see(false, 10, false);
		CHECK(device.nib[0].offset == 0);
	}
	/* below its minimum is none */
	CHECK(see(true, 0, false) == 0);
}

static void more_than_half_is_a_fault(void)
{
	device = (struct pen_device){0};
	for (int i = 0; i < 5; i++)
		approach(600, 600, false);
	CHECK(device.nib[0].offset == 0 && see(false, 600, false) == 590 && range == 1000);
}

int main(void)
{
	worn_nibs_are_found();
	healthy_nibs_are_left_alone();
	more_than_half_is_a_fault();
	return test_end();
}
