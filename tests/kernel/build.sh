#!/bin/sh
# The kernel bench's kernel: a user-mode Linux from Debian's own source. Prints its path.
#
# Built once, and kept outside the tree under a name that says what went into it: the source, the
# configuration, the changes. Some 8 minutes of processor time and 1 GB of disk while it builds;
# 4 MB stay.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=${KERNEL_SOURCE:-/usr/src/linux-source-6.12.tar.xz}
cache=${XDG_CACHE_HOME:-$HOME/.cache}/kitsuke

say() {
  printf 'kernel: %s\n' "$*" >&2
}

fail() {
  say "$*"
  exit 3
}

# ---- what it is made from ----

[ "$(uname -m)" = x86_64 ] || fail "user-mode Linux runs on x86-64 only, this is $(uname -m)"
[ -r "$source" ] ||
  fail "$source is missing: run 'firmware-host/setup kernel', which takes it from Debian's security suite"
# The package's version stands for 150 MB of source.
version=$(dpkg-query -W -f '${Version}' linux-source-6.12 2>/dev/null) || version=$(cksum <"$source")
key=$(printf '%s\n' "$version" | cat - "$here/config" "$here/changes.sh" | sha256sum | cut -c 1-16)
kernel=$cache/linux-$key
if [ -x "$kernel" ]; then
  echo "$kernel"
  exit 0
fi

# ---- unpack ----

mkdir -p "$cache"
work=$(mktemp -d -p "$cache")
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
cd "$work"
begin=$(date +%s)
say "building once; it will be kept as $kernel"
say "unpacking $source"
# Without what other machines need, that is half of the files; Kconfig wants its own files whole.
top=linux-source-6.12
tar -xJf "$source" --exclude="$top/arch/[!ux]*/*.[chS]" --exclude="$top/arch/*/*.dts*" \
  --exclude="$top/Documentation/*/*" \
  --exclude="$top/tools/testing/*" --exclude="$top/sound/*.[ch]" --exclude="$top/drivers/net/[ew]*/*.[ch]" \
  --exclude="$top/drivers/gpu/drm/amd/*.[ch]" --exclude="$top/drivers/media/*.[ch]" \
  --exclude="$top/drivers/scsi/*.[ch]" --exclude="$top/drivers/infiniband/*.[ch]" \
  --exclude="$top/drivers/staging/*.[ch]" || fail "$source can't be unpacked; is the disk full?"
cd "$top"

# ---- change ----

# change FILE SED-SCRIPT: the script must change something, or the source is not the one we know.
change() {
  cp "$1" "$work/before"
  sed -i "$2" "$1"
  ! cmp -s "$1" "$work/before" || fail "$1 is not as expected in $version; mend tests/kernel/build.sh"
}

. "$here/changes.sh"

# ---- configure ----

quietly() {
  "$@" >"$work/log" 2>&1 && return
  tail -n 20 "$work/log" >&2
  fail "'$*' failed; see above. Packages that it needs: firmware-host/setup kernel"
}

quietly make ARCH=um tinyconfig
quietly scripts/kconfig/merge_config.sh -m .config "$here/config"
quietly make ARCH=um olddefconfig
while IFS='= ' read -r option value rest; do
  case "$option $value" in
  CONFIG_*\ n) ! grep -q "^$option=" .config || fail "$option came out set" ;;
  CONFIG_*) grep -qxF "$option=$value" .config || fail "$option came out other than $value" ;;
  esac
done <"$here/config"

# ---- compile ----

# The count goes on in place on a terminal, and in a line now and then elsewhere.
progress() {
  count=0
  while IFS= read -r line; do
    printf '%s\n' "$line"
    case "$line" in
    "  CC "* | "  AS "* | "  AR "* | "  LD "*) count=$((count + 1)) ;;
    *) continue ;;
    esac
    if [ -t 2 ]; then
      printf '\rkernel: %d of about 1100 files ' "$count" >&2
    elif [ $((count % 100)) = 0 ]; then
      say "$count of about 1100 files"
    fi
  done >"$work/log"
  [ ! -t 2 ] || echo >&2
}

say "compiling on $(nproc) processors"
{
  make ARCH=um -j"$(nproc)" linux 2>&1 || echo "failed" >"$work/failed"
} | progress
if [ -e "$work/failed" ]; then
  grep -m 5 -A 5 -E 'error|Error' "$work/log" >&2 || tail -n 20 "$work/log" >&2
  fail "the kernel does not compile; see above. Packages that it needs: firmware-host/setup kernel"
fi
strip linux
mv linux "$work/linux"
mv "$work/linux" "$kernel"
say "built in $(($(date +%s) - begin)) s"
echo "$kernel"
