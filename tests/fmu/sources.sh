#!/bin/sh
# sources.sh SPOOLFLOW MODEL: what an FMU calls its sources compiles without this project and exports the same functions.
set -eu
spoolflow=$1 model=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
for what in "$model" size_6; do
  rm -rf fmu
  "$spoolflow" export fmu "$what" -o x.fmu --fmi 3
  mkdir fmu
  (cd fmu && cmake -E tar xf ../x.fmu)
  cd fmu/sources
  files=$(sed -n 's/.*<SourceFile name="\([^"]*\)".*/\1/p' buildDescription.xml)
  if g++ -std=c++17 -fsyntax-only -I. ${files%%.cpp*}.cpp 2>message; then exit 1; fi # CMake's default in importers
  grep -q 'compile them with -std=c++20' message
  g++ -std=c++20 -O0 -fPIC -shared -fvisibility=hidden -I. $files -o ../../compiled.so
  cd ../..
  nm -D --defined-only compiled.so | sed -n 's/.* T \(fmi[23]\)/\1/p' | sort >compiled
  nm -D --defined-only fmu/binaries/x86_64-linux/*.so | sed -n 's/.* T \(fmi[23]\)/\1/p' | sort >shipped
  cmp compiled shipped
  echo "$what: $(wc -l <compiled) functions"
done
