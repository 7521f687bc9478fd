# What the kernel bench's cases share: `. tests/kernel/guest.sh`; they end with `finish`.
#
# $kitsuke is the station as it was built, $tools the bench's own programs, $out a folder that the
# host sees, $folder one that it doesn't. What needs no device is done `afterwards`, on the host:
# everything costs several times as much in here.
kitsuke=$BENCH_KITSUKE
tools=$BENCH_TOOLS
out=${BENCH_AFTER:-/run/out}
folder=${BENCH_AFTER:-/run/tmp}
tape=tests/tapes/tshirt.hid
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

afterwards() {
  [ -n "${BENCH_AFTER:-}" ]
}

finish() {
  [ $failures = 0 ]
  exit
}

# wait_for SECONDS COMMAND...: until it succeeds.
wait_for() {
  tries=$(($1 * 5))
  shift
  while ! "$@" >/dev/null 2>&1; do
    tries=$((tries - 1))
    [ $tries -gt 0 ] || return 1
    sleep 0.2
  done
}

# expect SECONDS PATTERN FILE: a line of the file comes to match.
expect() {
  wait_for "$1" grep -q -e "$2" "$3" || fail "no \"$2\" in $3 within $1 s"
}

# ---- tapes ----

# cut_tape FROM TO: the bundled tape's head and what it holds between two times in seconds, pen only.
cut_tape() {
  awk -v from="$1" -v to="$2" '
    /^D:/ { device = $2 }
    /^E:/ { if (device == 0 && $2 >= from && $2 < to) print; next }
    !/^# frames/ { print }' "$tape"
}

# later SECONDS: the same events, later; on stdin.
later() {
  awk -v by="$1" '/^E:/ { $2 = sprintf("%013.6f", $2 + by) } { print }'
}

# as_device NUMBER NAME: a tape of one device with another number and name; on stdin.
as_device() {
  sed "/^# /d; /^D: 1/,/^I:/d; s/^D: .*/D: $1/; s/^N: .*/N: $2/"
}

# edits FILE...: the words of a journal's edits that don't depend on frames, with their counts.
edits() {
  sed -n 's/^\(piece\|copy\|sew\|mark-body\|mark-cloth\|wrap\|pin\|relax\) .*/\1/p' "$@" | sort | uniq -c
}

# same_edits TAPE: the station's journal has the edits that a replay of the tape makes.
same_edits() {
  "$kitsuke" replay "$1" --out "$folder/replayed" --no-pictures >/dev/null || fail "$1 can't be played"
  edits "$folder/replayed/journal.kitsuke" >"$folder/wanted"
  edits "$out"/journals/*.kitsuke | diff "$folder/wanted" - || fail "the visit has other edits than the tape"
}

# visit_replays: the tape that the station recorded of its one visit replays to its journal, byte for
# byte, and to the state that it had at the end. The replay lies in $folder/again.
visit_replays() {
  recorded=$(ls "$out"/journals/*.hid) || fail "the visit was not recorded"
  again=$("$kitsuke" replay "$recorded" --out "$folder/again" --no-pictures | sed 's/^hash \([0-9a-f]*\).*/\1/')
  cmp "${recorded%.hid}.kitsuke" "$folder/again/journal.kitsuke" || fail "the visit's tape makes another journal"
  hash=$(sed -n 's/^# hash //p' "$recorded")
  [ -n "$hash" ] && [ "$again" = "$hash" ] || fail "the visit's tape replays to $again, the visit was $hash"
}

# reports DEVICE: what a tape's device sent, a line a report, on stdin.
reports() {
  awk -v wanted="$1" '
    /^D:/ { device = $2 }
    /^E:/ && device == wanted { sub(/^E: [0-9.]* /, ""); print }
    /^# unplug/ && $3 == wanted { print "unplug" }'
}

# ---- buttons ----

# chip NAME LINE...: a GPIO chip with these lines, released; a pressed button pulls its line down.
# $chip is then the folder with a folder sim_gpioN for each line.
chip_add() {
  config=/sys/kernel/config/gpio-sim/$1
  shift
  mkdir -p "$config/bank"
  echo $# >"$config/bank/num_lines"
  line=0
  for name in "$@"; do
    mkdir "$config/bank/line$line"
    echo "$name" >"$config/bank/line$line/name"
    line=$((line + 1))
  done
  chip_plug "$config"
}

chip_plug() {
  echo 1 >"$1/live"
  chip=/sys/devices/platform/$(cat "$1/dev_name")/$(cat "$1/bank/chip_name")
  for pull in "$chip"/sim_gpio*/pull; do
    echo pull-up >"$pull"
  done
}

press() {
  echo pull-down >"$chip/sim_gpio$1/pull"
}

release() {
  echo pull-up >"$chip/sim_gpio$1/pull"
}

# ---- the station ----

# station ARGUMENT...: starts it; its journals and tapes lie in $out/journals, its words in
# $out/station.
station() {
  "$kitsuke" record --visits --journals "$out/journals" "$@" >>"$out/station" 2>&1 &
  station=$!
  expect 60 'tablet\|HID device' "$out/station"
}

# supervise ARGUMENT...: starts the station again whenever the machine was at fault, as its service
# manager does.
supervise() {
  while :; do
    "$kitsuke" --journals "$out/journals" "$@" >>"$out/station" 2>&1 &
    echo $! >"$folder/station"
    wait $!
    status=$?
    [ $status = 3 ] || exit $status
    sleep 0.5
  done &
  supervisor=$!
}

# shown PNG: the display comes to show a picture, and it is the one that the station drew.
shown() {
  [ -z "${supervisor:-}" ] || station=$(cat "$folder/station")
  wait_for 60 "$tools/screen" capture "$station" "$1" ||
    fail "the display shows no picture of the station's: $("$tools/screen" capture "$station" "$1" 2>&1)"
}

station_stop() {
  kill "$station" 2>/dev/null
  wait "${supervisor:-$station}"
  status=$?
  supervisor=
  [ $status = 0 ] || fail "the station ended with status $status: $(tail -n 3 "$out/station")"
}

journal_has() {
  cat "$out"/journals/*.kitsuke 2>/dev/null | grep -q -e "$1"
}

record() {
  "$kitsuke" record --out "$folder/recorded" "$@" 2>"$out/record" &
  record=$!
  expect 30 buttons "$out/record"
}

record_stop() {
  kill "$record"
  wait "$record" || fail "record ended with status $?: $(tail -n 3 "$out/record")"
  cp "$folder/recorded" "$out/recorded"
}

# ---- a pen on the USB ----

# usb_plug TAPE OPTION...: plugs it in; usb_go lets it play.
usb_plug() {
  mkfifo "$folder/go"
  "$tools/usb_pen" "$@" <"$folder/go" >"$out/pen" 2>&1 &
  pen=$!
  exec 9>"$folder/go"
}

usb_go() {
  echo >&9
  exec 9>&-
}
