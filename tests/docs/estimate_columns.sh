#!/bin/sh
# estimate_columns.sh SPOOLFLOW MODEL ROOT: docs/formats/estimate.md names the columns that `estimate` writes, and no other.
set -eu
spoolflow=$1 model=$2 root=$3
page=$root/docs/formats/estimate.md
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$spoolflow" estimate -q "$model" "$root/examples/valve_a/ramp_60bar.h5" -o "$folder/estimate.csv"
head -1 "$folder/estimate.csv" | tr ',' '\n' >"$folder/written"
grep '^| `' "$page" | cut -d'|' -f2 | tr ',' '\n' | tr -d ' `' >"$folder/named"
diff "$folder/named" "$folder/written"
