#!/bin/sh
# The kernel bench: each tests/kernel/case_NAME.sh in a machine of its own, a user-mode Linux with a
# real hidraw, gpiochip and KMS display.   run.sh OUT [NAME...]
#
# KITSUKE is the program under test, TOOLS the folder of the bench's own, JOBS how many machines run
# at a time. A case may say in comments of its own which words the kernel's command line gets more
# ("# kernel: ..."), and how many seconds it may take ("# seconds: ...", else 120).
# Exit status: 0 all passed, 1 a case failed, 3 the machine is at fault.
set -u
here=$(cd "$(dirname "$0")" && pwd)
tree=$(cd "$here/../.." && pwd)

absolute() {
  (cd "$(dirname "$1")" && printf '%s/%s\n' "$(pwd)" "$(basename "$1")")
}

fail() {
  printf 'check-kernel: %s\n' "$*" >&2
  exit 3
}

# ---- one case ----

word_of() {
  sed -n "s/^# $1: //p" "$here/case_$2.sh"
}

one() {
  name=$1
  folder=$out/$name
  rm -rf "$folder"
  mkdir -p "$folder"
  seconds=$(word_of seconds "$name")
  begin=$(date +%s%N)
  # hostfs takes a path with a comma for two options; nothing else of the command line may hold a blank
  HOME=$folder timeout -k 5 "${seconds:-120}" "$kernel" mem=640M root=/dev/root rootfstype=hostfs \
    rootflags=/ ro quiet panic=-1 con=null con0=null,fd:1 con1=null ssl=null video=Virtual-1:640x360@20 \
    uml_dir="$folder/" umid=linux init="$here/init.sh" $(word_of kernel "$name") \
    BENCH_CASE="$name" BENCH_TREE="$tree" BENCH_OUT="$folder" BENCH_KITSUKE="$kitsuke" \
    BENCH_TOOLS="$tools" </dev/null >"$folder/console" 2>&1
  ended=$?
  took=$(awk "BEGIN { printf \"%.1f\", ($(date +%s%N) - $begin) / 1e9 }")
  status=$(cat "$folder/status" 2>/dev/null)
  if [ "$ended" = 124 ] || [ "$ended" = 137 ]; then
    echo "FAILED: not over after ${seconds:-120} s" >>"$folder/log"
  elif [ -z "$status" ]; then
    echo "FAILED: the machine ended with status $ended: $(tail -n 3 "$folder/console")" >>"$folder/log"
  fi
  if [ "$status" = 0 ] && grep -q afterwards "$here/case_$name.sh"; then
    (cd "$tree" && BENCH_AFTER=$folder BENCH_KITSUKE=$kitsuke BENCH_TOOLS=$tools sh "$here/case_$name.sh") \
      >>"$folder/log" 2>&1
    status=$?
  fi
  verdict=failed
  [ "$status" != 0 ] || verdict=passed
  printf '%s %-20s %5s s  %s\n' "$verdict" "$name" "$took" \
    "$(sed -n '2s/^# //p' "$here/case_$name.sh")" | tee "$folder/verdict"
  [ $verdict = passed ] || sed 's/^/    /' "$folder/log" | tail -n 15
}

# ---- all of them ----

if [ "$1" = --one ]; then
  one "$2"
  exit 0
fi
out=$1
shift
mkdir -p "$out" || exit 3
out=$(absolute "$out")
kitsuke=$(absolute "${KITSUKE:-build/release/kitsuke}")
tools=$(absolute "${TOOLS:-build/release/tests/kernel}")
case "$tree$out$kitsuke$tools" in
*[[:space:],]*) fail "the kernel's command line takes no path with a blank or a comma: $tree, $out" ;;
esac
kernel=$("$here/build.sh") || exit 3
export out kitsuke tools kernel
# The machines' memory is a file; 64 MB of /dev/shm, as containers have, are not enough.
room=$(df -k --output=avail /dev/shm 2>/dev/null | tail -n 1)
[ "${room:-0}" -gt 1500000 ] || export TMPDIR=$out
[ -x /lib/systemd/systemd-udevd ] || fail "udev is missing: run 'firmware-host/setup kernel'"
"$kernel" --version >/dev/null 2>&1 || fail "$kernel does not start; delete it, then it is built anew"

[ $# != 0 ] || set -- $(cd "$here" && printf '%s\n' case_*.sh | sed 's/^case_//; s/\.sh$//')
for name in "$@"; do
  [ -f "$here/case_$name.sh" ] || fail "there is no case $name"
  rm -f "$out/$name/verdict"
done
# Long ones first, so that no processor waits for the last.
for name in "$@"; do
  printf '%s %s\n' "$(word_of seconds "$name" | grep . || echo 120)" "$name"
done | sort -rn | cut -d ' ' -f 2 | xargs -n 1 -P "${JOBS:-2}" "$0" --one

echo
for name in "$@"; do
  cat "$out/$name/verdict" 2>/dev/null || echo "failed $name"
done >"$out/table"
cat "$out/table"
failed=$(grep -c '^failed' "$out/table")
[ "$failed" = 0 ] || echo "what they wrote lies in $out/NAME"
! grep -q 'ptrace: Operation not permitted' "$out"/*/console ||
  fail "this host forbids ptrace, by which a user-mode Linux runs its processes: allow it (a container:" \
    "--cap-add=SYS_PTRACE --security-opt seccomp=unconfined; a host: sysctl kernel.yama.ptrace_scope=1)"
echo "$(grep -c '^passed' "$out/table") passed, $failed failed"
[ "$failed" = 0 ]
