#!/bin/sh
# The bundled tape's state hash, over compilers, levels, sanitizers, a second processor and threads.
# tests/check-hash.sh BUILD; fails when two differ or one can't be built.
build=$1
tape=${TAPE:-tests/tapes/tshirt.hid}

# name | compiler | flags | runner | numbers of threads
variants() {
  cat <<EOF
gcc-O0|gcc|-O0||1
gcc-O2|gcc|-O2||1 2 4
gcc-O3|gcc|-O3||3
clang-O0|clang|-O0||1
clang-O2|clang|-O2||1 2 4
clang-O3|clang|-O3||3
gcc-sanitize|gcc|-O1 -fsanitize=address,undefined -fno-sanitize-recover=all||2
gcc-threads|gcc|-O1 -fsanitize=thread|env TSAN_OPTIONS=halt_on_error=1|4
aarch64-O2|aarch64-linux-gnu-gcc|-O2|qemu-aarch64|4
EOF
}

one() {
  name=$1 compiler=$2 flags=$3 runner=$4 threads=$5
  program=$build/$name/release/tests/replay_hash
  begin=$(date +%s)
  if ! $MAKE --no-print-directory -j1 -s build="$build/$name" CC="$compiler" CFLAGS="$flags" \
    "$program" >"$build/$name.log" 2>&1; then
    tail -n 20 "$build/$name.log"
    echo "$name build-failed" >"$build/$name.hash"
    return
  fi
  for count in $threads; do
    hash=$($runner "$program" "$count" "$tape" 2>>"$build/$name.log" | awk 'END { print $1 }')
    echo "$name/$count ${hash:-no-hash} $(($(date +%s) - begin))s" | tee -a "$build/$name.hash"
  done
}

if [ "${2:-}" = one ]; then
  one "$3" "$4" "$5" "$6" "$7"
  exit
fi
mkdir -p "$build"
rm -f "$build"/*.hash
variants | tr '|\n' '\0\0' | xargs -0 -n 5 -P "$(nproc)" "$0" "$build" one
count=$(cat "$build"/*.hash | awk '{ print $2 }' | sort -u | wc -l)
runs=$(variants | awk -F'|' '{ runs += split($5, each, " ") } END { print runs }')
if [ "$count" != 1 ] || grep -qE 'build-failed|no-hash' "$build"/*.hash ||
  [ "$(cat "$build"/*.hash | wc -l)" != "$runs" ]; then
  echo "hash-matrix: the builds disagree:"
  cat "$build"/*.hash
  exit 1
fi
