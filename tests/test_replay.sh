#!/bin/sh
# The bundled visit, from raw reports to the garment: what comes out, and that the journal which the
# station would have written makes the very same state.
. tests/shell.sh
tape=tests/tapes/tshirt.hid

hash_of() {
  sed -n 's/^hash \([0-9a-f]*\).*/\1/p'
}

# report_says KEY VALUE
report_says() {
  grep -q "\"$1\": $2,\{0,1\}$" "$folder/out/report.json" ||
    fail "the report says $(grep "\"$1\"" "$folder/out/report.json"), not $2"
}

test_replay() {
  hash=$("$kitsuke" replay "$tape" --out "$folder/out" --pictures-every 800 | hash_of)
  [ -n "$hash" ] || fail "the tape can't be played"
  for file in journal.kitsuke report.json garment.obj garment.glb contact.png frame-000800.png; do
    [ -s "$folder/out/$file" ] || fail "$file is not written"
  done
  report_says hash "\"$hash\""
}

# The shirt is on: no part of it in the body, the head through the collar, an arm in each sleeve.
test_garment() {
  report_says vertices_inside 0
  report_says midpoints_inside 0
  report_says centres_inside 0
  # a rolled sleeve looks at the arm, and nothing else looks at the body
  creased=$(sed -n 's/.*"creased_triangles": \([0-9]*\).*/\1/p' "$folder/out/report.json")
  report_says inverted_triangles "$creased"
  report_says edge_crossings_body 0
  strain=$(sed -n 's/.*"strain_p95": \([0-9.e-]*\).*/\1/p' "$folder/out/report.json")
  awk -v strain="$strain" 'BEGIN { exit !(strain != "" && strain < 0.10) }' ||
    fail "the shirt is stretched: strain_p95 is $strain"
  report_says head_through_collar true
  report_says arms_in_sleeves 2
}

test_document_is_its_journal() {
  again=$("$kitsuke" dress "$folder/out/journal.kitsuke" --obj "$folder/again.obj" | hash_of)
  [ "$again" = "$hash" ] || fail "the journal makes $again, the tape $hash"
  cmp "$folder/out/garment.obj" "$folder/again.obj" || fail "and another garment"
}

test_samples() {
  "$kitsuke" replay "$tape" --samples >"$folder/samples"
  [ "$(grep -c '"state": "touch"' "$folder/samples")" -gt 500 ] || fail "hardly a sample touches"
  "$kitsuke" replay "$tape" --samples --jitter-mm 2 --seed 7 >"$folder/trembling"
  [ "$(wc -l <"$folder/samples")" = "$(wc -l <"$folder/trembling")" ] ||
    fail "a trembling hand makes more or fewer samples"
  ! cmp -s "$folder/samples" "$folder/trembling" || fail "the hand does not tremble"
}

test_replay
test_garment
test_document_is_its_journal
test_samples
finish
