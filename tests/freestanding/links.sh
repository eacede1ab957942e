#!/bin/sh
# links.sh SOURCE OBJECT EXPECTED INCLUDE_FOLDERS COMPILER FLAG…: links every step of the sensor with nothing but the
# compiler's own library (libgcc), and compares what is left over with EXPECTED, names joined by commas.
set -eu
source=$1 object=$2 expected=$3 folders=$4
shift 4
said=$("$@" -std=c++17 -O2 -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-tree-loop-distribute-patterns \
  $folders "$source" -nostdlib -Wl,-e,observer_step -lgcc -o "$object" 2>&1) && status=0 || status=$?
found=$(echo "$said" | sed -n "s/.*undefined reference to \`\(.*\)'.*/\1/p" | sort -u | paste -sd,)
if [ "$found" != "$expected" ] || { [ $status -ne 0 ] && [ -z "$found" ]; }; then
  echo "$said" | tail -20
  echo "needs beside the compiler's own library: ${found:-nothing}; docs/embedded.md says: ${expected:-nothing}" >&2
  exit 1
fi
echo "needs beside the compiler's own library: ${found:-nothing}"
