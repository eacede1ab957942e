#!/bin/sh
# ci/tidy.sh BUILD FOLDER: clang-tidy over the folder's *.cpp with BUILD's compile commands. A file that passed is looked
# at again only when it, a header of the project that it includes, its compile command or the checks change.
set -eu
build=$1
folder=$2
cd "$(dirname "$0")/.."
root=$(pwd)
passed=$build/tidy
mkdir -p "$passed"
settings=$( (clang-tidy --version && cat .clang-tidy) | sha256sum)
failed=0
for source in "$folder"/*.cpp; do
  [ -e "$source" ] || continue
  # One block of `ninja -t deps` an object; the source itself is its first line.
  headers=$(ninja -C "$build" -t deps | awk -v source="$root/$source" -v root="$root/" '
    /^[^ ]/ { first = 1; next }
    NF == 0 { inside = 0; next }
    { path = $1; if (first) { inside = path == source; first = 0 }
      if (inside && index(path, root) == 1) print path }' | sort -u)
  command=$(grep -F "$root/$source" "$build/compile_commands.json" || true)
  key=$( (echo "$settings $command" && cat "$source" $headers) | sha256sum | cut -d' ' -f1)
  mark=$passed/$(echo "$source" | tr / .)
  if [ "$(cat "$mark" 2>/dev/null)" = "$key" ]; then continue; fi
  if clang-tidy -p "$build" --quiet "$source" 2>"$mark.log"; then
    echo "$key" >"$mark"
  else
    grep -v 'warnings generated\|^Suppressed\|^Use -header-filter' "$mark.log" || true
    failed=1
  fi
done
exit $failed
