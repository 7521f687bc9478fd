#!/bin/sh
# The bundled tape's state hash, over compilers, levels, sanitizers, a second processor and threads.
# tests/check-hash.sh BUILD; fails when two differ or one can't be built. A row whose compiler and
# flags are those of another target has its objects, too.
build=$1
tape=${TAPE:-tests/tapes/tshirt.hid}

# name | compiler | folder in BUILD | config | flags | runner | numbers of threads; long ones first, so
# that no processor waits for the last
variants() {
  cat <<EOF
aarch64-O2|aarch64-linux-gnu-gcc|hash/aarch64|release||qemu-aarch64|4
gcc-threads|gcc||thread||env TSAN_OPTIONS=halt_on_error=1|4
gcc-sanitize|gcc||sanitize|||2
clang-O0|clang|clang|debug|||1
gcc-O0|gcc||debug|||1
gcc-O3|gcc|hash/gcc-O3|release|-O3||3
clang-O3|clang|hash/clang-O3|release|-O3||3
gcc-O2|gcc||release|||1 2 4
clang-O2|clang|clang|release|||1 2 4
EOF
}

one() {
  name=$1 compiler=$2 folder=$build${3:+/$3} config=$4 flags=$5 runner=$6 threads=$7
  program=$folder/$config/tests/replay_hash
  begin=$(date +%s)
  if ! $MAKE --no-print-directory -j1 -s build="$folder" config="$config" CC="$compiler" CFLAGS="$flags" \
    "$program" >"$build/hash/$name.log" 2>&1; then
    tail -n 20 "$build/hash/$name.log"
    echo "$name build-failed" >"$build/hash/$name.hash"
    return
  fi
  for count in $threads; do
    hash=$($runner "$program" "$count" "$tape" 2>>"$build/hash/$name.log" | awk 'END { print $1 }')
    echo "$name/$count ${hash:-no-hash} $(($(date +%s) - begin))s" | tee -a "$build/hash/$name.hash"
  done
}

if [ "${2:-}" = one ]; then
  shift 2
  one "$@"
  exit
fi
mkdir -p "$build/hash"
rm -f "$build"/hash/*.hash
variants | tr '|\n' '\0\0' | xargs -0 -n 7 -P "$(nproc)" "$0" "$build" one
count=$(cat "$build"/hash/*.hash | awk '{ print $2 }' | sort -u | wc -l)
runs=$(variants | awk -F'|' '{ runs += split($7, each, " ") } END { print runs }')
if [ "$count" != 1 ] || grep -qE 'build-failed|no-hash' "$build"/hash/*.hash ||
  [ "$(cat "$build"/hash/*.hash | wc -l)" != "$runs" ]; then
  echo "hash-matrix: the builds disagree:"
  cat "$build"/hash/*.hash
  exit 1
fi
