#!/bin/sh
# a pen unplugged in mid-stroke and plugged in again: the stroke ends, the next visitor's outline is whole
# seconds: 300
# kernel: time-travel=inf-cpu
. tests/kernel/guest.sh

if afterwards; then
  same_edits "$out/tape"
  visit_replays
  finish
fi

{
  cut_tape 2 3
  echo '# unplug 0 at 000003.000000'
  echo 'D: 0'
  cut_tape 4 6 | grep '^E:'
} >"$folder/short"
record
"$tools/play" "$folder/short" || fail "the pen could not be played"
record_stop
{
  reports 0 <"$folder/short"
  echo unplug
} >"$folder/sent"
reports 0 <"$folder/recorded" | cmp "$folder/sent" - || fail "other reports came than were sent"

{
  cut_tape 0 2
  echo '# unplug 0 at 000002.000000'
  echo 'D: 0'
  cut_tape 0 7.6 | grep '^E:' | later 2
} >"$out/tape"
station
"$tools/play" "$out/tape" || fail "the pen could not be played"
sleep 1
station_stop
[ "$(grep -c '^piece ' "$out"/journals/*.kitsuke)" = 1 ] || fail "not one piece was drawn"
finish
