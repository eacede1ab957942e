#!/bin/sh
# modules.sh PAGE TESTS: the script's parts that need no browser.
set -eu
page=$1
tests=$2
. "$(dirname "$0")/ready.sh"
cd "$page"
cp "$tests/modules.test.ts" .
node node_modules/esbuild/bin/esbuild modules.test.ts --bundle --platform=node --format=esm --outfile=modules.test.mjs --log-level=warning
exec node --test modules.test.mjs
