#!/bin/sh
# pages_in_c.sh SPOOLFLOW MODEL EXAMPLE: the example of flash pages A and B that `export c` writes, run on this machine with exported pages.
set -eu
spoolflow=$(readlink -f "$1") model=$(readlink -f "$2") example=$(readlink -f "$3") here=$(dirname "$(readlink -f "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$spoolflow" export cpp "$model" -o .
cp "$example" example_pages.c
SOURCE_DATE_EPOCH=1700000000 "$spoolflow" export parameters "$model" --sensors observer -o older.bin
SOURCE_DATE_EPOCH=1800000000 "$spoolflow" export parameters "$model" --sensors observer -o newer.bin
g++ -std=c++17 -O1 -DVALVE_SENSOR_LIBRARY -I. -c valve_sensor.cpp -o sensor.o
g++ -std=c++17 -O1 -DVALVE_SENSOR_LIBRARY -I. -c self_test.cpp -o self_test.o
gcc -std=c99 -Wall -Wextra -Wpedantic -Wconversion -Werror -I. -c "$here/pages_in_c.c" -o test.o
g++ test.o sensor.o self_test.o -o test
./test older.bin newer.bin
