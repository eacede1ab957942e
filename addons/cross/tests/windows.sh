#!/bin/sh
# windows.sh SOURCE ESTIMATE_IN_C MODEL: the C library for Windows exports what its header declares and no more, needs nothing but
# Windows, and a program in C that is linked with it answers under wine, where that is, as it does here. 77: no MinGW.
set -eu
source=$1 estimate=$2 model=$3
command -v x86_64-w64-mingw32-g++-posix >/dev/null || exit 77
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$source/addons/cross/windows_library.sh" library.zip
cmake -E tar xf library.zip
cd spoolflow-*-windows-x64
x86_64-w64-mingw32-objdump -p bin/spoolflow.dll >headers
sed -n 's/^\t\[ *[0-9]*\] \(spoolflow_[a-z_]*\)$/\1/p' headers | sort -u >exported
grep 'SPOOLFLOW_API' include/spoolflow.h | grep -o 'spoolflow_[a-z_]*(' | tr -d '(' | sort -u | diff - exported
test "$(wc -l <exported)" -ge 20
test "$(sed -n 's/.*DLL Name: //p' headers | sort | tr '\n' ' ')" = "KERNEL32.dll msvcrt.dll "
x86_64-w64-mingw32-gcc-posix -std=c99 -Wall -Wextra -Werror -Iinclude examples/estimate.c lib/libspoolflow.dll.a -o bin/estimate.exe
emulator=$(command -v wine64 || command -v /usr/lib/wine/wine64 || true)
if [ -z "$emulator" ]; then
  echo "no wine here: linked, not run"
  exit 0
fi
printf 'time_s,current_A,voltage_V,position_mm,oil_temperature_C\n' >run.csv
for k in 0 1 2 3 4 5 6 7 8 9; do printf '0.00%d,1.4,4.2,1.%d,50\n' $k $k; done >>run.csv
cp "$model" model.json
WINEPREFIX=$folder/prefix WINEDEBUG=-all "$emulator" bin/estimate.exe model.json <run.csv | tr -d '\r' >there
"$estimate" model.json <run.csv >here
head -3 there
test "$(wc -l <there)" -eq 11
# The C libraries of both may round a last digit otherwise.
paste -d, there here | awk -F, 'NR > 1 { for (k = 1; k <= 4; ++k) if (($k - $(k + 5)) ^ 2 > 1e-8 * (1 + $k ^ 2)) exit 1
  if ($5 != $10) exit 1 }'
