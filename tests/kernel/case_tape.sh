#!/bin/sh
# the bundled visit through uhid and gpio-sim: the shirt is on the body; recorded, it replays to the same bits
# seconds: 400
# kernel: time-travel=inf-cpu
. tests/kernel/guest.sh

if afterwards; then
  # Frames are the wall's here, so the hash is not the tape's; the visit is.
  same_edits "$tape"
  visit_replays
  played=$("$kitsuke" dress "$out"/journals/*.kitsuke --report "$out/report.json" --threads 1) ||
    fail "the journal can't be played"
  case "$played" in *"$hash"*) ;; *) fail "the journal makes $played, the visit was $hash" ;; esac
  for fact in '"head_through_collar": true' '"arms_in_sleeves": 2' '"edge_crossings_body": 0'; do
    grep -q "$fact" "$out/report.json" || fail "the report does not say $fact"
  done
  finish
fi

printf 'budget = 6000000\nthreads = 1\n' >"$folder/board"
chip_add buttons wrap pin relax
station --board "$folder/board"
shown "$out/empty.png"
"$tools/play" "$tape" "$chip" || fail "the tape could not be played"
shown "$out/worn.png"
station_stop
finish
