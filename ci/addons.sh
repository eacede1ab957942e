#!/bin/sh
# ci/addons.sh ADDON…: prints the options of CMake with which the release build has these add-ons beside those that it has
# already; nothing where it has them. A build that is not there yet gets no tests and no benchmarks.
set -eu
cache=$(dirname "$0")/../build/release/CMakeCache.txt
had=$(sed -n 's/^SPOOLFLOW_ADDONS:STRING=//p' "$cache" 2>/dev/null || true)
all=$had
if [ "$had" != all ]; then
  for addon in "$@"; do
    case ";$all;" in *";$addon;"*) ;; *) all="${all:+$all;}$addon" ;; esac
  done
fi
if [ ! -e "$cache" ]; then echo "-DSPOOLFLOW_TESTS=OFF -DSPOOLFLOW_BENCH=OFF -DSPOOLFLOW_ADDONS=$all"; fi
if [ -e "$cache" ] && [ "$all" != "$had" ]; then echo "-DSPOOLFLOW_ADDONS=$all"; fi
