#!/bin/sh
# ci/build.sh PRESET TARGET [CMAKE_OPTION…]: configures where needed and builds. All messages go to standard error, and
# there are few where all is well.
set -eu
cd "$(dirname "$0")/.."
preset=$1
target=$2
shift 2
build=build/$preset
mkdir -p "$build"
exec 9>"$build.lock"
flock 9 # two commands at once must not build in one folder

if [ ! -e "$build/build.ninja" ]; then echo "building in $build; the first time takes minutes" >&2; fi
if [ ! -e "$build/build.ninja" ] || [ $# -gt 0 ]; then
  if command -v ccache >/dev/null; then set -- "$@" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
  if ! cmake --preset "$preset" "$@" >"$build/configure.log" 2>&1 </dev/null; then
    cat "$build/configure.log" >&2
    exit 1
  fi
fi
if [ -t 2 ]; then
  ninja -C "$build" "$target" >&2 </dev/null 9>&-
elif ! ninja -C "$build" "$target" >"$build/build.log" 2>&1 </dev/null 9>&-; then
  grep -v '^\[[0-9]*/[0-9]*\] ' "$build/build.log" >&2
  exit 1
fi
