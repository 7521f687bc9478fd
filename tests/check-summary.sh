#!/bin/sh
# Adds up what tests/check-test.sh said of each stamp: tests/check-summary.sh STAMP...
# Fails when a test failed, was not even built, or when none ran.
results=$(for stamp in "$@"; do
  cat "$stamp.result" 2>/dev/null || echo "failed $(basename "$stamp" .ok): not built"
done)
count() {
  printf '%s\n' "$results" | grep -c "^$1"
}
printf '%s\n' "$results" | grep '^failed'
echo "$(count passed) passed, $(count failed) failed, $(count skip:) skipped"
[ "$(count failed)" = 0 ] && [ "$(count passed)" != 0 ]
