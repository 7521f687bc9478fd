/* What a tablet's answers mean: parameter blocks, and the model where there is none; see
 * pen_identify.h. */
#include "pen_identify.h"

#include <stdio.h>

/* --- models ----------------------------------------------------------------------------------- */

/* A string descriptor as printable characters; what is none becomes a question mark. */
static void answer_text(const uint8_t *bytes, int size, char text[64])
{
	int length = 0;
	for (int i = 2; i + 1 < size && length < 63; i += 2)
		text[length++] = !bytes[i + 1] && bytes[i] >= 32 && bytes[i] < 127 ? (char)bytes[i]
										   : '?';
	text[length] = 0;
}

static const uint8_t *answer_find(const struct pen_answers *answers, int string_index, int *size)
{
	for (int i = 0; i < answers->count; i++)
		if (answers->answer[i].string_index == string_index) {
			*size = answers->answer[i].size;
			return answers->answer[i].bytes;
		}
	*size = 0;
	return NULL;
}

static bool words_said(const struct pen_model *model, const struct pen_answers *answers)
{
	char text[64];
	int size;
	const uint8_t *bytes = answer_find(answers, model->string_index, &size);
	answer_text(bytes, size, text);
	return bytes && strstr(text, model->words);
}

/* How well a row fits: 0 not at all, then by bytes, by words, by both. */
static int model_fit(const struct pen_model *model, const struct pen_recipe *recipe,
		     const struct pen_answers *answers)
{
	if (model->report_bytes && recipe->report_bytes &&
	    model->report_bytes != recipe->report_bytes)
		return 0;
	if (model->string_index && !words_said(model, answers))
		return 0;
	return 1 + (model->report_bytes > 0) + 2 * (model->string_index > 0);
}

static bool same_ranges(const struct pen_model *a, const struct pen_model *b)
{
	return a->x_maximum == b->x_maximum && a->y_maximum == b->y_maximum &&
	       a->pressure_maximum == b->pressure_maximum;
}

/* The row that fits best; NULL when there is none, or when two with other ranges fit as well. */
static const struct pen_model *model_find(const struct pen_identity *identity,
					  const struct pen_recipe *recipe,
					  const struct pen_answers *answers)
{
	const struct pen_model *best = NULL;
	int best_fit = 0;
	bool doubtful = false;
	for (int i = 0; i < pen_model_count; i++) {
		const struct pen_model *model = &pen_models[i];
		int fit = pen_model_is(model, identity, recipe->family)
				  ? model_fit(model, recipe, answers)
				  : 0;
		if (!fit || fit < best_fit)
			continue;
		doubtful = fit == best_fit && (doubtful || !same_ranges(model, best));
		best = model;
		best_fit = fit;
	}
	return doubtful ? NULL : best;
}

/* --- blocks ----------------------------------------------------------------------------------- */

/* Tablets that know no such string answer with their name, or with what lies behind it. */
static bool block_head(const uint8_t *bytes, int size, int least, char reason[160])
{
	bool text = size >= 4 && size % 2 == 0;
	if (size < least) {
		snprintf(reason, 160, "%d bytes, a parameter block has %d or more", size, least);
		return false;
	}
	if (bytes[1] != 3 || bytes[0] != size) {
		snprintf(reason, 160, "no string: its head says type %d, %d bytes", bytes[1],
			 bytes[0]);
		return false;
	}
	for (int i = 2; i + 1 < size; i += 2)
		text &= bytes[i] >= 32 && bytes[i] < 127 && !bytes[i + 1];
	if (text)
		snprintf(reason, 160, "text, and no parameter block");
	return !text;
}

static bool block_believable(const struct pen_block *block, char reason[160])
{
	int lines = block->lines_per_inch;
	bool sized = lines >= 100 && block->x_maximum >= lines && block->y_maximum >= lines / 2 &&
		     block->x_maximum / lines < 40 && block->y_maximum / lines < 40;
	bool believable = sized && block->pressure_maximum >= 255;
	if (!believable)
		snprintf(reason, 160, "%d x %d units at %d an inch with %d levels are no tablet",
			 block->x_maximum, block->y_maximum, lines, block->pressure_maximum);
	return believable;
}

bool pen_block_1_read(const uint8_t *bytes, int size, struct pen_block *block, char reason[160])
{
	if (!block_head(bytes, size, 12, reason))
		return false;
	*block = (struct pen_block){pen_le16(bytes + 2), pen_le16(bytes + 4), pen_le16(bytes + 8),
				    pen_le16(bytes + 10)};
	return block_believable(block, reason);
}

bool pen_block_2_read(const uint8_t *bytes, int size, struct pen_block *block, char reason[160])
{
	if (!block_head(bytes, size, 18, reason))
		return false;
	*block = (struct pen_block){pen_le24(bytes + 2), pen_le24(bytes + 5), pen_le16(bytes + 8),
				    pen_le16(bytes + 10)};
	return block_believable(block, reason);
}

/* --- answers ---------------------------------------------------------------------------------- */

typedef bool block_reader(const uint8_t *bytes, int size, struct pen_block *block,
			  char reason[160]);

