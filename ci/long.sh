#!/bin/sh
# ci/long.sh [SECONDS [UNITS [SEEDS]]]: what takes too long for every day: clang-tidy; the tests under sanitizers of what takes no foreign
# file apart and of live and fleet; the longest walks, FMUs from their sources, RISC-V; `live` killed at fifty instants, its
# parsers fuzzed for SECONDS each (an hour where none are given), fleets whose parts are killed, 500 valves at 1 kHz for as long,
# the page of 200, the playground's build, and UNITS of a type (200 where none are given). Fleets are killed at SEEDS instants (20),
# large ones for ten minutes or SECONDS, whichever is less, but 100 s at the least; the page for two minutes at the least.
# Prints figures and, at the end, its time; the exit status covers clang-tidy, sanitizers, kills, fleets, fuzzing, the page, the
# playground and the type's bands.
set -eu
cd "$(dirname "$(readlink -f "$0")")/.."
seconds=${1:-3600} units=${2:-200} seeds=${3:-20}
large=$((seconds > 600 ? 600 : seconds < 100 ? 100 : seconds)) # an indicator comes once a minute
status=0
begin=$(date +%s)
part() { echo "== $((($(date +%s) - begin) / 60)) min: $1"; }
ci/build_tests.sh
ci/packages.sh long
ci/build.sh release benchmarks
ci/build.sh release rig_findings
ci/build.sh sanitize all -DSPOOLFLOW_SANITIZE_ALL=ON
part "clang-tidy, and tests under sanitizers that read nothing foreign"
ctest --test-dir build/release -L long -j "$(($(nproc) + 1))" --output-on-failure || status=1
part "50 kills"
SPOOLFLOW_KILLS=50 build/release/addons/live/tests/live_test --gtest_filter='Kills.*' --gtest_brief=1 || status=1
for name in live_datagram live_csv live_site live_http fleet_block; do
  ci/fuzz.sh "$seconds" "$name" || status=1
done
part "fleets whose parts are killed, $seeds seeds, and one with 200 valves for $large s"
ci/build.sh release fleet_reference
for kind in single cluster; do
  /usr/bin/python3 addons/fleet/tests/faults_test.py build/release/bin/spoolflow build/release/addons/fleet/tests/reference/fleet_reference examples $kind \
    $(seq 1 "$seeds") || status=1
  /usr/bin/python3 addons/fleet/tests/faults_test.py build/release/bin/spoolflow build/release/addons/fleet/tests/reference/fleet_reference examples $kind 1 \
    --show "--large=200,$large" || status=1
done
part "500 valves"
build/release/bench/live_load build/release/bin/spoolflow examples/live/size_6.json 500 "$seconds"
part "the page of 200 valves"
tests/web/live_for_long.sh build/release/tests/web/page build/release/bench/live_load build/release/bin/spoolflow examples/live/size_6.json 200 \
  "$((seconds < 120 ? 120 : seconds))" || status=1
part "the playground"
addons/playground/wasm/build.sh build/playground_page || status=1
part "$units units of a type"
ci/series.sh "$units" || status=1
echo "== $((($(date +%s) - begin) / 60)) minutes, status $status"
exit $status
