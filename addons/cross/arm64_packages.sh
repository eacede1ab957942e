#!/bin/sh
# arm64_packages.sh FOLDER: the Debian packages of the command and the libraries for 64-bit Arm, cross-compiled here, in FOLDER/packages.
# FOLDER also keeps what that takes (libraries of Debian's arm64 packages, the build), so that a second call is quick. Needs Debian's package
# archive, g++-aarch64-linux-gnu, dpkg-dev, a built release of this machine's own (pages and libraries for other platforms come from it).
# The Python package is not among them: its headers would have to be of the other machine's Python.
set -eu
folder=$(mkdir -p "$1" && realpath "$1")
root=$(cd "$(dirname "$0")/../.." && pwd)
plain=${SPOOLFLOW_PLAIN_BUILD:-$root/build/release}
[ -x "$plain/bin/spoolflow" ] || { echo "no $plain/bin/spoolflow: build the release first (ci/build.sh release installable)" >&2; exit 2; }
sysroot=$folder/sysroot

# A package archive of its own, so that nothing of this machine's system changes.
archive=$folder/archive
mkdir -p "$archive/lists/partial" "$archive/cache/archives/partial"
touch "$archive/status"
cat >"$archive/apt.conf" <<END
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
Dir::State "$archive";
Dir::State::status "$archive/status";
Dir::Cache "$archive/cache";
END
if [ ! -e "$sysroot/complete" ]; then
  libraries=$(sed -e 's/|.*//' -e '/^#/d' "$root/packages.txt" "$root/addons/formats/packages.txt" "$root/addons/live/packages.txt" "$root/addons/fleet/packages.txt" | grep -- '-dev$')
  APT_CONFIG=$archive/apt.conf apt-get -qq update
  APT_CONFIG=$archive/apt.conf apt-get -qq --yes --no-install-recommends --download-only install \
    libc6-dev libstdc++-12-dev $libraries
  rm -rf "$sysroot"
  mkdir "$sysroot"
  for package in "$archive"/cache/archives/*.deb; do dpkg-deb --extract "$package" "$sysroot"; done
  touch "$sysroot/complete"
fi

lib=$sysroot/usr/lib/aarch64-linux-gnu
export PKG_CONFIG_SYSROOT_DIR="$sysroot" PKG_CONFIG_LIBDIR="$lib/pkgconfig:$sysroot/usr/share/pkgconfig"
launcher=
if command -v ccache >/dev/null; then launcher=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
cmake -S "$root" -B "$folder/build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$root/addons/cross/aarch64_linux.cmake" -DSPOOLFLOW_SYSROOT="$sysroot" \
  -DCMAKE_BUILD_TYPE=Release -DSPOOLFLOW_TESTS=OFF -DSPOOLFLOW_BENCH=OFF -DSPOOLFLOW_PLAIN_BUILD="$plain" -DSPOOLFLOW_ADDONS="formats;cross;live;fleet" \
  -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 $launcher >"$folder/configure.log" 2>&1 ||
  { cat "$folder/configure.log" >&2; exit 1; }
ninja -C "$folder/build" installable >&2

# What the programs are linked with, by the packages that hold it: dpkg-shlibdeps knows this machine's alone.
for package in "$archive"/cache/archives/*.deb; do
  case "$package" in *-dev_*) continue ;; esac
  one="$(dpkg-deb --field "$package" Package) (>= $(dpkg-deb --field "$package" Version | sed 's/^\([0-9]*:\)\?\([^-+~]*\).*/\1\2/'))"
  dpkg-deb --contents "$package" | sed -n "s|.*/\([^/ ]*\.so\.[^ ]*\).*|\1:$one|p"
done >"$archive/holders"
depends_of() { # PROGRAM
  for needed in $(aarch64-linux-gnu-objdump -p "$folder/build/bin/$1" | sed -n 's/^ *NEEDED *//p'); do
    sed -n "s/^$needed://p" "$archive/holders" | head -1
  done | sort -u | paste -sd, | sed 's/,/, /g'
}
own="spoolflow (= $(sed -n 's/^project(spoolflow VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt"))"
rm -rf "$folder/packages"
(cd "$folder" && cpack --config build/CPackConfig.cmake -B packages -D CPACK_DEBIAN_PACKAGE_ARCHITECTURE=arm64 -D CPACK_DEBIAN_PACKAGE_SHLIBDEPS=OFF \
  -D CPACK_DEBIAN_TOOL_PACKAGE_DEPENDS="$(depends_of spoolflow)" \
  -D CPACK_DEBIAN_LIVE_PACKAGE_DEPENDS="$own, $(depends_of spoolflow-live)" -D CPACK_DEBIAN_FLEET_PACKAGE_DEPENDS="$own, $(depends_of spoolflow-fleet)" \
  -D CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS="libc6, libstdc++6, libgcc-s1" \
  >cpack.log 2>&1) || { cat "$folder/cpack.log" >&2; exit 1; }
rm -rf "$folder/packages/_CPack_Packages"
ls "$folder"/packages/*.deb
