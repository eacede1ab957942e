#!/bin/sh
# same_bytes.sh COMMAND SCENARIO.toml: a recording is the same to the byte where the C library computes without the
# processor's fused multiply-add, as on another processor.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1" simulate "$2" -q -o "$work/here.csv" --truth "$work/here_truth.csv"
GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-FMA4_Usable,-AVX2,-FMA \
  "$1" simulate "$2" -q -o "$work/there.csv" --truth "$work/there_truth.csv"
cmp "$work/here.csv" "$work/there.csv"
cmp "$work/here_truth.csv" "$work/there_truth.csv"
