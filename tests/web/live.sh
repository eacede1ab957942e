#!/bin/sh
# live.sh PAGE COMMAND EXAMPLES: the page of `spoolflow live` in Chromium with running sources. SPOOLFLOW_PICTURES=FOLDER also
# keeps screenshots.
set -eu
page=$1
. "$(dirname "$0")/ready.sh"
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || {
  echo "SKIPPED: chromium is not installed (Debian: chromium)"
  exit 77
}
cp "$(dirname "$0")/live.mjs" "$page"
cd "$page"
SPOOLFLOW_BROWSER=$browser SPOOLFLOW_COMMAND=$2 SPOOLFLOW_EXAMPLES=$3 exec node --test live.mjs
