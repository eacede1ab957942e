#!/bin/sh
# debian.sh BUILD MODEL: makes the packages and looks into them; the command runs from where it was unpacked.
set -eu
build=$1 model=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cpack --config "$build/CPackConfig.cmake" -B "$folder/made" >cpack.log 2>&1 || { cat cpack.log; exit 1; }
tool=$(ls made/spoolflow_*.deb) development=$(ls made/libspoolflow-dev_*.deb)
dpkg-deb --field "$tool" Depends | grep -q 'libc6'
for file in usr/bin/spoolflow usr/share/man/man1/spoolflow.1 usr/share/bash-completion/completions/spoolflow; do
  dpkg-deb --contents "$tool" | grep -q " ./$file$"
done
for file in usr/include/spoolflow.h usr/include/spoolflow/sensor/observer.hpp spoolflow.pc spoolflowConfig.cmake libspoolflow.a libspoolflow.so; do
  dpkg-deb --contents "$development" | grep -q "[ /]$(basename $file)\( -> .*\)\?$"
done
dpkg-deb --extract "$tool" root
root/usr/bin/spoolflow --version
! dpkg-deb --contents "$tool" | grep -q 'spoolflow\.h'
