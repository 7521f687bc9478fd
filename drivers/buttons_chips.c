/* The GPIO chips of this machine, and which of our lines each of them has. */
#include "buttons.h"

#include <dirent.h>
#include <gpiod.h>
#include <stdio.h>
#include <stdlib.h>

static void chip_describe(struct gpiod_chip *chip, const struct board *board,
			  struct buttons_chip *found)
{
	struct gpiod_chip_info *info = gpiod_chip_get_info(chip);
	if (info) {
		snprintf(found->name, sizeof found->name, "%s", gpiod_chip_info_get_name(info));
		snprintf(found->label, sizeof found->label, "%s", gpiod_chip_info_get_label(info));
		found->line_count = (int)gpiod_chip_info_get_num_lines(info);
		gpiod_chip_info_free(info);
	}
	for (int i = 0; i < BUTTON_COUNT; i++)
		found->offset[i] = board->button_line[i][0] ? gpiod_chip_get_line_offset_from_name(
								      chip, board->button_line[i])
							    : -1;
}

static int by_name(const void *a, const void *b)
{
	return strcmp(((const struct buttons_chip *)a)->path,
		      ((const struct buttons_chip *)b)->path);
}

int buttons_chips_find(const struct board *board, struct buttons_chip *chips, int capacity,
		       int *refused)
{
	int count = 0;
	*refused = 0;
	DIR *folder = opendir("/dev");
	if (!folder)
		return 0;
	for (struct dirent *entry; count < capacity && (entry = readdir(folder));) {
		struct buttons_chip *found = &chips[count];
		if (strncmp(entry->d_name, "gpiochip", 8) || strlen(entry->d_name) > 40)
			continue;
		*found = (struct buttons_chip){0};
		snprintf(found->path, sizeof found->path, "/dev/%.40s", entry->d_name);
		if (!gpiod_is_gpiochip_device(found->path))
			continue;
		struct gpiod_chip *chip = gpiod_chip_open(found->path);
		*refused += chip ? 0 : 1;
		if (!chip)
			continue;
		chip_describe(chip, board, found);
		gpiod_chip_close(chip);
		count++;
	}
	closedir(folder);
	qsort(chips, (size_t)count, sizeof *chips, by_name);
	return count;
}
