#!/bin/sh
# Is the bundled visit a lucky one? Plays it with every pen point moved by up to 2 mm on the tablet,
# one run a seed, and counts the runs that end with the garment worn right: head through the collar,
# an arm in each sleeve, nothing inside the body, strain below 10 %.
#
#   tests/check-seeds.sh KITSUKE [SEEDS] [NEEDED]
set -u
kitsuke=$1 seeds=${2:-20} needed=${3:-19}
tape=${TAPE:-tests/tapes/tshirt.hid}
out=${KEEP:-$(mktemp -d)}; mkdir -p "$out"
[ -n "${KEEP:-}" ] || trap 'rm -rf "$out"' EXIT

play() {
	"$kitsuke" replay "$tape" --out "$out/$1" --no-pictures --jitter-mm 2 --seed "$1" >"$out/$1.log" 2>&1
	report=$out/$1/report.json
	why=
	grep -q '"head_through_collar": true' "$report" 2>/dev/null || why="$why head"
	grep -q '"arms_in_sleeves": 2' "$report" 2>/dev/null || why="$why arms"
	for key in vertices_inside midpoints_inside centres_inside; do
		grep -q "\"$key\": 0" "$report" 2>/dev/null || why="$why $key"
	done
	awk -F'[:,]' '/"strain_p95"/ { found = $2 < 0.10 } END { exit !found }' "$report" 2>/dev/null || why="$why strain"
	echo "seed $1: ${why:-dressed}" >"$out/$1.verdict"
}

running=0
for seed in $(seq "$seeds"); do
	play "$seed" &
	running=$((running + 1))
	if [ "$running" -ge "$(nproc)" ]; then
		wait
		running=0
	fi
done
wait
for seed in $(seq "$seeds"); do cat "$out/$seed.verdict"; done
dressed=$(cat "$out"/*.verdict | grep -c ': dressed$')
echo "dressed in $dressed of $seeds seeds, $needed needed"
[ "$dressed" -ge "$needed" ]
