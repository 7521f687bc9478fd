#!/bin/sh
# The bundled tape's state hash, over compilers, levels, sanitizers and a second processor.
# tests/check-hash.sh BUILD; fails when two differ or one can't be built.
build=$1
tape=${TAPE:-$(ls tests/tapes/*.hid | head -n 1)}

# name | compiler | flags | runner
variants() {
  cat <<EOF
gcc-O0|gcc|-O0|
gcc-O2|gcc|-O2|
gcc-O3|gcc|-O3|
clang-O0|clang|-O0|
clang-O2|clang|-O2|
clang-O3|clang|-O3|
gcc-sanitize|gcc|-O1 -fsanitize=address,undefined -fno-sanitize-recover=all|
aarch64-O2|aarch64-linux-gnu-gcc|-O2|qemu-aarch64
EOF
}

one() {
  name=$1 compiler=$2 flags=$3 runner=$4
  program=$build/$name/release/tests/replay_hash
  begin=$(date +%s)
  if ! $MAKE --no-print-directory -j1 -s build="$build/$name" CC="$compiler" CFLAGS="$flags" \
    "$program" >"$build/$name.log" 2>&1; then
    tail -n 20 "$build/$name.log"
    echo "$name build-failed" >"$build/$name.hash"
    return
  fi
  hash=$($runner "$program" "$tape" 2>>"$build/$name.log" | awk 'END { print $1 }')
  echo "$name ${hash:-no-hash} $(($(date +%s) - begin))s" | tee "$build/$name.hash"
}

if [ "${2:-}" = one ]; then
  one "$3" "$4" "$5" "$6"
  exit
fi
mkdir -p "$build"
rm -f "$build"/*.hash
variants | tr '|\n' '\0\0' | xargs -0 -n 4 -P "$(nproc)" "$0" "$build" one
count=$(cat "$build"/*.hash | awk '{ print $2 }' | sort -u | wc -l)
if [ "$count" != 1 ] || grep -qE 'build-failed|no-hash' "$build"/*.hash ||
  [ "$(cat "$build"/*.hash | wc -l)" != "$(variants | wc -l)" ]; then
  echo "hash-matrix: the builds disagree:"
  cat "$build"/*.hash
  exit 1
fi
