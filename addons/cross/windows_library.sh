#!/bin/sh
# windows_library.sh OUT.zip: the C library for 64-bit Windows as an archive: spoolflow.dll, which needs nothing but
# Windows, its import library for MinGW, the names of its functions for other compilers (lib /def:spoolflow.def), header, example.
# Needs g++-mingw-w64-x86-64-posix; fmt and nlohmann-json are headers and taken from the host.
set -eu
out=$(realpath "$1")
root=$(cd "$(dirname "$0")/../.." && pwd)
version=$(sed -n 's/^#define SPOOLFLOW_VERSION "\(.*\)"$/\1/p' "$root/spoolflow/export/c_interface/spoolflow.h")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
name=spoolflow-$version-windows-x64
made=$folder/$name
mkdir -p "$folder/headers" "$made/bin" "$made/lib" "$made/include" "$made/examples"
for library in nlohmann fmt; do
  ln -s "/usr/include/$library" "$folder/headers/$library"
done
cd "$folder"
for part in export/c_interface/sensor_functions export/c_interface/status_text model/json_text model/json_node \
  model/file_section model/model_file model/model_limits estimation/running_sensor; do
  x86_64-w64-mingw32-g++-posix -std=c++20 -O2 -Wall -Wextra -Werror -DSPOOLFLOW_BUILDS_DLL -DFMT_HEADER_ONLY "-ffile-prefix-map=$root=." \
    "-DSPOOLFLOW_BUILT_VERSION=\"$version\"" -I"$root" -isystem headers -c "$root/spoolflow/$part.cpp" -o "$(basename $part).o"
done
x86_64-w64-mingw32-g++-posix -shared -s -static ./*.o -o "$name/bin/spoolflow.dll" \
  "-Wl,--out-implib,$name/lib/libspoolflow.dll.a,--output-def,$name/lib/spoolflow.def"
cp "$root/spoolflow/export/c_interface/spoolflow.h" "$made/include/"
cp "$root/examples/c_interface/estimate.c" "$made/examples/"
cp "$root/LICENSE" "$made/LICENSE.txt"
cp "$root/NOTICE" "$made/NOTICE.txt"
rm -f "$out"
/usr/bin/python3 - "$out" "$name" "${SOURCE_DATE_EPOCH:-$(date +%s)}" <<'PYTHON'
import pathlib, sys, time, zipfile
out, name, epoch = sys.argv[1:]
with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
    for file in sorted(path for path in pathlib.Path(name).rglob("*") if path.is_file()):
        archive.writestr(zipfile.ZipInfo(str(file), time.gmtime(int(epoch))[:6]), file.read_bytes(), zipfile.ZIP_DEFLATED)
PYTHON
