#!/bin/sh
# Garments and bodies that nobody here made: a real pattern, imported with its design's marks, wrapped
# on a real body, and judged by the report and by an independent judge (tests/drape.c).
. tests/shell.sh
data=../shared/data
[ -d "$data/patterns/seams" ] || {
  echo "skip: ../shared/data is not there"
  exit 77
}

# value KEY: the number behind a key of the report
value() {
  sed -n "s/^ *\"$1\": \([^,]*\),*$/\1/p" "$folder/report.json" | head -n 1
}

below() {
  awk -v a="$(value "$1")" -v b="$2" 'BEGIN { exit !(a != "" && a < b) }' || fail "$3: $1 is $(value "$1"), wanted below $2"
}

equal() {
  [ "$(value "$1")" = "$2" ] || fail "$3: $1 is $(value "$1"), wanted $2"
}

# dress PATTERN MARKS BODY
dress() {
  "$kitsuke" import "$data/patterns/seams/$1.garment.json" --marks "$2" --journal "$folder/$1.kitsuke" >/dev/null ||
    fail "$1: not imported"
  "$kitsuke" dress "$folder/$1.kitsuke" --body "$data/bodies/$3.obj" --report "$folder/report.json" --obj "$folder/$1.obj" ||
    fail "$1: not dressed"
  "${kitsuke%kitsuke}tests/drape" "$folder/$1.obj" "$data/bodies/$3.obj" >"$folder/judge.json" || fail "$1: not judged"
  for key in vertices_inside midpoints_inside centres_inside edge_crossings_body; do
    grep -q "\"$key\": 0," "$folder/judge.json" || fail "$1: $key: the judge says $(cat "$folder/judge.json")"
  done
}

dress teagan_cisFemaleAdult34 tests/marks/teagan.marks mh_female_young_average
for key in vertices_inside midpoints_inside centres_inside edge_crossings_body inverted_triangles; do
  equal "$key" 0 teagan
done
below strain_p95 0.05 teagan
equal head_through_collar true teagan
equal arms_in_sleeves 2 teagan
below seam_gap_mm_max 0.001 teagan

# Sleeves half as long again as a child's arms end above its hands, gathered, and the report says so.
dress brian_cisFemaleAdult34 tests/marks/brian.marks mh_child_female
equal arms_in_sleeves 2 brian
equal head_through_collar true brian
below strain_p95 0.05 brian
below strain_max 0.25 brian
grep -q '"gathered"' "$folder/report.json" || fail "brian: gathered sleeves are not reported"

# What is much too wide for a child hangs in folds; it does not lie in pleats.
dress sven_withBreasts34 tests/marks/sven.marks mh_child_female
equal inverted_triangles 0 sven
equal arms_in_sleeves 2 sven
below self_intersections 10 sven
below strain_p95 0.05 sven

# A mask goes round nothing, and stays on the face.
dress florence_cisMaleAdult42 tests/marks/florence.marks mh_child_female
for key in inverted_triangles self_intersections; do
  equal "$key" 0 florence
done
below strain_p95 0.05 florence
below strain_max 0.25 florence

# A skirt hangs from its waistband round both legs, marked by hand or by a guess.
for marks in tests/marks/penelope.marks guess; do
  dress penelope_cisFemaleAdult34 "$marks" mh_female_young_average
  for key in vertices_inside midpoints_inside centres_inside edge_crossings_body inverted_triangles arms_in_sleeves; do
    equal "$key" 0 penelope
  done
  below strain_p95 0.05 penelope
  below strain_max 0.25 penelope
  below mark_error_mm_rms 5 penelope
done

# A coat's tail, pleated onto a belt little longer than half of it, does not stretch the belt.
dress carlton_cisFemaleAdult34 tests/marks/carlton.marks mh_female_young_average
equal arms_in_sleeves 2 carlton
equal inverted_triangles 0 carlton
below strain_max 0.25 carlton
grep -q '"pleated"' "$folder/report.json" || fail "carlton: its pleats are not reported"

# A narrow one does not hang into the gap between a toy's legs.
dress penelope_cisMaleAdult42 tests/marks/penelope.marks kenney_charactermedium
below inverted_triangles 20 penelope
below strain_max 0.25 penelope
finish
