#!/bin/sh
# a pen that must be asked: its strings by libusb, its maker's protocol by hidraw, on the tape with both
. tests/kernel/guest.sh

# The vendor interface of a UC-Logic 2 tablet: report 8 of 12 opaque bytes; it hovers, draws, leaves.
{
  echo 'D: 0'
  echo 'R: 23 06 00 ff 09 01 a1 01 85 08 09 01 15 00 26 ff 00 75 08 95 0b 81 02 c0'
  echo 'N: Tablet of two minds'
  echo 'P: bench'
  echo 'I: 3 256c 006d'
  echo 'E: 000000.000000 12 08 80 70 46 06 3c 00 00 00 00 00 00'
  awk 'BEGIN { for (i = 1; i <= 50; i++)
    printf "E: %013.6f 12 08 81 %02x 46 06 3c ff 0f 00 00 f6 0a\n", i * 0.02, i }'
  echo 'E: 000001.100000 12 08 00 70 46 06 3c 00 00 00 00 00 00'
} >"$folder/tape"
record
# Firmware and parameters: 50800 x 31750 units, 8192 levels, 5080 lines an inch.
usb_plug "$folder/tape" --string 201 1403480055004900 --mute-until 200 \
  --string 200 120370c600067c00ff1fd81303000c000000
expect 10 'device 0 is Kernel bench Tablet of two minds' "$out/record"
"$kitsuke" devices >"$out/devices"
grep -q 'path        UC-Logic 2 (Huion, Gaomon), by the shape' "$out/devices" ||
  fail "kitsuke devices does not tell its path: $(cat "$out/devices")"
usb_go
wait "$pen" || fail "the pen could not be played: $(cat "$out/pen")"
expect 5 'device 0 was unplugged' "$out/record"
record_stop
grep -q 'asked for string 201' "$out/pen" && grep -q 'asked for string 200' "$out/pen" ||
  fail "it was not asked: $(cat "$out/pen")"
grep -q '^# vendor 0 uclogic-2 50800 31750 8191$' "$folder/recorded" || fail "the tape has no protocol"
grep -q '^# tablet 0 254.00 158.75$' "$folder/recorded" || fail "the tape has no size"
touches=$("$kitsuke" replay --samples "$folder/recorded" | grep -c '"touch"')
[ "$touches" = 50 ] || fail "$touches samples of 50 touch"
cat "$out/pen"
finish
