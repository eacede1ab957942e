#!/bin/sh
# browser.sh PAGE REPORTS COMMAND MODEL: opens the reports of some runs in Chromium. SPOOLFLOW_PICTURES=FOLDER also keeps
# screenshots and a print of them.
set -eu
page=$1
reports=$2
. "$(dirname "$0")/ready.sh"
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || {
  echo "SKIPPED: chromium is not installed (Debian: chromium)"
  exit 77
}
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$reports"
cp "$here"/*.mjs "$page"
cd "$page"
node make_reports.mjs "$reports" "$3" "$4"
SPOOLFLOW_BROWSER=$browser SPOOLFLOW_REPORTS=$reports exec node --test browser.mjs
