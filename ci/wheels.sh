#!/bin/sh
# ci/wheels.sh DIR [PYTHON…]: wheels of the Python package in DIR, one for each PYTHON, with the libraries that they need (patchelf), each tried in
# a fresh environment. Without PYTHON: for python3.9 to python3.13 as far as they are here with their headers, in /usr/bin, in
# PATH or below ~/.pyenv; says which are not. Built in the folder $SPOOLFLOW_BUILD, else build/wheels.
set -eu
root=$(dirname "$(dirname "$(readlink -f "$0")")")
mkdir -p "$1"
out=$(readlink -f "$1")
shift
export SPOOLFLOW_BUILD="${SPOOLFLOW_BUILD:-$root/build/wheels}" SPOOLFLOW_PORTABLE=1 PYTHONDONTWRITEBYTECODE=1
command -v patchelf >/dev/null || { echo "patchelf is missing: apt-get install patchelf" >&2; exit 1; }

builds() { # whether it runs and has its headers
  "$1" -c 'import os, sys, sysconfig; sys.exit(not os.path.exists(sysconfig.get_path("include") + "/Python.h"))' 2>/dev/null
}
if [ $# = 0 ]; then
  for minor in 9 10 11 12 13; do
    found=
    for python in "/usr/bin/python3.$minor" "$(command -v python3.$minor || true)" "$HOME"/.pyenv/versions/3.$minor.*/bin/python3.$minor; do
      if [ -x "$python" ] && builds "$python"; then found=$python && break; fi
    done
    if [ "$found" ]; then set -- "$@" "$found"; else echo "CPython 3.$minor: not here with its headers, no wheel" >&2; fi
  done
fi
pythons=$(printf '%s;' "$@")
cmake -S "$root" -B "$SPOOLFLOW_BUILD" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DSPOOLFLOW_TESTS=OFF -DSPOOLFLOW_BENCH=OFF \
  "-DSPOOLFLOW_ADDONS=python;formats;cross" "-DSPOOLFLOW_MORE_PYTHONS=${pythons%;}"

for python in "$@"; do
  wheel=$(cd "$root/addons/python/package" && "$python" -c "import sys, wheel_backend; print(wheel_backend.build_wheel(sys.argv[1]))" "$out" | tail -1)
  "$root/addons/python/tests/installed.sh" "$python" "$out/$wheel"
done
