#!/bin/sh
# Fails where a source is not as clang-format leaves it; `ci/format.sh -i` formats.
set -eu
cd "$(dirname "$0")/.."
mode=${1:---dry-run}
find spoolflow addons tests bench examples web/*.cpp -name '*.[ch]pp' 2>/dev/null | sort | xargs clang-format "$mode" --Werror
