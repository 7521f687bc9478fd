/* Text to float and back, without the C library's locale and rounding: journals must read the same
 * bits on every board. */
#include "journal.h"

enum { DIGITS_MAX = 18, SHORTEST_DIGITS_MAX = 9 };

/* Powers of ten up to 1e22 are exact in double. */
static const double power_of_ten[23] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
					1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
					1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

static double scale_by_ten(double value, int exponent)
{
	for (; exponent > 22; exponent -= 22)
		value *= power_of_ten[22];
	for (; exponent < -22; exponent += 22)
		value /= power_of_ten[22];
	return exponent >= 0 ? value * power_of_ten[exponent] : value / power_of_ten[-exponent];
}

static bool is_digit(char c)
{
	return c >= '0' && c <= '9';
}

/* Digits of mantissa; counts how far the point has moved. False: there was no digit. */
static bool read_mantissa(const char **text, const char *end, uint64_t *mantissa, int *exponent)
{
	const char *p = *text;
	bool any = false, point = false;
	int digits = 0;
	*mantissa = 0;
	*exponent = 0;
	for (; p < end && (is_digit(*p) || (*p == '.' && !point)); p++) {
		if (*p == '.') {
			point = true;
			continue;
		}
		any = true;
		if (digits < DIGITS_MAX) {
			*mantissa = *mantissa * 10 + (uint64_t)(*p - '0');
			digits += *mantissa > 0;
			*exponent -= point;
		} else {
			*exponent += !point && *exponent < 1000;
		}
	}
	*text = p;
	return any;
}

static void read_exponent(const char **text, const char *end, int *exponent)
{
	const char *p = *text;
	if (p >= end || (*p != 'e' && *p != 'E'))
		return;
	p++;
	bool negative = p < end && *p == '-';
	p += p < end && (*p == '-' || *p == '+');
	if (p >= end || !is_digit(*p))
		return;
	int value = 0;
	for (; p < end && is_digit(*p); p++)
		value = int_min(value * 10 + (*p - '0'), 9999);
	*exponent += negative ? -value : value;
	*text = p;
}

bool number_read(const char **text, const char *end, float *value)
{
	const char *p = *text;
	bool negative = p < end && *p == '-';
	p += p < end && (*p == '-' || *p == '+');
	uint64_t mantissa;
	int exponent;
	if (!read_mantissa(&p, end, &mantissa, &exponent))
		return false;
	read_exponent(&p, end, &exponent);
	double result = scale_by_ten((double)mantissa, int_clamp(exponent, -400, 400));
	if (!(result <= 3.4028234e38))
		return false;
	*value = (float)(negative ? -result : result);
	*text = p;
	return true;
}

/* The decimal digits of a positive value, `count` of them, with the exponent of the first. */
static uint64_t round_to_digits(double value, int count, int *exponent)
{
	int e = 0;
	for (double v = value; v >= 10.0 && e < 60; e++)
		v /= 10.0;
	for (double v = value; v < 1.0 && e > -60; e--)
		v *= 10.0;
	uint64_t digits = (uint64_t)(scale_by_ten(value, count - 1 - e) + 0.5);
	if ((double)digits >= power_of_ten[count]) {
		digits /= 10;
		e++;
	}
	*exponent = e;
	return digits;
}

static int write_int(char *out, int value)
{
	char reversed[12];
	int count = 0, size = 0;
	unsigned magnitude = value < 0 ? 0u - (unsigned)value : (unsigned)value;
	if (value < 0)
		out[size++] = '-';
	do {
		reversed[count++] = (char)('0' + magnitude % 10);
	} while ((magnitude /= 10) > 0);
	while (count > 0)
		out[size++] = reversed[--count];
	return size;
}

/* Plain notation for everyday sizes, an exponent for the rest. */
static int write_digits(char *out, bool negative, uint64_t digits, int count, int exponent)
{
	char text[DIGITS_MAX + 2];
	for (int i = count; i-- > 0; digits /= 10)
		text[i] = (char)('0' + digits % 10);
	while (count > 1 && text[count - 1] == '0')
		count--;
	int size = 0;
	if (negative)
		out[size++] = '-';
	if (exponent < -5 || exponent > 8) {
		out[size++] = text[0];
		if (count > 1)
			out[size++] = '.';
		for (int i = 1; i < count; i++)
			out[size++] = text[i];
		out[size++] = 'e';
		return size + write_int(out + size, exponent);
	}
	if (exponent < 0)
		out[size++] = '0';
	for (int place = int_min(exponent, 0) < 0 ? -1 : exponent;
	     place >= exponent - count + 1 || place >= 0; place--) {
		if (place == -1)
			out[size++] = '.';
		int i = exponent - place;
		out[size++] = i >= 0 && i < count ? text[i] : '0';
	}
	return size;
}

int number_write(char *out, float value)
{
	if (value == 0.0f) {
		out[0] = '0';
		out[1] = 0;
		return 1;
	}
	MUST(value - value == 0.0f); /* finite: edits are checked where they are made */
	double magnitude = value < 0.0f ? -(double)value : (double)value;
	int size = 0;
	for (int count = 1; count <= SHORTEST_DIGITS_MAX; count++) {
		int exponent;
		uint64_t digits = round_to_digits(magnitude, count, &exponent);
		size = write_digits(out, value < 0.0f, digits, count, exponent);
		const char *text = out;
		float back;
		if (number_read(&text, out + size, &back) && back == value)
			break;
	}
	out[size] = 0;
	return size;
}
