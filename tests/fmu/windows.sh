#!/bin/sh
# windows.sh LIBRARY.dll…: each cross-compiled library needs nothing but what every Windows has.
set -eu
for library; do
  needed=$(x86_64-w64-mingw32-objdump -p "$library" | sed -n 's/.*DLL Name: //p' | sort | tr '\n' ' ')
  echo "$(basename "$library") needs: $needed"
  test "$needed" = "KERNEL32.dll msvcrt.dll "
done
