#!/bin/sh
# playground.sh ROOT PAGE FOLDER COMMAND: builds the page that works in a browser alone and drives it in Chromium. SPOOLFLOW_PICTURES=FOLDER
# keeps screenshots; SPOOLFLOW_RECORDINGS=FOLDER has recordings of a real campaign (FOLDER/campaign.toml) to calibrate from.
set -eu
root=$1
page=$2
folder=$3
. "$root/tests/web/ready.sh"
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || {
  echo "SKIPPED: chromium is not installed (Debian: chromium)"
  exit 77
}
here=$(dirname "$0")
cp "$here/playground_page.mjs" "$here/playground.mjs" "$here/playground_walk.mjs" "$page"
cd "$page"
command=$4
command -v emcc >/dev/null || {
  echo "SKIPPED: emscripten is not installed (Debian: emscripten)"
  exit 77
}
mkdir -p "$folder"
[ -n "${SPOOLFLOW_PLAYGROUND_BUILT:-}" ] || "$root/addons/playground/wasm/build.sh" "$folder"
SPOOLFLOW_BROWSER=$browser SPOOLFLOW_PAGE=$folder/playground.html SPOOLFLOW_COMMAND=$command SPOOLFLOW_EXAMPLES=$root/examples \
  node --test playground.mjs
SPOOLFLOW_BROWSER=$browser SPOOLFLOW_PAGE=$folder/playground.html exec node --test playground_walk.mjs
