#!/bin/sh
# no display card at the start, then one that belongs to another program: the picture comes with it
# kernel: time-travel=inf-cpu
. tests/kernel/guest.sh

mv /dev/dri/card0 /dev/away
"$kitsuke" --journals "$out/journals" 2>"$out/station"
status=$?
[ $status = 3 ] || fail "without a card the station ended with status $status"
grep -q '/dev/dri/card' "$out/station" || fail "it does not say what is missing"
supervise
sleep 1
mv /dev/away /dev/dri/card0
echo add >/sys/class/drm/card0/uevent
wait_for 20 "$tools/screen" mode || fail "the card came, and no picture"
shown "$out/card.png"
station_stop

"$tools/screen" hold >"$folder/held" &
holder=$!
expect 5 held "$folder/held"
supervise
expect 30 'belongs to another program' "$out/station"
kill -0 $holder || fail "the display's master was robbed"
"$tools/screen" mode && fail "there is a picture without a master"
kill $holder
wait_for 20 "$tools/screen" mode || fail "the display is free, and no picture"
shown "$out/free.png"
station_stop
finish
