#!/bin/sh
# Runs one test: tests/check-test.sh STAMP PROGRAM
#
# Exit status 0 is a pass, 77 a skip with its reason on the last line of stdout, anything else a
# failure, whose output is shown. STAMP is touched on a pass; STAMP.result keeps one line for the
# summary. Where CI=true and the shared test data is there, a skip is a failure: nothing may hide.
stamp=$1 program=$2
name=$(basename "$program")
log=$stamp.log
rm -f "$stamp"
begin=$(date +%s%N)
"$program" >"$log" 2>&1
status=$?
seconds=$(awk "BEGIN { printf \"%.1f\", ($(date +%s%N) - $begin) / 1e9 }")
if [ $status = 77 ]; then
  reason=$(tail -n 1 "$log" | sed 's/^skip: //')
  if [ "${CI:-}" = true ] && [ -d ../shared ]; then
    echo "failed $name: skipped although ../shared is there: $reason" | tee "$stamp.result"
    exit 1
  fi
  echo "skip: $name: $reason" | tee "$stamp.result"
  exit 0
fi
if [ $status != 0 ]; then
  tail -n 60 "$log"
  echo "failed $name: exit status $status after $seconds s" | tee "$stamp.result"
  exit 1
fi
echo "passed $name ($seconds s)" >"$stamp.result"
cat "$stamp.result"
touch "$stamp"
