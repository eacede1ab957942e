#!/bin/sh
# platforms.sh OWN FOREIGN LIBSPOOLFLOW: the libraries of both FMUs in those folders, and the C interface, need nothing but the system:
# on Windows what every one has, on Linux, of PCs and 64-bit Arm, the C library from version 2.28 on (RHEL 8; Debian 11 and Ubuntu 20.04 have 2.31).
set -eu
for name in sensor_fmu valve_fmu; do
  needed=$(x86_64-w64-mingw32-objdump -p "$2/$name.dll" | sed -n 's/.*DLL Name: //p' | sort | tr '\n' ' ')
  echo "$name.dll needs: $needed"
  test "$needed" = "KERNEL32.dll msvcrt.dll "
done
for library in "$1/sensor_fmu.so" "$1/valve_fmu.so" "$2/sensor_fmu_aarch64.so" "$2/valve_fmu_aarch64.so" "$3"; do
  case $library in
    *_aarch64.so)
      [ -s "$library" ] || continue # built without its compiler
      objdump=aarch64-linux-gnu-objdump
      ;;
    *) objdump=objdump ;;
  esac
  needed=$($objdump -p "$library" | sed -n 's/ *NEEDED *//p' | sort | tr '\n' ' ')
  newest=$($objdump -T "$library" | grep -o 'GLIBC_[0-9.]*' | sed 's/GLIBC_//' | sort -uV | tail -1)
  echo "$library needs: $needed, C library $newest"
  for one in $needed; do
    case $one in libc.so.6 | libm.so.6 | libgcc_s.so.1 | ld-linux-x86-64.so.2 | ld-linux-aarch64.so.1) ;; *) exit 1 ;; esac
  done
  test "$(printf '%s\n' "$newest" 2.28 | sort -V | tail -1)" = 2.28
  if $objdump -T "$library" | grep -E 'GLIBCXX|GCC_[1-9][0-9]'; then exit 1; fi
done
