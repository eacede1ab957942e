#!/bin/sh
# platforms.sh FOLDER: the libraries of both FMUs there need nothing but the system: on Windows what every one has, on Linux the
# C library from version 2.35 on.
set -eu
for name in sensor_fmu valve_fmu; do
  needed=$(x86_64-w64-mingw32-objdump -p "$1/$name.dll" | sed -n 's/.*DLL Name: //p' | sort | tr '\n' ' ')
  echo "$name.dll needs: $needed"
  test "$needed" = "KERNEL32.dll msvcrt.dll "
  needed=$(objdump -p "$1/$name.so" | sed -n 's/ *NEEDED *//p' | sort | tr '\n' ' ')
  newest=$(objdump -T "$1/$name.so" | grep -o 'GLIBC_[0-9.]*' | sed 's/GLIBC_//' | sort -uV | tail -1)
  echo "$name.so needs: $needed, C library $newest"
  case $needed in "libc.so.6 libm.so.6 " | "ld-linux-x86-64.so.2 libc.so.6 libm.so.6 ") ;; *) exit 1 ;; esac
  test "$(printf '%s\n' "$newest" 2.35 | sort -V | tail -1)" = 2.35
done
