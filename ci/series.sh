#!/bin/sh
# ci/series.sh [UNITS]: a type from a virtual campaign, and UNITS (200 where none are given) of it, each known by its type alone, by a
# bare and by a measured minute and by a campaign of its own; hours. Prints the table of docs/type_and_unit.md; the exit status covers
# what that page says of bands.
set -eu
cd "$(dirname "$(readlink -f "$0")")/.."
units=${1:-200}
spoolflow=$PWD/build/release/bin/spoolflow
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$spoolflow" campaign size_6 --calibration-only --quiet -o "$folder/campaign"
"$spoolflow" calibrate "$folder/campaign/campaign.toml" --as-type --quiet -o "$folder/type.json"
"$spoolflow" analyse "$folder/type.json" --series "$units" --quiet --json "$folder/series.json"
python3 ci/series.py "$folder/series.json"
