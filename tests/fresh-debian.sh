#!/usr/bin/env bash
# The README's two commands on a Debian that has never seen kitsuke: tests/fresh-debian.sh [SUITE]
#
# SUITE is bookworm (default) or trixie. Makes a minimal root by mmdebstrap from this machine's own
# package source, with nothing in it but git, make, sudo and a user; clones this commit into it and
# runs `make run` and `make check` there as that user, who has neither display nor ../shared.
# Needs mmdebstrap, and root for the chroot. FRESH_ROOT=DIR keeps the root there to look around in.
set -eu

suite=${1:-bookworm}
here=$(cd "$(dirname "$0")/.." && pwd)
root=${FRESH_ROOT:-$(mktemp -d)}

say() {
  printf 'fresh-debian: %s\n' "$*"
}

fail() {
  say "$*"
  exit 3
}

command -v mmdebstrap >/dev/null || fail "mmdebstrap is not installed"
[ "$(id -u)" = 0 ] || fail "run as root: a root is made and entered by chroot"

# Where this machine gets Debian from; the fresh one asks the same mirror.
mirror() {
  apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
    awk '$2 !~ /security|-/ && $3 == "main" { print $1; exit }'
}

leave() {
  mountpoint -q "$root/proc" && umount "$root/proc"
  [ -n "${FRESH_ROOT:-}" ] || rm -rf --one-file-system "$root"
}
trap leave EXIT

# What this machine's apt was told about reaching its mirror holds in the fresh root too.
carry_apt_settings() {
  for setting in Acquire::http::Proxy Acquire::https::Proxy Acquire::Check-Valid-Until \
    Acquire::Check-Date; do
    value=$(apt-config shell value "$setting")
    [ -z "$value" ] || (eval "$value" && printf '%s "%s";\n' "$setting" "$value")
  done >"$root/etc/apt/apt.conf.d/90from-the-host"
  [ ! -e /etc/resolv.conf ] || cp -L /etc/resolv.conf "$root/etc/resolv.conf"
  cp /etc/hosts "$root/etc/hosts"
}

as_user() {
  chroot "$root" su - visitor -c "cd kitsuke && $1"
}

source=$(mirror)
[ -n "$source" ] || fail "no source for Debian's main found in this machine's apt"
say "a minimal $suite"
mmdebstrap --variant=minbase --include=git,make,sudo,ca-certificates "$suite" "$root" \
  "deb $source $suite main" >"$root.log" 2>&1 || { tail -n 20 "$root.log" && fail "no root"; }
carry_apt_settings
mount -t proc proc "$root/proc"
chroot "$root" useradd -m -s /bin/bash visitor
echo 'visitor ALL=(ALL) NOPASSWD: ALL' >"$root/etc/sudoers.d/visitor"
git clone -q "$here" "$root/home/visitor/kitsuke"
chroot "$root" chown -R visitor: /home/visitor/kitsuke

status=0
for words in "make run" "make check"; do
  say "$words"
  begin=$SECONDS
  as_user "$words" </dev/null || status=1
  say "$words: $([ $status = 0 ] && echo done || echo FAILED) after $((SECONDS - begin)) s"
  [ $status = 0 ] || break
done
[ $status != 0 ] || as_user "firmware-host/setup check" 2>&1 | (! grep .) ||
  fail "set-up is not quiet the second time"
exit $status
