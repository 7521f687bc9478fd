#!/bin/sh
# a pen plugged in and pulled out in mid-stroke 20 times: each stroke is whole, nothing is held that was not before
. tests/kernel/guest.sh

if afterwards; then
  reports 0 <"$out/recorded" | cmp "$out/sent" - || fail "other reports came than were sent"
  for what in 'read' 'let go'; do
    sed -n "s/^device 0: $what after //p" "$out/played" | sort -n |
      awk -v what="$what" '{ ms[NR] = $1 } END { printf "%s: %d times, median %s ms, at most %s ms\n",
        what, NR, ms[int((NR + 1) / 2)], ms[NR]; exit NR != 20 }' || fail "it was not $what 20 times"
  done
  finish
fi

# What the recorder has of the system: open files, and its own memory in kB.
held() {
  echo "$(ls "/proc/$record/fd" | wc -l) $(sed -n 's/^VmData:[^0-9]*\([0-9]*\).*/\1/p' "/proc/$record/status")"
}

# Once for what is made on first use.
{
  cut_tape 0 0.8
  echo '# unplug 0 at 000000.900000'
} >"$folder/once"
cut_tape 0.5 0.8 >"$folder/stroke"
{
  grep -v '^E:' "$folder/stroke"
  echo 'D: 0'
  for cycle in 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19; do
    grep '^E:' "$folder/stroke" | later "$(awk "BEGIN { print 0.32 * $cycle }")"
    awk "BEGIN { printf \"# unplug 0 at %013.6f\\n\", 0.81 + 0.32 * $cycle }"
  done
} >"$folder/cycles"
record
"$tools/play" "$folder/once" >/dev/null || fail "the pen could not be played once"
before=$(held)
"$tools/play" "$folder/cycles" >"$out/played" || fail "the pen could not be played"
after=$(held)
record_stop
cat "$folder/once" "$folder/cycles" | reports 0 >"$out/sent"
echo "held before: $before, after: $after"
[ "${before% *}" = "${after% *}" ] || fail "descriptors were $before, are $after"
[ "${after#* }" -le $((${before#* } + 64)) ] || fail "memory was $before kB, is $after kB"
finish
