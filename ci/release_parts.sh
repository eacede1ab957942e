#!/bin/sh
# ci/release_parts.sh OUT PART…: makes parts of a release from the sources that it stands in (ci/release.sh calls it in a bare root):
#   core        Debian packages of command, libraries and headers; with `addons` those of live, fleet, Python, too, and cross and formats in the command
#   addons      see core
#   arm64       the same packages for 64-bit Arm, without Python
#   wheels      of each CPython that is here
#   fmus        of the virtual valves, and of the sensor of examples/live
#   libraries   firmware's static libraries of that sensor for each core, and the C library for Windows
#   playground  the program in a browser, one page
# SOURCE_DATE_EPOCH must be set. The same sources and packages give the same bytes wherever they stand.
set -eu
cd "$(dirname "$(readlink -f "$0")")/.."
root=$PWD
out=$(mkdir -p "$1" && readlink -f "$1")
shift
: "${SOURCE_DATE_EPOCH:?must be set}"
export LC_ALL=C.UTF-8 TZ=UTC
umask 022
asked() { case " $parts " in *" $1 "*) ;; *) return 1 ;; esac; }
parts="$*"
for part in "$@"; do
  case "$part" in core | addons | arm64 | wheels | fmus | libraries | playground) ;; *) echo "ci/release_parts.sh: no part '$part'" >&2; exit 2 ;; esac
done

# An archive of a folder: sorted, of one time and one owner.
packed() { # FOLDER NAME
  tar --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner --mode=go=rX,u+rw -C "$1" -cf - "$2" | gzip -9n >"$out/$2.tar.gz"
}

with=
needed=
if asked addons || asked arm64 || asked fmus || asked libraries; then with="formats;cross;live;fleet;python" needed="formats cross live fleet python firmware"; fi
ci/packages.sh release $needed
build=$root/build/release
# Nothing that is made holds where it was made.
export CFLAGS="-ffile-prefix-map=$root=." CXXFLAGS="-ffile-prefix-map=$root=."
if asked core || [ "$with" ]; then
  cmake --preset release -DSPOOLFLOW_TESTS=OFF -DSPOOLFLOW_BENCH=OFF "-DSPOOLFLOW_ADDONS=$with" -DCMAKE_BUILD_WITH_INSTALL_RPATH=ON \
    -DPython3_EXECUTABLE=/usr/bin/python3 >"$root/configure.log"
  ninja -C "$build" all >"$root/build.log" || { tail -50 "$root/build.log" >&2; exit 1; }
fi
version=$(sed -n 's/^project(spoolflow VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
if asked core; then
  (cd "$root/build" && cpack --config "$build/CPackConfig.cmake" -B "$root/build/packages" >"$root/cpack.log") || { cat "$root/cpack.log" >&2; exit 1; }
  cp build/packages/*.deb "$out"
  [ ! -e "$build/package/spoolflow.spdx.json" ] || cp "$build/package/spoolflow.spdx.json" "$out/spoolflow-$version.spdx.json"
fi
if asked arm64; then
  SPOOLFLOW_PLAIN_BUILD=$build addons/cross/arm64_packages.sh "$root/build/arm64" >"$root/arm64.log"
  cp build/arm64/packages/*.deb "$out"
fi
if asked wheels; then
  ci/packages.sh python formats cross
  ci/wheels.sh "$out" >"$root/wheels.log"
fi
spoolflow=$build/bin/spoolflow
model=examples/live/size_6.json
if asked fmus; then
  for valve in size_6 size_10 fast_dither whole_size_6 whole_differential; do
    for fmi in 2 3; do "$spoolflow" export fmu $valve --fmi $fmi -o "$out/valve_${valve}_fmi$fmi.fmu"; done
  done
  for fmi in 2 3; do "$spoolflow" export fmu $model --fmi $fmi -o "$out/sensor_size_6_fmi$fmi.fmu"; done
fi
if asked libraries; then
  for core in cortex-m4f cortex-m7 cortex-m33 cortex-m3 cortex-m0plus; do
    mkdir -p build/libraries
    "$spoolflow" export c $model --target $core -o "build/libraries/spoolflow-$version-size_6-$core"
    packed build/libraries "spoolflow-$version-size_6-$core"
  done
  addons/cross/windows_library.sh "$out/spoolflow-$version-windows-x64.zip"
fi
if asked playground; then
  ci/packages.sh playground
  addons/playground/wasm/build.sh "$root/build/page" >"$root/playground.log"
  cp build/page/playground.html "$out/spoolflow-$version-playground.html"
fi
