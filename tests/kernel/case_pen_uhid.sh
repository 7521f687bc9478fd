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
grep -q '^# display' "$folder/recorded" && fail "a tablet for the desk is taken for a display"

# The same with a Cintiq's ids: its model is a display.
sed '/^I:.*28bd/s/.*/I: 3 056a 00fa/; /^# [^k]/d' "$folder/tape" >"$folder/cintiq"
record
"$tools/play" "$folder/cintiq" --speed 4 || fail "the display's pen could not be played"
record_stop
grep -q '^# display 0$' "$folder/recorded" || fail "a display is not known as one"
finish
