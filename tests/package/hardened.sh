#!/bin/sh
# hardened.sh BIN: each program there loads at random addresses, has no table of addresses that may be written to once it
# runs, and checks its stack and its buffers.
set -eu
count=0
for program in "$1"/*; do
  [ -x "$program" ] && [ -f "$program" ] || continue
  require() {
    readelf --wide "$1" "$program" | grep -q "$2" || { echo "$program: readelf $1 names no $2"; exit 1; }
  }
  require --file-header 'DYN (Position-Independent Executable file)'
  require --program-headers GNU_RELRO
  require --dynamic 'NOW'
  require --dyn-syms '__stack_chk_fail'
  require --dyn-syms '__[a-z]*_chk@'
  count=$((count + 1))
done
test "$count" -gt 0
