#!/bin/sh
# live_for_long.sh PAGE LIVE_LOAD COMMAND MODEL VALVES SECONDS: datagrams of so many valves at 1 kHz into `spoolflow live`, and its page in
# Chromium for as long: neither may grow, lose anything or go stale.
set -eu
page=$1
. "$(dirname "$0")/ready.sh"
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || {
  echo "SKIPPED: chromium is not installed (Debian: chromium)"
  exit 77
}
said=$(mktemp)
"$2" "$3" "$4" "$5" "$6" >"$said" &
load=$!
trap 'kill $load 2>/dev/null || true; rm -f "$said"' EXIT
until url=$(sed -n 's/^page at //p' "$said") && [ -n "$url" ]; do
  kill -0 $load || exit 1
  sleep 0.2
done
cp "$(dirname "$0")/live_for_long.mjs" "$page"
status=0
(cd "$page" && SPOOLFLOW_BROWSER=$browser node live_for_long.mjs "$url" $(($6 - 20)) "v$(($5 / 2))") || status=1
wait $load || status=1
cat "$said"
exit $status
