#!/bin/sh
# sbom.sh PROGRAMS SOURCE BUILD: the SPDX list keeps the rules of SPDX 2.3 and names what the programs are linked with, is the same twice,
# and a library or a header that NOTICE does not name is refused by name. NOTICE and Debian's copyright name all that is compiled in.
set -eu
programs=$1 source=$2 build=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export SOURCE_DATE_EPOCH=0
"$source/ci/sbom.py" -o "$folder/one.json" "$programs"/*
"$source/ci/sbom.py" -o "$folder/two.json" "$programs"/*
cmp "$folder/one.json" "$folder/two.json"
for line in '"spdxVersion": "SPDX-2.3"' '"name": "HDF5"' '"name": "uPlot"' 'pkg:deb/debian/zlib1g@' '"created": "1970-01-01T00:00:00Z"'; do
  grep -q "$line" "$folder/one.json" || { echo "no $line in the list" && exit 1; }
done
/usr/bin/python3 "$source/tests/package/spdx_rules.py" "$folder/one.json" "$source"
"$source/ci/sbom.py" --check-headers "$build"
mkdir -p "$folder/ci" "$folder/web"
cp "$source/ci/sbom.py" "$folder/ci"
cp "$source/CMakeLists.txt" "$folder"
cp "$source/web/package.json" "$folder/web"
grep -v ' zlib1g ' "$source/NOTICE" >"$folder/NOTICE"
if "$folder/ci/sbom.py" -o "$folder/three.json" "$programs/spoolflow" 2>"$folder/refusal"; then echo "zlib was not missed" && exit 1; fi
grep -q 'libz.so.1 of package zlib1g, which NOTICE does not name' "$folder/refusal"
grep -v ' nlohmann-json3-dev ' "$source/NOTICE" >"$folder/NOTICE"
if "$folder/ci/sbom.py" --check-headers "$build" 2>"$folder/refusal"; then echo "nlohmann-json3 was not missed" && exit 1; fi
grep -q 'headers of nlohmann-json3 are compiled in' "$folder/refusal"
