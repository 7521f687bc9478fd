#!/bin/sh
# a pen on a USB host controller: named by its strings, read through usbhid, unplugged with the cable
. tests/kernel/guest.sh

cut_tape 0 4 >"$folder/tape"
record
usb_plug "$folder/tape"
expect 10 'device 0 is Kernel bench XP-Pen Deco L Pen' "$out/record"
"$kitsuke" devices >"$out/devices"
grep -q '28bd:0935  Kernel bench XP-Pen Deco L Pen, interface 0' "$out/devices" && grep -q 'driver      hid-generic' "$out/devices" ||
  fail "kitsuke devices does not name it: $(cat "$out/devices")"
usb_go
wait "$pen" || fail "the pen could not be played: $(cat "$out/pen")"
expect 5 'device 0 was unplugged' "$out/record"
record_stop
reports 0 <"$folder/tape" >"$folder/sent"
echo unplug >>"$folder/sent"
reports 0 <"$folder/recorded" | diff "$folder/sent" - | head -n 5
reports 0 <"$folder/recorded" | cmp -s "$folder/sent" - || fail "other reports came than were sent"
finish
