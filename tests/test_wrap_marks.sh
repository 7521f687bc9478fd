#!/bin/sh
# Marks that are wrong: the drape is the best that the seams allow, and words say which mark it was.
. tests/shell.sh
data=../shared/data
[ -d "$data/patterns/seams" ] || {
  echo "skip: ../shared/data is not there"
  exit 77
}
garment=teagan_cisFemaleAdult34
"$kitsuke" import "$data/patterns/seams/$garment.garment.json" --marks tests/marks/teagan.marks --journal "$folder/right" ||
  fail "$garment: not imported"

# dress NAME: the journal of that name, its marks' checksums taken off
dress() {
  sed -i 's/ \*[0-9a-f]*$//' "$folder/$1"
  "$kitsuke" dress "$folder/$1" --body "$data/bodies/mh_female_young_average.obj" --report "$folder/$1.json" >/dev/null ||
    fail "$1: not dressed"
}

says() {
  grep -q "$2" "$folder/$1.json" || fail "$1: the report does not say $2"
}

# The sleeves' marks on each other's arms: they are laid where the seams want them all the same.
sed 's/arm-left-top/arm-LEFT-top/; s/arm-right-top/arm-left-top/; s/arm-LEFT-top/arm-right-top/' "$folder/right" >"$folder/swapped"
dress swapped
says swapped '"marks-swapped"'
says swapped '"arms_in_sleeves": 2'
says swapped '"inverted_triangles": 0'

# A sleeve that is marked on a leg is laid by its seams.
sed 's/arm-left-top/leg-left-front/' "$folder/right" >"$folder/astray"
dress astray
says astray '"mark-ignored"'
says astray '"head_through_collar": true'
finish
