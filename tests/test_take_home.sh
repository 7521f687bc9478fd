#!/bin/sh
# What a visitor takes home: a journal's card, its code read from the picture as a phone reads it, and
# worn again. zbar is the phone.
. tests/shell.sh

command -v zbarimg >/dev/null || {
  echo "zbarimg is missing; install zbar-tools (firmware-host/setup check)"
  exit 77
}

# The same in two journals but for what the document snaps to the body: pieces, seams, marks on cloth.
flat() {
  sed 's/ *\*[0-9a-f]*$//' "$1" | awk '/^(piece|layer|sew|fabric|mark-cloth) / {
    for (i = 2; i <= NF; i++) if ($i ~ /^-?[0-9.]+$/) $i += 0
    print
  }'
}

# paint JOURNAL PNG: a card. Fonts keep memory until the end (tests/leaks.h).
paint() {
  ASAN_OPTIONS=detect_leaks=0 "$kitsuke" dress "$1" --card "$2" >"$folder/said" 2>&1 ||
    fail "no card: $(cat "$folder/said")"
}

test_card() {
  journal=tests/journals/tank-top.kitsuke
  paint "$journal" "$folder/card.png"
  grep -q 'QR version' "$folder/said" || fail "no QR code: $(cat "$folder/said")"
  zbarimg --raw -q "$folder/card.png" >"$folder/code.txt" 2>/dev/null || fail "zbar reads no code"
  for what in "$folder/card.png" "$folder/code.txt" "$(cat "$folder/code.txt")"; do
    rm -f "$folder/again.kitsuke"
    "$kitsuke" import "$what" --journal "$folder/again.kitsuke" || fail "import of $what"
    flat "$journal" >"$folder/was"
    flat "$folder/again.kitsuke" >"$folder/is"
    diff "$folder/was" "$folder/is" >&2 || fail "the pattern is not the same"
  done
  "$kitsuke" check "$folder/again.kitsuke" >/dev/null || fail "the journal is not sound"
  "$kitsuke" dress "$folder/again.kitsuke" --obj "$folder/again.obj" >/dev/null 2>&1 ||
    fail "what was taken home can't be worn"
}

# refused WORDS WHAT: exit status 1, and words in what it says.
refused() {
  said=$("$kitsuke" import "$2" --journal "$folder/no.kitsuke" 2>&1)
  got=$?
  [ "$got" = 1 ] || fail "import of $2: exit status $got: $said"
  case "$said" in
  *"$1"*) ;;
  *) fail "\"$1\" is not in: $said" ;;
  esac
  [ ! -e "$folder/no.kitsuke" ] || fail "a journal was written of $2"
}

test_refusals() {
  code=$(cat "$folder/code.txt")
  refused "its end is missing" "${code%.}"
  refused "character 10 is none of a code's" "KITSUKE1:~${code#KITSUKE1:}"
  refused "checksum" "$(echo "$code" | sed 's/^KITSUKE1:\(.\{30\}\)\(...\)\(...\)/KITSUKE1:\1\3\2/')"
  refused "another kind" "KITSUKE2:${code#KITSUKE1:}"
  printf '\211PNG\r\n\032\n0000' >"$folder/bare.png"
  refused "carries no pattern" "$folder/bare.png"
}

# A pattern that no code holds: the card says so, and its file still carries it.
test_too_large() {
  {
    echo "kitsuke-journal 1"
    awk 'BEGIN {
      srand(7)
      for (p = 0; p < 6; p++) {
        printf "piece p%d 1 0 %d 0 0", p, p * 500
        for (i = 0; i < 200; i++) {
          a = 6.283185307 * i / 200; r = 180 + 40 * rand()
          printf " %.1f %.1f %d", r * cos(a), r * sin(a), i % 50 == 0
        }
        print ""
      }
    }'
  } >"$folder/large.kitsuke"
  paint "$folder/large.kitsuke" "$folder/large.png"
  grep -q 'too large for a QR code' "$folder/said" || fail "$(cat "$folder/said")"
  "$kitsuke" import "$folder/large.png" --journal "$folder/large-2.kitsuke" || fail "import"
  flat "$folder/large.kitsuke" >"$folder/was"
  flat "$folder/large-2.kitsuke" >"$folder/is"
  diff "$folder/was" "$folder/is" >/dev/null || fail "the large pattern is not the same"
  [ -z "${KITSUKE_PICTURES:-}" ] || cp "$folder/large.png" "$KITSUKE_PICTURES/"
}

test_card
test_refusals
test_too_large
finish
