#!/bin/sh
# walk.sh WALK.md SPOOLFLOW EXAMPLES: runs every ```sh block of a walk, in order, in an empty folder that has the examples
# beside it, and stops at the first command that fails. What the walk promises to write must then be there.
set -eu
walk=$1 spoolflow=$2 examples=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
awk '/^```sh$/ { inside = 1; next } /^```/ { inside = 0 } inside' "$walk" >"$folder/commands.sh"
test "$(grep -c . "$folder/commands.sh")" -ge 5 || { echo "$walk: no commands found"; exit 1; }
mkdir "$folder/here"
cd "$folder/here"
ln -s "$examples" examples
PATH=$(dirname "$spoolflow"):$PATH
export PATH
test "$(command -v spoolflow)" -ef "$spoolflow"
sh -eux "$folder/commands.sh"
# Reports and figures that were written are whole.
for page in $(find . -name '*.html' -not -path './examples/*'); do grep -q '</html>' "$page"; done
for file in $(find . -name '*.json' -not -path './examples/*'); do /usr/bin/python3 -m json.tool "$file" >/dev/null; done
# The limits that a walk writes are met.
for file in $(find . -name 'metrics.json' -not -path './examples/*'); do
  /usr/bin/python3 -c 'import json, sys
for limit in json.load(open(sys.argv[1])).get("requirements", {}).get("limits", []): assert limit["met"], limit' "$file"
done
