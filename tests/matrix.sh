#!/bin/sh
# Every garment on every body: tests/matrix.sh OUT (make matrix)
#
# For each pair OUT holds PAIR.obj, PAIR.json (the report), PAIR.check.json (what tests/drape.c, an
# independent judge, says of the files) and PAIR.png; bodies/ holds the bodies, matrix.json names
# them all, contact.png shows them all, table.txt judges them. Only some:
#
#   GARMENTS='teagan_cisFemaleAdult34 titan*'  BODIES=mh_child_female   patterns of names
#   MATRIX_DATA=DIR    with patterns/seams/*.garment.json and bodies/*.obj
#   MATRIX_MARKS=DIR   with DESIGN.marks for garments called DESIGN_SIZE, and what is worn right;
#                      where there is none, marks are guessed (kitsuke import --marks guess)
#   JOBS=N             pairs at a time
#
# The letters of a row that is not right: L a limb or the head is in no hole or the wrong one; P cloth
# deeper than 0.5 mm in the body; X an edge through it; S strain above 5 % (95 of 100 triangles) or
# 25 % (any) though no girth is too small; I inside out; M more than 5 mm rms off its marks; D not
# dressed at all. `small` stands where a girth of the garment is less than 0.97 of the body's.
program=$0
kitsuke=${KITSUKE:-build/release/kitsuke}
tools=${TOOLS:-build/release/tests}
data=${MATRIX_DATA:-../shared/data}
marks=${MATRIX_MARKS:-tests/marks}
garments=${GARMENTS:-*}
bodies=${BODIES:-mh_female_young_average mh_base_androgynous mh_child_female mh_male_old_heavy gc_mean_all gc_mean_male
  kenney_charactermedium cesiumman}

# value FILE KEY: the number or word behind a key
value() {
  sed -n "s/.*\"$2\": *\([^,}]*\).*/\1/p" "$1" | head -n 1
}

# pair OUT GARMENT BODY
pair() {
  name=$1/$2@$3
  rm -f "$name".*
  guide=$marks/${2%%_*}.marks
  [ -f "$guide" ] || guide=guess
  "$kitsuke" import "$data/patterns/seams/$2.garment.json" --marks "$guide" --journal "$name.kitsuke" >"$name.log" 2>&1 &&
    "$kitsuke" dress "$name.kitsuke" --body "$data/bodies/$3.obj" --obj "$name.obj" --body-obj "$1/bodies/$3.obj" \
      --report "$name.json" >"$name.log" 2>&1 &&
    "$tools/drape" "$name.obj" "$1/bodies/$3.obj" "$name.png" >"$name.check.json" 2>>"$name.log"
  judge "$name" "$guide" >"$name.row"
}

# judge NAME MARKS: one row of the table. A marks file says `# worn: head 1 arms 2 legs 0`.
judge() {
  pair=$(basename "$1")
  [ -s "$1.check.json" ] || {
    printf '%-58s D     %s\n' "$pair" "$(tail -n 1 "$1.log")"
    return
  }
  worn=$(sed -n 's/^# worn: //p' "$2" 2>/dev/null)
  links="head $(value "$1.json" head_through_collar | sed 's/true/1/;s/false/0/') arms $(value "$1.json" arms_in_sleeves) \
legs $(value "$1.json" legs_in_legs)"
  for key in vertices_inside midpoints_inside centres_inside edge_crossings_body; do
    value "$1.check.json" $key
  done | tr '\n' ' ' >"$1.figures"
  for key in inverted_triangles self_intersections strain_p95 strain_max mark_error_mm_rms girth_ratio_min; do
    value "$1.json" $key
  done | tr '\n' ' ' >>"$1.figures"
  awk -v pair="$pair" -v links="$links" -v worn="$worn" '{
    small = $10 > 0 && $10 < 0.97
    bad = (worn != "" && worn != links ? "L" : "") ($1 + $2 + $3 > 0 ? "P" : "") ($4 > 0 ? "X" : "") \
      (!small && ($7 > 0.05 || $8 > 0.25) ? "S" : "") ($5 > 0 ? "I" : "") ($9 > 5 ? "M" : "")
    printf "%-58s %-5s %-5s %5.2f  %4d %4d %4d %4d  %6.3f %6.2f  %4d %4d  %6.1f  %s\n", pair, bad == "" ? "ok" : bad,
      small ? "small" : "", $10, $1, $2, $3, $4, $7, $8, $5, $6, $9, links }' "$1.figures"
  rm "$1.figures"
}

# matches NAME PATTERN...
matches() {
  name=$1
  shift
  for pattern in "$@"; do
    case $name in $pattern) return 0 ;; esac
  done
  return 1
}

list_pairs() {
  set -f
  for path in $(find "$data/patterns/seams" -name '*.garment.json' | sort); do
    garment=$(basename "$path" .garment.json)
    matches "$garment" $garments || continue
    for path in $(find "$data/bodies" -maxdepth 1 -name '*.obj' | sort); do
      body=$(basename "$path" .obj)
      matches "$body" $bodies && echo "$garment $body"
    done
  done
  set +f
}

# The list of all pairs as JSON.
write_list() {
  comma='['
  while read -r garment body; do
    printf '%s\n {"garment": "%s", "body": "%s", "garment_obj": "%s", "body_obj": "%s", "report": "%s"}' "$comma" \
      "$garment" "$body" "$garment@$body.obj" "bodies/$body.obj" "$garment@$body.json"
    comma=,
  done
  printf '\n]\n'
}

if [ "$1" = pair ]; then
  pair "$2" "$3" "$4"
  exit
fi

out=${1:-build/matrix}
[ -d "$data/patterns/seams" ] || {
  echo "skip: $data/patterns/seams is not there"
  exit 0
}
mkdir -p "$out/bodies"
list_pairs >"$out/pairs"
write_list <"$out/pairs" >"$out/matrix.json"
xargs -P "${JOBS:-$(nproc)}" -L 1 "$program" pair "$out" <"$out/pairs"
{
  printf '%-58s %-5s %-5s %5s  %4s %4s %4s %4s  %6s %6s  %4s %4s  %6s  %s\n' pair "" "" girth vert mid cent cross p95 max \
    face self marks links
  while read -r garment body; do
    cat "$out/$garment@$body.row"
  done <"$out/pairs"
} | tee "$out/table.txt"
awk 'NR > 1 { all++; ok += $2 == "ok"; small += / small /; bare += $2 == "D" }
  END { printf "%d of %d right, %d too small, %d not dressed\n", ok, all, small, bare }' "$out/table.txt"
set --
while read -r garment body; do
  [ -s "$out/$garment@$body.png" ] && set -- "$@" "$out/$garment@$body.png" "$garment $body"
done <"$out/pairs"
[ $# = 0 ] || "$tools/contact" "$out/contact.png" "$@"
