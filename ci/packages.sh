#!/bin/sh
# Installs what packages.txt lists and this machine lacks: for building and tests; `ci/packages.sh run` for building alone,
# `ci/packages.sh long` for the long acceptance runs, too.
set -eu
list="$(dirname "$0")/../packages.txt"
case "${1:-}" in
  run) begin='# Building and running' ;;
  long) begin='# Long acceptance runs only' ;;
  *) begin='# Tests only' ;;
esac
wanted=$(sed -e "1,/^$begin/d" -e '/^#/d' "$list")

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
apt update || true # a broken third-party source must not stand in the way; the installation tells
if ! apt install -y --no-install-recommends $missing; then
  cat "$log" >&2
  echo "could not install:$missing" >&2
  exit 1
fi
