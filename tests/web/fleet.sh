#!/bin/sh
# fleet.sh PAGE COMMAND FLEET: the page of `spoolflow fleet` in Chromium over the rows that FLEET makes. SPOOLFLOW_PICTURES=FOLDER
# also keeps screenshots.
set -eu
page=$1
. "$(dirname "$0")/ready.sh"
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || {
  echo "SKIPPED: chromium is not installed (Debian: chromium)"
  exit 77
}
cp "$(dirname "$0")/fleet.mjs" "$page"
cd "$page"
SPOOLFLOW_BROWSER=$browser SPOOLFLOW_COMMAND=$2 SPOOLFLOW_FLEET=$3 exec node --test fleet.mjs
