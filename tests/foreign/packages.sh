#!/bin/sh
# packages.sh FROM… TO: each folder FROM has a package.json and its lock; their packages are installed in TO, together with
# the folder's sources, in a folder of the same name.
set -eu
for to; do :; done
for from; do
  [ "$from" = "$to" ] && break
  there=$to/$(basename "$from")
  mkdir -p "$there"
  cp "$from"/package.json "$from"/package-lock.json "$there"
  find "$from" -maxdepth 1 -name '*.js' -exec cp {} "$there" \;
  if [ -d "$there/node_modules" ] && cmp -s "$there/package-lock.json" "$there/installed-lock.json"; then continue; fi
  command -v npm >/dev/null || { echo "SKIPPED: npm is not installed (Debian: npm)"; exit 77; }
  if ! (cd "$there" && npm ci --ignore-scripts --no-audit --no-fund --prefer-offline --fetch-retries=1) >"$there/npm.log" 2>&1; then
    tail -n 5 "$there/npm.log"
    grep -q -E 'EINTEGRITY|EUSAGE' "$there/npm.log" && exit 1
    echo "SKIPPED: npm could not fetch the packages of $from"
    exit 77
  fi
  cp "$there/package-lock.json" "$there/installed-lock.json"
done
