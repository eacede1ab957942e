#!/bin/sh
# arm64.sh BUILD SOURCE ESTIMATE_IN_C MODEL: the Debian packages for 64-bit Arm hold what those of this machine hold and
# name the libraries that they need; under qemu-user the command makes the same bytes of a recording as this machine's does, and
# a program in C that is linked with the library the same answers. 77: no cross compiler or no emulator.
set -eu
build=$1 source=$2 estimate=$3 model=$4
command -v qemu-aarch64 >/dev/null && command -v aarch64-linux-gnu-g++ >/dev/null || exit 77
kept=$build/arm64 # with what cross-compiling takes, for the next time
SPOOLFLOW_PLAIN_BUILD=$build "$source/addons/cross/arm64_packages.sh" "$kept"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
for file in "$kept"/packages/*_arm64.deb; do
  test "$(dpkg-deb --field "$file" Architecture)" = arm64
  dpkg-deb --extract "$file" root
done
# Each library that a program asks for is of a package that its own package names, or of the C and C++ libraries.
named() { # PROGRAM LIBRARY…
  program=$1 depends=$(dpkg-deb --field "$kept/packages/$1"_*_arm64.deb Depends)
  aarch64-linux-gnu-objdump -p "root/usr/bin/$program" | sed -n 's/^ *NEEDED *//p' >needed
  shift
  for name in "$@"; do
    grep -q "^$name" needed
    case "$depends" in *"$name"*) ;; *) echo "$program needs $name, which is not among: $depends" && exit 1 ;; esac
  done
}
named spoolflow libhdf5 libmatio libzip libfmt
named spoolflow-live libsqlite3 libssl
named spoolflow-fleet libpq libnats
run() { qemu-aarch64 -L "$kept/sysroot" -E LD_LIBRARY_PATH="$kept/sysroot/usr/lib/aarch64-linux-gnu:$folder/root/usr/lib" "$@"; }
run root/usr/bin/spoolflow --version
# CSV: beside the emulator's own thread no process can be forked that reads HDF5.
"$build/bin/spoolflow" simulate "$source/examples/scenarios/ramp.toml" -o recording.csv -q
run root/usr/bin/spoolflow estimate "$model" recording.csv -o there.csv -q
"$build/bin/spoolflow" estimate "$model" recording.csv -o here.csv -q
test "$(wc -l <here.csv)" -gt 1000
cmp here.csv there.csv
aarch64-linux-gnu-gcc -std=c99 -Wall -Wextra -Werror -Iroot/usr/include "$source/examples/c_interface/estimate.c" -Lroot/usr/lib -lspoolflow \
  -Wl,--allow-shlib-undefined -o estimate
printf 'time_s,current_A,voltage_V,position_mm,oil_temperature_C\n' >run.csv
for k in 0 1 2 3 4 5 6 7 8 9; do printf '0.00%d,1.4,4.2,1.%d,50\n' $k $k; done >>run.csv
run ./estimate "$model" <run.csv >there
"$estimate" "$model" <run.csv >here
test "$(wc -l <there)" -eq 11
cmp here there
