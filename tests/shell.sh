# What the shell tests share: `. tests/shell.sh` gives $kitsuke (the program), $folder (removed in the
# end) and fail; end with `finish`.
kitsuke=${KITSUKE:-build/release/kitsuke}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

fail() {
  echo "$*" >&2
  failures=$((failures + 1))
}

finish() {
  [ $failures = 0 ]
  exit
}
