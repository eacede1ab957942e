#!/bin/sh
# fresh_units.sh WEB WRITE_UNITS: web/src/units.ts is what the program writes of the table of units, byte by byte.
set -eu
"$2" | cmp - "$1/src/units.ts" || {
  echo "web/src/units.ts is out of date; run: ninja -C build/release web_units; cd web && npm ci && npm run build" >&2
  exit 1
}
