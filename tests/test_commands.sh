#!/bin/sh
# The commands' contracts as a person meets them: exit status, messages with file, place and remedy,
# and files that are there afterwards.
. tests/shell.sh

# expect STATUS WORDS COMMAND...: the exit status, and words somewhere in what it says.
expect() {
  status=$1 words=$2
  shift 2
  said=$("$kitsuke" "$@" 2>&1 </dev/null)
  got=$?
  [ "$got" = "$status" ] || fail "kitsuke $*: exit status $got, expected $status: $said"
  case "$said" in
  *"$words"*) ;;
  *) fail "kitsuke $*: \"$words\" is not in: $said" ;;
  esac
}

test_usage() {
  expect 2 "usage" dress
  expect 2 "unknown option" dress --cloth x.kitsuke
  expect 2 "needs a value" dress x.kitsuke --obj
  expect 2 "whole number" replay x.hid --out x --seed many
  expect 2 "1 to 8" replay x.hid --out x --threads 9
  expect 2 "1 to 8" dress x.kitsuke --threads 0
  expect 2 "usage" replay x.hid
  expect 2 "usage" check
  expect 2 "usage" help nonsense
}

test_help() {
  expect 0 "replay" help
  expect 0 "kitsuke-tape 1" help tape
  expect 0 "taken at start" help limits
  "$kitsuke" help board >"$folder/default.board"
  expect 0 "a board, sound" check "$folder/default.board"
  for word in $(sed -n 's/^	X(EDIT_[A-Z_]*, "\([a-z-]*\)".*/\1/p' src/edit.h); do
    expect 0 "  $word " help journal
  done
}

