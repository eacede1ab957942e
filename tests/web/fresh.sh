#!/bin/sh
# fresh.sh WEB PAGE: web/built is what the sources and the lock file's versions make, byte by byte; and the types are right.
set -eu
web=$1
page=$2
. "$(dirname "$0")/ready.sh"
cd "$page"
node node_modules/typescript/bin/tsc --noEmit
mkdir -p fresh
node build.mjs fresh
for file in page.js page.css live.js live.css live.html fleet.js fleet.css fleet.html; do
  cmp "fresh/$file" "$web/built/$file" || {
    echo "web/built/$file is out of date; run: cd web && npm ci && npm run build" >&2
    exit 1
  }
done
