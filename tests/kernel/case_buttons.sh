#!/bin/sh
# buttons: bounce, one held from the start, the chip vanishes with one held and returns
. tests/kernel/guest.sh

chip_add buttons wrap pin relax
press 1
record
expect 5 'all lines found' "$out/record"

# A press that bounces for some milliseconds, and a release that does.
for bounce in 1 2 3 4 5 6; do press 0 && release 0; done
press 0
sleep 0.2
for bounce in 1 2 3 4 5 6; do release 0 && press 0; done
release 0
sleep 0.2

# The one that was held counts from its next press on.
release 1
sleep 0.1
press 1
sleep 0.1
release 1
sleep 0.1

press 2
sleep 0.1
echo 0 >"$config/live"
sleep 0.3
chip_plug "$config"
expect 5 '^# unplug 4' "$folder/recorded"
sleep 1.5
press 2
sleep 0.1
release 2
sleep 0.2
record_stop

printf '%s\n' '1 01' '1 00' '1 02' '1 00' '1 04' unplug '1 04' '1 00' >"$folder/wanted"
reports 4 <"$folder/recorded" | diff "$folder/wanted" - || fail "other presses came than were made"
finish
