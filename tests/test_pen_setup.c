/* Setting a tablet up to speak its maker's protocol, through a transport that stalls, cuts answers
 * short, answers too much or goes away; and that the shape of its descriptor decides. */
#include "pen_setup.h"
#include "shape_bytes.h"
#include "test.h"

struct fake {
	int silent, refused; /* so many transfers come to nothing, then all works */
	int error;
	bool short_answers, long_answers, stalls_all;
	int strings, outputs, features, last_output_size;
	uint8_t mode[2], output[64];
	uint8_t block[18];
	int stop_after; /* 0: never */
};

static int fault_now(struct fake *fake)
{
	if (fake->stalls_all)
		return fake->error;
	if (fake->silent-- > 0)
		return -PEN_SETUP_TIMEOUT;
	return fake->refused-- > 0 ? -PEN_SETUP_REFUSED : 0;
}

static int fake_string(void *context, int index, uint8_t *bytes, int capacity)
{
	struct fake *fake = context;
	int fault = fault_now(fake);
	fake->strings++;
	if (fault || fake->stalls_all)
		return fault;
	if (fake->long_answers) {
		memset(bytes, 0xff, (size_t)capacity);
		return 4 * capacity; /* a transport that lies */
	}
	if (index != 200)
		return -PEN_SETUP_REFUSED;
	int size = fake->short_answers ? 5 : 18;
	memcpy(bytes, fake->block, (size_t)size);
	return size;
}

static int fake_output(void *context, const uint8_t *bytes, int size)
{
	struct fake *fake = context;
	int fault = fault_now(fake);
	fake->outputs++;
	if (fault)
		return fault;
	memcpy(fake->output, bytes, (size_t)size);
	fake->last_output_size = size;
	return fake->short_answers ? size - 1 : size;
}

static int fake_feature(void *context, const uint8_t *bytes, int size)
{
	struct fake *fake = context;
	int fault = fault_now(fake);
	if (fault)
		return fault;
	if (++fake->features >= 2) /* takes it the second time */
		memcpy(fake->mode, bytes, (size_t)size);
	return size;
}

static int fake_feature_get(void *context, uint8_t *bytes, int size)
{
	struct fake *fake = context;
	memcpy(bytes, fake->mode, (size_t)size);
	return size;
}

static bool fake_stopped(void *context)
{
	const struct fake *fake = context;
	return fake->stop_after && fake->strings >= fake->stop_after;
}

static struct pen_setup_result set_up(struct fake *fake, struct shape_bytes *shape, int vendor,
				      int product)
{
	static const uint8_t block[18] = {18, 3,    0x70, 0xc6, 0,    6, 0x7c,
					  0,  0xff, 0x1f, 0xd8, 0x13, 3};
	struct pen_transport transport = {fake,         fake_string,      fake_output,
					  fake_feature, fake_feature_get, fake_stopped};
	struct pen_identity identity = {3,          vendor, product, "hid-generic", shape->bytes,
					shape->size};
	struct pen_setup_result result = {0};
	struct pen_recipe recipe;
	char reason[160];
	memcpy(fake->block, block, sizeof block);
	CHECK(pen_identify(&identity, &recipe, reason));
	pen_setup(&identity, &recipe, &transport, &result);
	CHECK(result.done || result.reason[0]);
	CHECK(result.done || result.vendor.family == PEN_BY_DESCRIPTOR);
	CHECK(result.tries <= 5 * PEN_STEPS_MAX);
	return result;
}

