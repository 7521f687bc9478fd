#!/bin/sh
# the watchdog is fed by frames; when the station hangs it starves, and the machine starts anew
. tests/kernel/guest.sh

# The second time that this machine starts is what the first has waited for.
if [ -e "$out/begun" ]; then
  [ -e "$out/fed" ] || fail "the watchdog bit a station that was alive"
  [ ! -e "$out/starved" ] || fail "the machine was not started by the watchdog"
  finish
fi
touch "$out/begun"
"$tools/keeper" 4 "$kitsuke" --journals "$out/journals" >"$out/keeper" 2>"$out/station" &
keeper=$!
expect 30 ready "$out/keeper"
sleep 8
kill -0 $keeper && touch "$out/fed"
for process in /proc/[0-9]*; do
  [ "$(readlink "$process/exe")" != "$kitsuke" ] || kill -STOP "${process#/proc/}"
done
sleep 10
touch "$out/starved"
fail "the station hangs, and the watchdog does not bite"
finish
