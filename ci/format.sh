#!/bin/sh
# Fails where a source is not as clang-format 14 leaves it; `ci/format.sh -i` formats. Other versions format differently: where
# there are only these, nothing is done and the status is 77, by which ctest skips.
set -eu
cd "$(dirname "$0")/.."
mode=${1:---dry-run}
format=$(command -v clang-format-14 || command -v clang-format)
case "$("$format" --version)" in
  *"version 14."*) ;;
  *)
    echo "needs clang-format 14, and $format is another version" >&2
    exit 77
    ;;
esac
find spoolflow addons tests bench examples web/*.cpp -name '*.[ch]pp' 2>/dev/null | sort | xargs "$format" "$mode" --Werror
