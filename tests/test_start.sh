#!/bin/sh
# A drape from elsewhere as the start of a wrap: shifted into the body, mirrored, in millimetres,
# crumpled; what can't be one is refused with words.
. tests/shell.sh
journal=tests/journals/tshirt.kitsuke
"$kitsuke" dress $journal --obj "$folder/worn.obj" >/dev/null || fail "the shirt is not dressed"

# bend NAME AWK: the worn shirt with every vertex x y z changed
bend() {
  awk 'function noise() { seed = (seed * 16807) % 2147483647; return seed / 2147483647 - 0.5 }
       BEGIN { seed = 7 } $1 == "v" { x = $2; y = $3; z = $4; '"$2"'; print "v", x, y, z; next } { print }' \
    "$folder/worn.obj" >"$folder/$1.obj"
}

# mended NAME KIND: starts from it; the report is as of a shirt that is on, and says KIND
mended() {
  "$kitsuke" dress $journal --start "$folder/$1.obj" --report "$folder/$1.json" >/dev/null || fail "$1: not dressed"
  for wanted in '"vertices_inside": 0,' '"head_through_collar": true,' '"arms_in_sleeves": 2,' "$2"; do
    grep -q "$wanted" "$folder/$1.json" || fail "$1: the report has no $wanted"
  done
}

bend same ''
mended same '"diagnoses": \[\]'
bend inside 'z -= 0.06'
mended inside start-moved
bend mirrored 'x = -x'
mended mirrored start-mirrored
bend millimetres 'x *= 1000; y *= 1000; z *= 1000'
mended millimetres start-scaled
bend crumpled 'x += 0.04 * noise(); y += 0.04 * noise(); z += 0.04 * noise()'
mended crumpled start-crumpled

# refused NAME WORDS
refused() {
  "$kitsuke" dress $journal --start "$folder/$1.obj" >/dev/null 2>"$folder/words" && fail "$1: taken"
  grep -q "$2" "$folder/words" || fail "$1: says $(cat "$folder/words")"
}
grep -v '^vt' "$folder/worn.obj" >"$folder/flat.obj"
refused flat 'texture point'
sed 's/^g .*/g collar/' "$folder/worn.obj" >"$folder/other.obj"
refused other 'group "front" has no cloth'
finish
