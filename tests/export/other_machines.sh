#!/bin/sh
# other_machines.sh SPOOLFLOW MODEL: the exported folder, compiled as C++17 for other machines, answers there as on the host
# (its self-test): 64-bit Arm, 64-bit RISC-V, PowerPC, whose bytes lie the other way round, under qemu-user; and by the newest
# clang. A parameter image is taken where the lowest byte comes first and refused by a code of its own elsewhere. 77: none of them
# is here.
set -eu
spoolflow=$1 model=$2
byte_order=$(cd "$(dirname "$0")" && pwd)/other_byte_order.cpp
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$spoolflow" export cpp "$model" -o exported >said 2>&1 || { cat said; exit 1; }
"$spoolflow" export parameters "$model" -o valve.bin >said 2>&1 || { cat said; exit 1; }
cd exported
warnings="-Wall -Wextra -Wconversion -Wdouble-promotion -Wsign-conversion -Wfloat-equal -Werror"
tried=0
# tried_on COMPILER EMULATOR…
tried_on() {
  compiler=$1
  shift
  command -v "$compiler" >/dev/null || return 0
  if [ $# -gt 0 ] && ! command -v "$1" >/dev/null; then return 0; fi
  tried=$((tried + 1))
  "$compiler" -std=c++17 -O2 $warnings -static -I. self_test.cpp -o self_test
  status=0
  "$@" ./self_test || status=$?
  echo "$compiler: self-test ends with $status"
  [ $status -eq 0 ]
  "$compiler" -std=c++17 -O2 $warnings -static -I. "$byte_order" -o byte_order
  "$@" ./byte_order ../valve.bin >log || { cat log; exit 1; }
  echo "$compiler: image: $(cat log)"
}
tried_on clang++-19
tried_on aarch64-linux-gnu-g++ qemu-aarch64
tried_on riscv64-linux-gnu-g++ qemu-riscv64
tried_on powerpc-linux-gnu-g++ qemu-ppc
[ $tried -gt 0 ] || exit 77
