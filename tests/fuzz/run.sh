#!/bin/sh
# run.sh BUILD NAME SECONDS [CORPUS]: one fuzz target over its committed seeds for that time. New inputs go to the folder
# CORPUS where it is given, else nowhere; an input that breaks something is kept in BUILD/fuzz_findings and the exit
# status shows it.
set -eu
build=$1
name=$2
seconds=$3
seeds=$(dirname "$(readlink -f "$0")")/corpus/$name
findings=$build/fuzz_findings/$name
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
corpus=${4:-$scratch/corpus}
mkdir -p "$findings" "$corpus" "$scratch/inputs"
# What libhdf5 asks for in the child is refused as the limit of memory refuses it where no sanitizer reserves terabytes.
export ASAN_OPTIONS=allocator_may_return_null=1:max_allocation_size_mb=1024:detect_leaks=0
export TMPDIR=$scratch/inputs
status=0
"$build/tests/fuzz/${name}_fuzz" "-max_total_time=$seconds" -timeout=240 -rss_limit_mb=4096 -max_len=65536 -print_final_stats=1 \
  "-artifact_prefix=$findings/" "$corpus" "$seeds" >"$scratch/log" 2>&1 || status=$?
grep -E '^#[0-9]+[[:space:]]+DONE|^stat::number_of_executed_units' "$scratch/log" || true
[ $status -eq 0 ] || tail -60 "$scratch/log"
exit $status
