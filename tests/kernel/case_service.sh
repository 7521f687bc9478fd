#!/bin/sh
# all three buttons held for five seconds: the page opens, and no pen on it reaches the visit (time travels)
# kernel: time-travel=inf-cpu
. tests/kernel/guest.sh

if afterwards; then
  finish
fi

chip_add buttons wrap pin relax
printf 'threads = 1\n' >"$folder/board"
cut_tape 0 7.6 >"$folder/tape"
station --board "$folder/board"
wait_for 30 "$tools/screen" mode || fail "the display stays dark"
sleep 1
for button in 0 1 2; do press $button; done
expect 15 'service: display: a picture' "$out/station"
for button in 0 1 2; do release $button; done
"$tools/play" "$folder/tape" --speed 4 || fail "the pen could not be played"
sleep 1
journal_has '^piece ' && fail "what the pen did on the page reached the visit"
# nobody moves the pen: the page closes by itself, and then a pen draws as ever
echo off >/sys/class/drm/card0-Virtual-1/status
echo change >/sys/class/drm/card0/uevent
expect 200 'service: the page is closed' "$out/station"
"$tools/play" "$folder/tape" --speed 4 || fail "the pen could not be played again"
wait_for 10 journal_has '^piece ' || fail "after the page no piece could be drawn"
station_stop
finish
