#!/bin/sh
# playground.sh ROOT PAGE FOLDER COMMAND: builds the page that works in a browser alone and drives it in Chromium. SPOOLFLOW_PICTURES=FOLDER
# keeps screenshots; SPOOLFLOW_RECORDINGS=FOLDER has recordings of a real campaign (FOLDER/campaign.toml) to calibrate from.
set -eu
root=$1
page=$2
folder=$3
command=$4
. "$(dirname "$0")/ready.sh"
command -v emcc >/dev/null || {
  echo "SKIPPED: emscripten is not installed (Debian: emscripten)"
  exit 77
}
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || {
  echo "SKIPPED: chromium is not installed (Debian: chromium)"
  exit 77
}
mkdir -p "$folder"
[ -n "${SPOOLFLOW_PLAYGROUND_BUILT:-}" ] || "$root/web/playground/build.sh" "$folder"
cp "$(dirname "$0")/playground.mjs" "$page"
cd "$page"
SPOOLFLOW_BROWSER=$browser SPOOLFLOW_PAGE=$folder/playground.html SPOOLFLOW_COMMAND=$command SPOOLFLOW_EXAMPLES=$root/examples \
  exec node --test playground.mjs
