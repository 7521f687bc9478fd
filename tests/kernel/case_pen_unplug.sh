#!/bin/sh
# a pen unplugged in mid-stroke and plugged in again: the stroke ends, the next visitor's outline is whole
. tests/kernel/guest.sh

{
  cut_tape 0 3
  echo '# unplug 0 at 000003.000000'
  echo 'D: 0'
  cut_tape 0 7.6 | sed -n '/^E:/p' | later 4
} >"$folder/tape"
station
record
"$tools/play" "$folder/tape" || fail "the pen could not be played"
sleep 1
station_stop
record_stop
{
  reports 0 <"$folder/tape"
  echo unplug
} >"$folder/sent"
reports 0 <"$folder/recorded" | cmp "$folder/sent" - || fail "other reports came than were sent"
same_edits "$folder/tape"
[ "$(grep -c '^piece ' "$out"/journals/*.kitsuke)" = 1 ] || fail "not one piece was drawn"
finish
