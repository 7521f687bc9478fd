#!/bin/sh
# two tablets at a time: both are read, and one visitor's stroke is not cut by the other's
# kernel: time-travel=inf-cpu
. tests/kernel/guest.sh

if afterwards; then
  same_edits "$out/tape"
  visit_replays
  finish
fi

# mixed FROM: two pens' reports in order of time, each under its device. Both lie there from the
# start; the second comes near while the first draws.
mixed() {
  {
    cut_tape "$1" 7.6
    echo 'D: 0'
    echo 'E: 000000.100000 10 02 00 2f 77 f0 67 00 00 00 00'
    cut_tape 4 5 | as_device 2 'Second Pen' | later 0.0025
    echo 'E: 000000.200000 10 02 00 2f 77 f0 67 00 00 00 00'
  } >"$folder/mixed"
  grep '^#' "$folder/mixed"
  awk '/^[^E#]/ { print }' "$folder/mixed"
  awk '/^D:/ { device = $2 } /^E:/ { print $2, device, $0 }' "$folder/mixed" | sort -s -k 1,1 |
    awk '{ print "D: " $2; sub(/^[^E]*/, ""); print }'
}

mixed 3.5 >"$folder/short"
record
"$tools/play" "$folder/short" || fail "the pens could not be played"
record_stop
for device in 0 2; do
  reports $device <"$folder/short" >"$folder/sent"
  echo unplug >>"$folder/sent"
  reports $((device / 2)) <"$folder/recorded" | cmp "$folder/sent" - || fail "device $device sent other reports"
done

mixed 0 >"$out/tape"
station
"$tools/play" "$out/tape" || fail "the pens could not be played"
sleep 1
station_stop
finish
