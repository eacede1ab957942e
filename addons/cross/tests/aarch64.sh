#!/bin/sh
# aarch64.sh SPOOLFLOW MODEL SOURCES: the FMUs' libraries for Linux on 64-bit Arm, under qemu-user, answer as those of this
# machine do, to all twelve digits. 77: nothing to run them with.
set -eu
spoolflow=$1 model=$2 sources=$3
command -v qemu-aarch64 >/dev/null && command -v aarch64-linux-gnu-g++ >/dev/null || exit 77
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
g++ -std=c++20 "-I$sources" "$sources/tests/fmu/answers.cpp" -o here
aarch64-linux-gnu-g++ -std=c++20 "-I$sources" "$sources/tests/fmu/answers.cpp" -o there

# compare VALVE IDENTIFIER OUTPUT INPUT=MIDDLE:SWING…, all by name
compare() {
  rm -rf fmu && "$spoolflow" export fmu "$1" --fmi 3 -o fmu.zip && /usr/bin/python3 -m zipfile -e fmu.zip fmu
  identifier=$2
  reference() { sed -n 's/.* name="'"$1"'" valueReference="\([0-9]*\)".*/\1/p' fmu/modelDescription.xml; }
  token=$(sed -n 's/.*instantiationToken="\([^"]*\)".*/\1/p' fmu/modelDescription.xml)
  output=$(reference "$3")
  shift 3
  inputs=
  for input; do inputs="$inputs $(reference "${input%%=*}")=${input#*=}"; done
  ./here fmu/binaries/x86_64-linux/$identifier.so "$token" "$PWD/fmu/resources/" "$output" $inputs >here.txt
  qemu-aarch64 -L /usr/aarch64-linux-gnu ./there fmu/binaries/aarch64-linux/$identifier.so "$token" "$PWD/fmu/resources/" "$output" $inputs >there.txt
  paste here.txt there.txt | awk -v name="$identifier" '
    { d = $1 - $2; if (d < 0) d = -d; if (d > apart) apart = d; s = $1 < 0 ? -$1 : $1; if (s > size) size = s }
    END { print name ": " NR " answers, largest " size " m3/s, largest difference " apart + 0 " m3/s"
          exit !(NR == 2000 && size > 1e-6 && apart == 0) }'
}
compare "$model" spoolflow_sensor flow current=1.3:0.5 voltage=4:1.5 position=0.0012:0.0006 oil_temperature=318:3
compare size_6 spoolflow_valve flow position_set=0.001:0.0008
