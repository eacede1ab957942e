#!/bin/sh
# ci/readme_figures.sh COMMAND: puts the figures that `spoolflow demo` prints, and the picture from its report, into README.md and
# docs/pictures. ci/readme_figures.sh --check PRINTED: reports that the figures there are not those of what a demo has printed.
set -eu
root=$(dirname "$0")/..
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ "$1" = --check ]; then cp "$2" "$work/printed"; else "$1" demo -q -o "$work/demo" >"$work/printed"; fi
{
  echo '```'
  sed '/^The recordings are simulated/,$d' "$work/printed" | fold -s -w 110 | sed -e 's/ *$//' -e '${/^$/d}'
  echo '```'
} >"$work/figures"
awk -v figures="$work/figures" '
  /^<!-- end of figures -->/ { inside = 0 }
  !inside { print }
  /^<!-- figures:/ { inside = 1; while ((getline line < figures) > 0) print line }' "$root/README.md" >"$work/README.md"

if [ "$1" = --check ]; then
  # Word by word; numbers may differ by 2 % or 0.1, since another processor rounds otherwise.
  tr -s ' ' '\n' <"$root/README.md" >"$work/old"
  tr -s ' ' '\n' <"$work/README.md" >"$work/new"
  paste -d '\t' "$work/old" "$work/new" | awk -F '\t' '
    function size(x) { return x < 0 ? -x : x }
    $1 == $2 { next }
    $1 ~ /^[-+]?[0-9.]+$/ && $2 ~ /^[-+]?[0-9.]+$/ && size($1 - $2) <= 0.1 + 0.02 * size($2) { next }
    { print "README.md says \"" $1 "\", demo prints \"" $2 "\""; different = 1; exit }
    END { exit different }' || {
    echo "README.md is out of date; run: ci/readme_figures.sh COMMAND" >&2
    exit 1
  }
else
  cat "$work/README.md" >"$root/README.md"
  mkdir -p "$root/docs/pictures"
  "$root/ci/picture.sh" "$work/demo/report.html" "Measured and estimated flow rate" >"$root/docs/pictures/flow_rate.svg"
fi
