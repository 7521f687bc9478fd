#!/bin/sh
# the screen is unplugged and plugged in again while the station runs
# kernel: time-travel=inf-cpu
. tests/kernel/guest.sh

screen() {
  echo "$1" >/sys/class/drm/card0-Virtual-1/status
  echo change >/sys/class/drm/card0/uevent
}

dark() {
  ! "$tools/screen" mode
}

station
shown "$out/before.png"
screen off
wait_for 10 dark || fail "the display is still lit"
screen detect
wait_for 20 "$tools/screen" mode || fail "the picture does not come back"
shown "$out/after.png"
"$tools/screen" alike "$out/before.png" "$out/after.png" || fail "it is another picture"
station_stop
finish
