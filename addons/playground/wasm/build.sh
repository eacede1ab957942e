#!/bin/sh
# addons/playground/wasm/build.sh [OUT]: makes OUT/playground.html (out/playground otherwise), the page that works in a browser alone. Needs
# emscripten (Debian: emscripten), cmake, ninja, node and npm; its working files are in build/playground. No part of ./run or ./test.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
out=${1:-$root/out/playground}
work=$root/build/playground
command -v emcc >/dev/null || {
  echo "build.sh: emcc is not installed; on Debian: apt-get install --no-install-recommends emscripten" >&2
  exit 1
}
# Debian's emscripten finds its packages for Node there, whichever Node comes first on PATH.
export NODE_PATH="${NODE_PATH:-}${NODE_PATH:+:}/usr/share/nodejs"
toolchain=$(dirname "$(readlink -f "$(command -v emcc)")")/cmake/Modules/Platform/Emscripten.cmake
[ -e "$toolchain" ] || toolchain=/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake
mkdir -p "$work" "$out"
out=$(cd "$out" && pwd)
cmake -S "$here" -B "$work/program" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$toolchain" -DCMAKE_BUILD_TYPE=None >"$work/configure.log"
ninja -C "$work/program" playground
ninja -C "$work/program" -t deps >"$work/program/deps.txt"
"$root/tests/web/packages.sh" "$root/web" "$work/page"
cp "$here/build.mjs" "$work/page/build_playground.mjs"
(cd "$work/page" && node node_modules/typescript/bin/tsc --noEmit &&
  node build_playground.mjs "$work/program" "$out" "$root")
