/* kitsuke: the commands of the one binary; without one it is the station. */
#include "commands.h"

#include <stdio.h>
#include <string.h>

static const struct {
	const char *word;
	int (*run)(int argc, char **argv);
} commands[] = {
	{"replay", command_replay},       {"dress", command_dress},   {"check", command_check},
	{"import", command_import},       {"record", command_record}, {"devices", command_devices},
	{"calibrate", command_calibrate}, {"help", command_help},
};

int main(int argc, char **argv)
{
	if (argc == 2 && strcmp(argv[1], "--limits") == 0)
		return command_help(2, (char *[]){argv[0], "limits"});
	if (argc < 2 || (argv[1][0] == '-' && strcmp(argv[1], "--help") != 0))
		return command_station(argc, argv);
	for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
		if (strcmp(argv[1], commands[i].word) == 0)
			return commands[i].run(argc - 1, argv + 1);
	if (strcmp(argv[1], "--help") == 0)
		return command_help(1, argv);
	fprintf(stderr, "kitsuke: there is no command \"%s\"; `kitsuke help` lists them\n",
		argv[1]);
	return STATUS_USAGE;
}
