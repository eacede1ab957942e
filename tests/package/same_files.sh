#!/bin/sh
# same_files.sh SOURCE: ci/same_files.py, which compares a release with the same made again, finds a byte, a time and a file that one has alone,
# and names the member of an archive in which it lies.
set -eu
source=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir one two
echo code >file
packed() { tar --mtime="$1" --owner=0 --group=0 -cf - file | gzip -9n >"$2"; }
packed 2026-01-01 one/a.tar.gz
cp one/a.tar.gz two
"$source/ci/same_files.py" one two | grep -q '^a.tar.gz: the same'
packed 2026-01-02 two/a.tar.gz
if "$source/ci/same_files.py" one two >said; then echo "another time was not seen" && exit 1; fi
grep -q '^  file: ' said
cp one/a.tar.gz two
echo more >two/b
if "$source/ci/same_files.py" one two >said; then echo "a file more was not seen" && exit 1; fi
grep -q '^b: only in two' said
mkdir none also_none
if "$source/ci/same_files.py" none also_none >said; then echo "nothing counts as the same" && exit 1; fi