static void check_setup_strings(void)
{
	struct shape_bytes shape = {0};
	put_opaque(&shape, 0xff00, 1, 8, 12, 0);
	struct fake fake = {0};
	struct pen_setup_result r = set_up(&fake, &shape, 0x256c, 0x6d);
	CHECK(r.done && r.vendor.family == PEN_UCLOGIC_2 && r.vendor.x_maximum == 50800);
	CHECK_NEAR(r.width_mm, 254.0, 0.01);
	CHECK(fake.strings == 3 && fake.outputs == 0); /* 201, 200, 202, and no more */
	r = set_up(&fake, &shape, 0x256c, 0x6d);
	CHECK(r.done); /* once more does no harm */

	fake = (struct fake){.silent = 2}; /* 201 comes the third time */
	CHECK(set_up(&fake, &shape, 0x256c, 0x6d).done && fake.strings == 5);
	fake = (struct fake){.silent = 5}; /* 201 never, 200 the third time */
	CHECK(set_up(&fake, &shape, 0x256c, 0x6d).done);
	fake = (struct fake){.stalls_all = true, .error = -PEN_SETUP_TIMEOUT};
	CHECK(!set_up(&fake, &shape, 0x256c, 0x6d).done && fake.strings == 15);
	fake = (struct fake){.stalls_all = true, .error = -PEN_SETUP_REFUSED};
	CHECK(!set_up(&fake, &shape, 0x256c, 0x6d).done && fake.strings == 5);
	fake = (struct fake){.stalls_all = true, .error = -PEN_SETUP_GONE};
	r = set_up(&fake, &shape, 0x256c, 0x6d);
	CHECK(!r.done && r.gone && fake.strings == 1);
	fake = (struct fake){.short_answers = true};
	CHECK(!set_up(&fake, &shape, 0x256c, 0x6d).done);
	fake = (struct fake){.long_answers = true};
	CHECK(!set_up(&fake, &shape, 0x256c, 0x6d).done);
	fake = (struct fake){.stop_after = 1};
	r = set_up(&fake, &shape, 0x256c, 0x6d);
	CHECK(!r.done && strstr(r.reason, "went away"));
	fake = (struct fake){.stalls_all = true, .error = 0}; /* nothing, and no error */
	CHECK(!set_up(&fake, &shape, 0x256c, 0x6d).done);
}

static void check_setup_bytes(void)
{
	struct shape_bytes ugee = {0}, wacom = {0};
	struct fake fake = {0};
	put_opaque(&ugee, 0xff0a, 1, 2, 12, 20);
	struct pen_setup_result r = set_up(&fake, &ugee, 0x28bd, 0x0937);
	CHECK(r.done && r.vendor.family == PEN_UGEE_2 && r.vendor.x_maximum == 31998);
	CHECK(fake.last_output_size == 20 && !memcmp(fake.output, "\x02\xb0\x04\x00", 4));
	fake = (struct fake){.short_answers = true};
	r = set_up(&fake, &ugee, 0x28bd, 0x0937);
	CHECK(!r.done && strstr(r.reason, "02 b0 04") && fake.outputs == 3);
	fake = (struct fake){.silent = 2};
	CHECK(set_up(&fake, &ugee, 0x28bd, 0x0937).done);
	CHECK(!set_up(&fake, &ugee, 0x28bd, 0x7777).done); /* nobody knows its ranges */

	put_opaque(&wacom, 0x0d, 1, 2, 10, 0);
	fake = (struct fake){0};
	r = set_up(&fake, &wacom, 0x056a, 0x00b8);
	CHECK(r.done && r.vendor.family == PEN_INTUOS && fake.features == 2);
	/* an old one that tells no mode is read all the same */
	fake = (struct fake){.stalls_all = true, .error = -PEN_SETUP_REFUSED};
	CHECK(set_up(&fake, &wacom, 0x056a, 0x00b8).done);
}

/* Without the shape, vendor and product say nothing. */
static void check_shape_decides(void)
{
	struct pen_recipe recipe;
	char reason[160];
	struct pen_identity mouse = {3, 0x256c, 0x6d, "", mouse_descriptor, mouse_descriptor_size};
	CHECK(!pen_identify(&mouse, &recipe, reason) && reason[0]);
	struct shape_bytes shape = {0};
	put_opaque(&shape, 0xff00, 1, 8, 12, 0);
	struct pen_identity pen = {3, 0x256c, 0x6d, "uclogic", shape.bytes, shape.size};
	CHECK(!pen_identify(&pen, &recipe, reason) && strstr(reason, "uclogic"));
	pen.driver = "hid-generic";
	CHECK(pen_identify(&pen, &recipe, reason));
	pen.bus = 5;
	CHECK(!pen_identify(&pen, &recipe, reason) && strstr(reason, "USB"));
	pen.bus = 3;
	pen.descriptor_size--;
	CHECK(!pen_identify(&pen, &recipe, reason));
}

int main(void)
{
	check_setup_strings();
	check_setup_bytes();
	check_shape_decides();
	return test_end();
}
