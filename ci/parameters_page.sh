#!/bin/sh
# ci/parameters_page.sh PROGRAM [--check]: writes docs/formats/parameters.md with the built parameters_page, or reports that it
# is out of date.
set -eu
page=$(dirname "$0")/../docs/formats/parameters.md
if [ "${2:-}" = --check ]; then
  "$1" | diff -u "$page" - || {
    echo "docs/formats/parameters.md is out of date; run: ci/parameters_page.sh $1" >&2
    exit 1
  }
else
  "$1" >"$page"
fi
