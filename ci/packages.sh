#!/bin/sh
# ci/packages.sh [ADDON|firmware|tests|long|release]…: installs what the core needs (packages.txt) and this machine lacks, and what each add-on
# named needs; `firmware`: the compiler for `export c`; `tests`: what all tests need, the add-ons among it; `long`: the long
# acceptance runs, too; `release`: what `ci/release_parts.sh` needs beside.
set -eu
cd "$(dirname "$0")/.."
lists=packages.txt
for name in "$@"; do
  case "$name" in
    tests) for addon in formats cross live fleet python; do lists="$lists addons/$addon/packages.txt"; done; lists="$lists addons/cross/firmware_packages.txt tests/packages.txt" ;;
    long) lists="$lists addons/playground/packages.txt tests/packages_long.txt" ;;
    release) lists="$lists ci/release_packages.txt" ;;
    firmware) lists="$lists addons/cross/firmware_packages.txt" ;;
    fleet) lists="$lists addons/live/packages.txt addons/fleet/packages.txt" ;;
    *) lists="$lists addons/$name/packages.txt" ;;
  esac
done
wanted=$(cat $lists | sed '/^#/d' | sort -u)

if ! command -v dpkg-query >/dev/null; then
  echo "this is not a Debian system: the packages of packages.txt must be there by other means" >&2
  exit 0
fi
# A command that is there by other means stands in for its package.
needed=
for entry in $wanted; do
  case "$entry" in
    *"|"*) command -v "${entry#*|}" >/dev/null || needed="$needed ${entry%|*}" ;;
    *) needed="$needed $entry" ;;
  esac
done
installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' $needed 2>/dev/null | sed -n 's/^installed //p' || true)
missing=
for package in $needed; do
  case "
$installed
" in
    *"
$package
"*) ;;
    *) missing="$missing $package" ;;
  esac
done
[ -n "$missing" ] || exit 0

echo "installing:$missing" >&2
if [ "$(id -u)" = 0 ]; then
  as_root=
elif command -v sudo >/dev/null; then
  as_root=sudo
else
  echo "these packages are missing and neither root nor sudo is at hand; as root run: apt-get install$missing" >&2
  exit 1
fi
log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt() { $as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=120 "$@" </dev/null >>"$log" 2>&1; }
apt update || true # a broken third-party source must not stand in the way; the installation reports it
if ! apt install -y --no-install-recommends $missing; then
  cat "$log" >&2
  echo "could not install:$missing" >&2
  exit 1
fi
