#!/bin/sh
# a tablet that is a keyboard too: its pen is read, and what is typed is not
. tests/kernel/guest.sh

keyboard="05 01 09 06 a1 01 85 05 05 07 19 e0 29 e7 15 00 25 01 75 01 95 08 81 02 75 08 95 01 81 03 \
95 06 75 08 15 00 25 65 19 00 29 65 81 00 c0"
cut_tape 0 4 | awk -v keyboard="$keyboard" '
  /^D:/ { device = $2 }
  /^R:/ && device == 0 { $2 += split(keyboard, key, " "); print $0, keyboard; next }
  /^E:/ && ++count % 100 == 0 { print "E:", $2, "9 05 00 00 04 00 00 00 00 00" }
  { print }' >"$folder/tape"
record
"$tools/play" "$folder/tape" &
player=$!
keyboard() {
  cat /sys/class/input/event*/device/name | grep -q Keyboard
}
wait_for 5 keyboard || fail "the kernel sees no keyboard"
wait $player || fail "the tablet could not be played"
record_stop
reports 0 <"$folder/tape" | grep -c '^9 05' | grep -q '^7$' || fail "not seven keys were typed"
{
  reports 0 <"$folder/tape" | grep -v '^9 05'
  echo unplug
} >"$folder/sent"
reports 0 <"$folder/recorded" | cmp "$folder/sent" - || fail "other reports came than the pen's"
finish
