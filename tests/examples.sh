#!/bin/sh
# The paper's own examples (S21): a picture of each before its first stroke on the worn garment and
# one of what came of it. tests/examples.sh FOLDER
. tests/shell.sh
out=$1
mkdir -p "$out"
for name in skirt-turned sleeves-rolled poncho askew-righted; do
  journal=tests/journals/$name.kitsuke
  sed '/^\(pin\|grab\) /,$d' "$journal" >"$folder/$name.kitsuke"
  "$kitsuke" dress "$folder/$name.kitsuke" --picture "$out/$name-before.png" >/dev/null ||
    fail "$name: no garment before the first stroke"
  "$kitsuke" dress "$journal" --picture "$out/$name-after.png" --report "$out/$name.json" \
    >/dev/null || fail "$name: no garment"
  echo "$out/$name-before.png $out/$name-after.png"
done
finish
