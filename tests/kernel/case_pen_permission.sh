#!/bin/sh
# a user who may not read the pen: told so with the remedy; mended while the program runs, it reads
# kernel: time-travel=inf-cpu
. tests/kernel/guest.sh

as_nobody="setpriv --reuid=65534 --regid=65534 --clear-groups"

cut_tape 0 2 >"$folder/tape"
mkdir -m 777 "$folder/nobody"
$as_nobody "$kitsuke" record --out "$folder/nobody/recorded" 2>"$out/record" &
record=$!
expect 30 buttons "$out/record"
"$tools/play" "$folder/tape" >"$out/played" 2>&1 &
player=$!
wait_for 5 test -e /dev/hidraw0 || fail "there is no pen"
[ "$(stat -c %a /dev/hidraw0)" = 600 ] || fail "anyone may read the pen"
sleep 2
$as_nobody "$kitsuke" devices >"$out/devices" 2>&1
grep -q 'permission denied' "$out/devices" || fail "kitsuke devices does not say what is missing: $(cat "$out/devices")"
grep -q 'is XP-Pen' "$out/record" && fail "the pen was read without permission"
# what the rule does that `kitsuke devices` gives
chmod 660 /dev/hidraw0 && chgrp 65534 /dev/hidraw0
wait "$player" || fail "the pen could not be played: $(cat "$out/played")"
mv "$folder/nobody/recorded" "$folder/recorded"
record_stop
reports 0 <"$folder/tape" >"$folder/sent"
reports 0 <"$folder/recorded" | grep -v unplug | cmp "$folder/sent" - || fail "other reports came than were sent"
finish
