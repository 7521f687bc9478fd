/* The commands of the one binary. Each takes its own word as argv[0] and returns an exit status. */
#ifndef COMMANDS_H
#define COMMANDS_H

enum exit_status {
	STATUS_DONE,
	STATUS_INPUT,   /* the input is at fault; the message says where */
	STATUS_USAGE,   /* the command line is */
	STATUS_MACHINE, /* the machine is: no memory, disk full, no display */
};

int command_station(int argc, char **argv); /* no word: the station itself */
int command_replay(int argc, char **argv);
int command_dress(int argc, char **argv);
int command_import(int argc, char **argv);
int command_check(int argc, char **argv);
int command_record(int argc, char **argv);
int command_devices(int argc, char **argv);
int command_calibrate(int argc, char **argv);
int command_help(int argc, char **argv);

#endif
