#!/bin/sh
# packages.sh WEB PAGE: a copy of the page's sources with the packages of its lock file beside it.
set -eu
web=$1
page=$2
skip() {
  echo "SKIPPED: $1"
  echo "$1" >"$page/missing"
  exit 77
}
mkdir -p "$page"
rm -rf "$page/src" "$page/missing"
cp -r "$web/src" "$web/build.mjs" "$web/package.json" "$web/package-lock.json" "$web/tsconfig.json" "$page"
command -v node >/dev/null || skip "node is not installed (Debian: nodejs)"
if [ -d "$page/node_modules" ] && cmp -s "$page/package-lock.json" "$page/installed-lock.json"; then exit 0; fi
command -v npm >/dev/null || skip "npm is not installed (Debian: npm)"
# Packages come with their sha512 in the lock file; their own scripts do not run.
if ! (cd "$page" && npm ci --ignore-scripts --no-audit --no-fund --prefer-offline --fetch-retries=1) >"$page/npm.log" 2>&1; then
  grep -q -E 'EINTEGRITY|EUSAGE' "$page/npm.log" && { cat "$page/npm.log"; exit 1; }
  tail -n 5 "$page/npm.log"
  skip "npm could not fetch the packages of web/package-lock.json"
fi
cp "$page/package-lock.json" "$page/installed-lock.json"
