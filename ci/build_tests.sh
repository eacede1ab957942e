#!/bin/sh
# ci/build_tests.sh: installs what the tests need, and builds them: plain in build/release, under sanitizers in build/sanitize.
set -eu
cd "$(dirname "$(readlink -f "$0")")/.."
ci/packages.sh tests
ci/build.sh release all -DSPOOLFLOW_ADDONS=all -DSPOOLFLOW_TESTS=ON -DSPOOLFLOW_BENCH=ON -DSPOOLFLOW_DEVELOPER=ON -DSPOOLFLOW_SANITIZED_BUILD="$PWD/build/sanitize"
ci/build.sh sanitize sanitized_tests "-DSPOOLFLOW_ADDONS=formats;cross;live;fleet;playground" -DSPOOLFLOW_DEVELOPER=ON -DSPOOLFLOW_SANITIZE_ALL=OFF -DSPOOLFLOW_PLAIN_BUILD="$PWD/build/release"
