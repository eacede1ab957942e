#!/bin/sh
# installed.sh BUILD SOURCE MODEL: installs to a prefix, moves it (nothing may remember where it was), and uses it from
# outside: the command, its manual page and completion, CMake's and pkg-config's way to the libraries.
set -eu
build=$1 source=$2 model=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cmake --install "$build" --prefix "$folder/first" >install.log
mv first prefix
prefix=$folder/prefix

"$prefix/bin/spoolflow" --version
gzip -dc "$prefix/share/man/man1/spoolflow.1.gz" | grep -q '^.SS spoolflow estimate'
complete() {
  bash -c '. "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _spoolflow; echo "${COMPREPLY[@]}"' \
    "$prefix/share/bash-completion/completions/spoolflow" "$@"
}
test "$(complete spoolflow est)" = estimate
test "$(complete spoolflow estimate --estimator c)" = condensed
complete spoolflow calibrate --re | grep -qx -- --report
touch valve.json
test "$(complete spoolflow estimate val)" = valve.json

cmake -S "$source/tests/package/consumer" -B consumer -DCMAKE_PREFIX_PATH="$prefix" >configure.log
cmake --build consumer >build.log
./consumer/core
expected=$(./consumer/static_c "$model")
echo "$expected"
test "$(./consumer/shared_c "$model")" = "$expected"

export PKG_CONFIG_PATH="$(dirname "$(find "$prefix" -name spoolflow.pc)")"
libraries=$(pkg-config --variable=libdir spoolflow)
cc "$source/tests/package/consumer/program.c" $(pkg-config --cflags --libs spoolflow) -lm -o shared
test "$(LD_LIBRARY_PATH=$libraries ./shared "$model")" = "$expected"
cc -static-libgcc "$source/tests/package/consumer/program.c" $(pkg-config --cflags spoolflow) "$libraries/libspoolflow.a" \
  $(pkg-config --static --libs-only-l spoolflow | sed 's/-lspoolflow//') -o static
test "$(./static "$model")" = "$expected"