static bool block_answered(const struct pen_answers *answers, int string_index, block_reader *read,
			   struct pen_block *block, char reason[160])
{
	char why[160] = "no answer";
	int size;
	const uint8_t *bytes = answer_find(answers, string_index, &size);
	if (bytes && read(bytes, size, block, why))
		return true;
	snprintf(reason, 160, "string %d: %.120s", string_index, why);
	return false;
}

/* One firmware tells the second protocol's block and speaks the first. */
static bool firmware_between(const struct pen_answers *answers)
{
	char text[64];
	int size;
	const uint8_t *bytes = answer_find(answers, 201, &size);
	answer_text(bytes, size, text);
	return bytes && !strcmp(text, "HUION_T153_160607");
}

static void block_take(const struct pen_block *block, struct pen_vendor *vendor, float *width_mm,
		       float *height_mm)
{
	float mm = 25.4f / (float)block->lines_per_inch;
	vendor->x_maximum = block->x_maximum;
	vendor->y_maximum = block->y_maximum;
	vendor->pressure_maximum = block->pressure_maximum;
	*width_mm = (float)block->x_maximum * mm;
	*height_mm = (float)block->y_maximum * mm;
}

static bool end_uclogic(const struct pen_recipe *recipe, const struct pen_answers *answers,
			struct pen_vendor *vendor, float *width_mm, float *height_mm,
			char reason[160])
{
	struct pen_block block;
	char second[160];
	bool between = firmware_between(answers);
	vendor->family = recipe->family;
	if (!between && block_answered(answers, 200, pen_block_2_read, &block, second)) {
		block_take(&block, vendor, width_mm, height_mm);
		return true;
	}
	if (!block_answered(answers, 100, pen_block_1_read, &block, reason)) {
		size_t used = strlen(reason);
		if (!between && used < 159)
			snprintf(reason + used, 160 - used, "; %.100s", second);
		return false;
	}
	vendor->family = PEN_UCLOGIC_1;
	block_take(&block, vendor, width_mm, height_mm);
	return true;
}

static void model_take(const struct pen_model *model, struct pen_vendor *vendor, float *width_mm,
		       float *height_mm)
{
	vendor->x_maximum = model->x_maximum;
	vendor->y_maximum = model->y_maximum;
	vendor->pressure_maximum = model->pressure_maximum;
	*width_mm = (float)model->width_dmm / 10.0f;
	*height_mm = (float)model->height_dmm / 10.0f;
}

/* The block holds 16 bits of ranges that can have more; the model has all of them. */
static bool model_completes(const struct pen_model *model, const struct pen_block *block)
{
	return (model->x_maximum & 0xffff) == block->x_maximum &&
	       (model->y_maximum & 0xffff) == block->y_maximum;
}

static bool block_1_answered(const struct pen_answers *answers, struct pen_block *block)
{
	char reason[160];
	int size;
	const uint8_t *bytes = answer_find(answers, 100, &size);
	if (!bytes || !block_head(bytes, size, 12, reason))
		return false;
	bool believed = pen_block_1_read(bytes, size, block, reason);
	return believed || (block->lines_per_inch >= 100 && block->pressure_maximum >= 255);
}

static bool end_by_model(const struct pen_identity *identity, const struct pen_recipe *recipe,
			 const struct pen_answers *answers, struct pen_vendor *vendor,
			 float *width_mm, float *height_mm, char reason[160])
{
	struct pen_block block;
	const struct pen_model *model = model_find(identity, recipe, answers);
	bool told = recipe->family == PEN_UGEE_2 && block_1_answered(answers, &block);
	vendor->family = recipe->family;
	if (model && (!told || model_completes(model, &block))) {
		model_take(model, vendor, width_mm, height_mm);
		return true;
	}
	if (told && block_believable(&block, reason)) {
		block_take(&block, vendor, width_mm, height_mm);
		return true;
	}
	snprintf(reason, 160,
		 "%s, but it does not tell its ranges, and no single model %04x:%04x is known",
		 pen_family_rule(recipe->family)->name, (unsigned)identity->vendor,
		 (unsigned)identity->product);
	return false;
}

bool pen_identify_end(const struct pen_identity *identity, const struct pen_recipe *recipe,
		      const struct pen_answers *answers, struct pen_vendor *vendor, float *width_mm,
		      float *height_mm, char reason[160])
{
	bool sound = true;
	*vendor = (struct pen_vendor){0};
	*width_mm = *height_mm = 0.0f;
	if (recipe->family == PEN_BY_DESCRIPTOR)
		return true;
	if (recipe->family == PEN_UCLOGIC_1 || recipe->family == PEN_UCLOGIC_2)
		sound = end_uclogic(recipe, answers, vendor, width_mm, height_mm, reason);
	else
		sound = end_by_model(identity, recipe, answers, vendor, width_mm, height_mm,
				     reason);
	if (sound && !pen_vendor_sound(vendor)) {
		snprintf(reason, 160, "%d x %d units with %d levels are no tablet",
			 vendor->x_maximum, vendor->y_maximum, vendor->pressure_maximum);
		sound = false;
	}
	if (!sound)
		*vendor = (struct pen_vendor){0};
	return sound;
}
