#!/bin/sh
# Runs every fuzzer for a while: tests/check-fuzz.sh BUILD SECONDS [FUZZER]
# What it finds new is kept in BUILD/corpus; a crashing input is named and kept beside it.
build=$1 seconds=$2

seeds() {
  case "$1" in
  fuzz_obj) echo ../shared/data/bad/obj ;;
  fuzz_garment*) echo ../shared/data/patterns/seams ../shared/data/bad/json ;;
  fuzz_tape) echo tests/tapes ;;
  fuzz_journal) echo tests/journals ;;
  fuzz_marks) echo tests/marks ../shared/data/patterns/seams ;;
  esac
}

one() {
  fuzzer=$1
  name=$(basename "$fuzzer")
  corpus=$build/corpus/$name
  mkdir -p "$corpus"
  folders=
  for folder in $(seeds "$name"); do
    [ -d "$folder" ] && folders="$folders $folder"
  done
  if "$fuzzer" -max_total_time="$seconds" -max_len=16384 -timeout=10 -rss_limit_mb=3000 -verbosity=1 \
    -artifact_prefix="$corpus-" "$corpus" $folders >"$corpus.log" 2>&1; then
    echo "passed $name: $(sed -n 's/^Done \([0-9]*\) runs.*/\1/p' "$corpus.log") inputs in $seconds s"
  else
    tail -n 40 "$corpus.log"
    echo "failed $name: the input is $(sed -n 's/.*Test unit written to //p' "$corpus.log")"
    exit 1
  fi
}

if [ $# = 3 ]; then
  one "$3"
  exit
fi
# One a processor at a time; xargs fails when one did.
for fuzzer in "$build"/tests/fuzz_*; do
  [ ! -x "$fuzzer" ] || [ -d "$fuzzer" ] || echo "$fuzzer"
done | xargs -r -n 1 -P "$(nproc)" "$0" "$build" "$seconds"
