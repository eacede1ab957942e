#!/bin/sh
# ci/fuzz.sh [SECONDS [TARGET…]]: every fuzz target of tests/fuzz (or those named) over its seeds and what earlier runs
# found, an hour together where no time is given. Prints executions and coverage; the corpus grows in build/fuzz/corpus.
set -eu
cd "$(dirname "$(readlink -f "$0")")/.."
ci/packages.sh tests
ci/build.sh fuzz fuzz_targets "-DSPOOLFLOW_ADDONS=formats;live"
seconds=${1:-3600}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- $(find tests/fuzz -name '*_fuzz.cpp' -printf '%f\n' | sed 's/_fuzz.cpp//' | sort)
status=0
for name in "$@"; do
  echo "== $name"
  tests/fuzz/run.sh "$PWD/build/fuzz" "$name" $((seconds / $#)) "$PWD/build/fuzz/corpus/$name" || status=1
done
exit $status
