#!/bin/sh
# references_in_c.sh SPOOLFLOW MODEL EXAMPLE: the example of references that `export c` writes, run on this machine with an exported page; the
# page that it moves on is one that the sensor takes.
set -eu
spoolflow=$(readlink -f "$1") model=$(readlink -f "$2") example=$(readlink -f "$3") here=$(dirname "$(readlink -f "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$spoolflow" export cpp "$model" -o .
cp "$example" example_references.c
SOURCE_DATE_EPOCH=1700000000 "$spoolflow" export parameters "$model" --sensors observer -o valve.bin
g++ -std=c++17 -O1 -Wall -Wextra -Wpedantic -Werror -DVALVE_SENSOR_NO_MODEL -I. -c valve_sensor.cpp -o sensor.o
gcc -std=c99 -O1 -Wall -Wextra -Wpedantic -Wconversion -Werror -I. -c "$here/references_in_c.c" -o test.o
g++ test.o sensor.o -o test
./test valve.bin moved.bin
"$spoolflow" inspect moved.bin >said
grep -q 'The sensor takes it' said
