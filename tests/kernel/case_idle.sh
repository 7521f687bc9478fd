#!/bin/sh
# a visitor leaves: after the board's three minutes the next visit begins (time travels)
# kernel: time-travel=inf-cpu
. tests/kernel/guest.sh

if afterwards; then
  visit_replays
  finish
fi

visits() {
  [ "$(ls "$out/journals" | grep -c '[.]kitsuke$')" = "$1" ]
}

printf 'threads = 1\n' >"$folder/board"
cut_tape 0 7.6 >"$folder/tape"
station --board "$folder/board"
wait_for 30 "$tools/screen" mode || fail "the display stays dark"
"$tools/play" "$folder/tape" --speed 4 || fail "the pen could not be played"
wait_for 10 journal_has '^piece ' || fail "no piece was drawn"
# nothing is drawn while nobody can see it, and three minutes cost little
echo off >/sys/class/drm/card0-Virtual-1/status
echo change >/sys/class/drm/card0/uevent
sleep 170
visits 1 || fail "the visit ended too early"
sleep 15
visits 2 || fail "no new visit after three minutes"
station_stop
grep -L "^piece " "$out"/journals/*.kitsuke | grep -q . || fail "the new visit begins with the old one's piece"
finish
