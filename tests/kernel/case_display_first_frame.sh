#!/bin/sh
# the first picture on KMS: what the display gets is what was drawn, and what a replay draws
. tests/kernel/guest.sh

if afterwards; then
  # A visit in which nothing happens.
  {
    cut_tape 0 0 | sed 's/^# board .*/# board 640 360/'
    printf 'D: 1\nE: 000001.000000 1 00\n'
  } >"$folder/empty"
  LIBGL_ALWAYS_SOFTWARE=1 "$kitsuke" replay "$folder/empty" --out "$folder/replayed" --pictures-every 60 >/dev/null ||
    fail "the empty tape can't be played"
  cp "$folder/replayed"/frame-000060.png "$out/drawn.png"
  "$tools/screen" alike "$out/shown.png" "$out/drawn.png" || fail "the replay draws another picture"
  finish
fi

station
wait_for 20 "$tools/screen" mode || fail "the display stays dark"
[ "$("$tools/screen" mode)" = "640 x 360" ] || fail "the mode is $("$tools/screen" mode)"
shown "$out/shown.png"
sleep 1
station_stop
"$tools/screen" mode && fail "the display is not dark after the station's end"
finish
