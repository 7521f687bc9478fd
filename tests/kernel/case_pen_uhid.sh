#!/bin/sh
# a pen over uhid: it is named, every report is read, in order
. tests/kernel/guest.sh

cut_tape 0 4 >"$folder/tape"
record
"$tools/play" "$folder/tape" --speed 2 || fail "the pen could not be played"
record_stop
reports 0 <"$folder/tape" >"$folder/sent"
reports 0 <"$folder/recorded" | grep -v unplug >"$folder/came"
[ "$(wc -l <"$folder/sent")" -gt 500 ] || fail "the tape holds $(wc -l <"$folder/sent") reports"
cmp "$folder/sent" "$folder/came" ||
  fail "$(wc -l <"$folder/came") reports came of $(wc -l <"$folder/sent")"
grep -q '^N: XP-Pen Deco L Pen$' "$folder/recorded" || fail "the pen has lost its name"
grep -q '^I: [0-9a-f]* 28bd 0935$' "$folder/recorded" || fail "the pen has lost its ids"
finish
