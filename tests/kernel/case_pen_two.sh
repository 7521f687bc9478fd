#!/bin/sh
# two tablets at a time: both are read, and one visitor's stroke is not cut by the other's
. tests/kernel/guest.sh

{
  cut_tape 0 7.6
  cut_tape 3 5 | as_device 2 'Second Pen' | later 0.0025
} >"$folder/mixed"
# events in order of time, each under its device
{
  grep '^#' "$folder/mixed"
  awk '/^[^E#]/ { print }' "$folder/mixed"
  awk '/^D:/ { device = $2 } /^E:/ { print $2, device, $0 }' "$folder/mixed" | sort -s -k 1,1 |
    awk '{ print "D: " $2; sub(/^[^E]*/, ""); print }'
} >"$folder/tape"
record
"$tools/play" "$folder/tape" || fail "the pens could not be played"
record_stop
for device in 0 2; do
  reports $device <"$folder/tape" >"$folder/sent"
  echo unplug >>"$folder/sent"
  reports $((device / 2)) <"$folder/recorded" | cmp "$folder/sent" - || fail "device $device sent other reports"
done
station
"$tools/play" "$folder/tape" || fail "the pens could not be played"
sleep 1
station_stop
same_edits "$folder/tape"
finish
