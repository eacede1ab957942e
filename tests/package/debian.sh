#!/bin/sh
# debian.sh BUILD MODEL: makes the packages and looks into them, by lintian too where it is there; the command runs from
# where it was unpacked.
set -eu
build=$1 model=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
major=$(sed -n 's/^CMAKE_PROJECT_VERSION_MAJOR:STATIC=//p' "$build/CMakeCache.txt")
cpack --config "$build/CPackConfig.cmake" -B "$folder/made" >cpack.log 2>&1 || { cat cpack.log; exit 1; }
tool=$(ls made/spoolflow_*.deb) runtime=$(ls made/libspoolflow${major}_*.deb) development=$(ls made/libspoolflow-dev_*.deb)
holds() {
  dpkg-deb --contents "$1" >contents
  grep -q "/$2\( -> .*\)\?$" contents
}
holds_not() { if holds "$1" "$2"; then echo "$1 holds $2" && exit 1; fi; }
dpkg-deb --field "$tool" Depends | grep -q 'libc6'
dpkg-deb --field "$development" Depends | grep -q "libspoolflow$major (= "
for file in usr/bin/spoolflow usr/share/man/man1/spoolflow.1.gz usr/share/bash-completion/completions/spoolflow usr/share/doc/spoolflow/spoolflow.spdx.json usr/share/doc/spoolflow/CHANGELOG.md; do
  holds "$tool" $file
done
for file in spoolflow.h spoolflow/sensor/observer.hpp spoolflow.pc spoolflowConfig.cmake libspoolflow.a libspoolflow.so; do
  holds "$development" $file
done
# Programs need the shared library alone: by its name for them, known to dpkg-shlibdeps and to the loader's cache.
holds "$runtime" libspoolflow.so.$major
dpkg-deb --info "$runtime" shlibs | grep -q "^libspoolflow $major libspoolflow$major"
dpkg-deb --info "$runtime" triggers | grep -q 'ldconfig'
for package in "$tool" "$development"; do
  holds_not "$package" libspoolflow.so.$major
done
# Programs of add-ons, each with its libraries and the command.
for program in live fleet; do
  if [ -e "$build/bin/spoolflow-$program" ]; then
    holds "$(ls made/spoolflow-${program}_*.deb)" usr/bin/spoolflow-$program
    holds_not "$tool" usr/bin/spoolflow-$program
    dpkg-deb --field made/spoolflow-${program}_*.deb Depends | grep -q 'spoolflow (= .*libssl\|libssl.*spoolflow (= '
  fi
done
# The Python package, where it is built.
python=$(ls made/python3-spoolflow_*.deb 2>/dev/null || true)
if [ -n "$python" ]; then
  for file in __init__.py _native.pyi py.typed '_native.cpython-[0-9]*-[a-z0-9_-]*-gnu.so'; do
    holds "$python" "usr/lib/python3/dist-packages/spoolflow/$file"
  done
  dpkg-deb --field "$python" Depends | grep -q 'python3 (<< .*python3-numpy'
  dpkg-deb --field "$python" Depends | grep -q 'libhdf5'
  dpkg-deb --extract "$python" root
  PYTHONPATH=root/usr/lib/python3/dist-packages /usr/bin/python3 -B -c \
    "import spoolflow, sys; print(spoolflow.load_model(sys.argv[1]).estimate(time_s=[0], current_A=[0], position_m=[0]))" "$model"
fi
for package in "$tool" "$runtime" "$development" $python; do
  dpkg-deb --field "$package" Maintainer | grep -q '@'
  holds "$package" copyright
  holds "$package" changelog.gz
done
dpkg-deb --extract "$tool" root
root/usr/bin/spoolflow --version
holds_not "$tool" spoolflow.h
# Not among packages.txt: it brings 124 packages of Perl for three that are looked at.
if command -v lintian >/dev/null; then
  lintian --allow-root --fail-on error "$tool" "$runtime" "$development" $python
fi