test_check() {
  expect 1 "$folder/none.kitsuke" check "$folder/none.kitsuke"
  printf 'kitsuke-journal 1\npiece a 0 0 0 0 0 0 0 1 100 0 1 100 100 1\nsew 0 0 7 1 0\nfly 1\n' \
    >"$folder/bad.kitsuke"
  expect 1 "bad.kitsuke: line 3: " check "$folder/bad.kitsuke"
  expect 1 "bad.kitsuke: line 4: unknown word \"fly\"" check "$folder/bad.kitsuke"
  printf 'piece a 0 0\n' >"$folder/headless.kitsuke"
  expect 1 "line 1: a journal begins with" check "$folder/headless.kitsuke"
  printf 'v 0 0 0\nf 1 2 3\n' >"$folder/bad.obj"
  expect 1 "bad.obj: line 2: a face names a vertex" check "$folder/bad.obj"
  printf 'hello\n' >"$folder/letter.txt"
  expect 1 "what kind of file" check "$folder/letter.txt"
  expect 1 "no regular file" check "$folder"
  printf 'kitsuke-journal 1\nclear\nmark-cl' >"$folder/torn.kitsuke"
  expect 0 "cut off" check "$folder/torn.kitsuke"
  for journal in tests/journals/*.kitsuke; do
    [ ! -f "$journal" ] || expect 0 "sound" check "$journal"
  done
  for tape in tests/tapes/*.hid; do
    [ ! -f "$tape" ] || expect 0 "sound" check "$tape"
  done
}

test_dress_faults() {
  printf 'kitsuke-journal 1\nclear\nturn 3\n' >"$folder/bad.kitsuke"
  expect 1 "bad.kitsuke: line 3: unknown word" dress "$folder/bad.kitsuke"
  printf 'kitsuke-journal 1\nwrap\nsettle\n' >"$folder/bare.kitsuke"
  expect 1 "no garment" dress "$folder/bare.kitsuke" --obj "$folder/bare.obj"
  [ ! -e "$folder/bare.obj" ] || fail "a garment file was written without a garment"
  printf 'kitsuke-journal 1\nbody nobody.obj\n' >"$folder/body.kitsuke"
  expect 1 "nobody.obj" dress "$folder/body.kitsuke"
  expect 1 "/nowhere/b.obj" dress "$folder/bare.kitsuke" --body /nowhere/b.obj
  printf 'kitsuke-journal 1\nclear\n' >"$folder/clear.kitsuke"
  expect 3 "/nowhere/report.json" dress "$folder/clear.kitsuke" --report /nowhere/report.json
  expect 0 "hash" dress "$folder/clear.kitsuke" --body-obj "$folder/body.obj"
  expect 0 "a body, sound" check "$folder/body.obj"
}

# Two squares, one seam: y points down in the file and up in the journal.
test_import() {
  cat >"$folder/two.json" <<'END'
{"format": "garment-seams/1", "units": "mm",
 "instances": [{"id": "left", "outline": [[0,0],[0,200],[200,200],[200,0]]},
               {"id": "right", "outline": [[0,0],[0,200],[200,200],[200,0]]}],
 "seams": [{"id": "s", "kind": "seam",
            "a": {"instance": "left", "start": 2, "end": 3, "dir": 1},
            "b": {"instance": "right", "start": 1, "end": 0, "dir": -1}}]}
END
  expect 2 "usage" import "$folder/two.json"
  expect 0 "a pattern, sound: 2 pieces, 1 seams" check "$folder/two.json"
  expect 0 "" import "$folder/two.json" --journal "$folder/two.kitsuke"
  expect 0 "a journal, sound: 3 edits" check "$folder/two.kitsuke"
  grep -q '^piece left .* 0 -200 1 200 -200 1 200 0 1' "$folder/two.kitsuke" ||
    fail "the imported outline is not what the file says: $(cat "$folder/two.kitsuke")"
  echo '{"format": "garment-seams/9"}' >"$folder/nine.json"
  expect 1 "$folder/nine.json" import "$folder/nine.json" --journal "$folder/nine.kitsuke"
  [ ! -e "$folder/nine.kitsuke" ] || fail "a journal was written from a faulty pattern"
}

report_has_its_keys() {
  for key in hash frames vertices triangles work_units wrap_frames wrap_ms step_ms_p50 \
    step_ms_p99 step_ms_max vertices_inside penetration_mm_max edge_crossings_body strain_p95 \
    strain_max compression_p95 inverted_triangles mark_error_mm_rms mark_error_mm_max \
    self_intersections seam_gap_mm_max diagnoses; do
    grep -q "\"$key\": " "$1" || fail "$1 has no key $key"
  done
}

# A document to a garment in files, twice with the same hash, and from the body that was written.
test_dress() {
  journal=tests/journals/tank-top.kitsuke
  expect 0 "hash" dress "$journal" --obj "$folder/a.obj" --glb "$folder/a.glb" \
    --report "$folder/a.json" --body-obj "$folder/a-body.obj"
  first=$said
  report_has_its_keys "$folder/a.json"
  grep -q '"vertices_inside": 0,' "$folder/a.json" || fail "the tank top sinks into the body"
  [ "$(grep -c '^g ' "$folder/a.obj")" = 2 ] || fail "a.obj has not one group a piece"
  [ "$(head -c 4 "$folder/a.glb")" = glTF ] || fail "a.glb is no GLB"
  expect 0 "$first" dress "$journal"
  expect 0 "$first" dress "$journal" --body "$folder/a-body.obj"
}

# The measured line goes to its place in the board file; the rest stays, byte for byte.
test_calibrate() {
  expect 2 "usage" calibrate one two
  expect 1 "none.board" calibrate "$folder/none.board"
  expect 0 "budget = " calibrate "$folder/default.board"
  expect 0 "a board, sound" check "$folder/default.board"
  grep -q '^budget = [1-9][0-9]*000$' "$folder/default.board" ||
    fail "no measured budget in $(cat "$folder/default.board")"
  "$kitsuke" help board | grep -v '^budget' >"$folder/before"
  grep -v '^budget' "$folder/default.board" | cmp -s - "$folder/before" ||
    fail "calibrate changed more than the budget"
}

test_usage
test_help
test_check
test_dress_faults
test_import
test_dress
test_calibrate
finish
