#!/bin/sh
# ci/tidy.sh BUILD FOLDER: clang-tidy over the folder's *.cpp with BUILD's compile commands. All files are looked at as one
# translation unit, since most of the time goes into the libraries' headers; where two files use the same name for
# different things, as the build compiles them. A folder that passed is looked at again only when it, a header of the
# project or the checks change.
set -eu
build=$1
folder=$2
cd "$(dirname "$0")/.."
root=$(pwd)
passed=$build/tidy
mkdir -p "$passed"
mark=$passed/$(echo "$folder" | tr / .)

ls "$folder"/*.cpp >/dev/null 2>&1 || exit 0 # headers only: seen with those who include them

# what all the folder's compile commands define and include, or where its files are joined to others', those of the folder above
compiled=$folder
commands() { grep -F '"command":' "$build/compile_commands.json" | grep -e "-o $compiled/CMakeFiles/"; }
while ! commands >"$mark.commands"; do
  [ "$compiled" != . ] || { echo "ci/tidy.sh: $build/compile_commands.json compiles no file of $folder: configure it with its add-on" >&2; exit 1; }
  compiled=$(dirname "$compiled")
done
commands=$(tr ' ' '\n' <"$mark.commands" | tr -d '",')
flags=$(printf "%s\n" "$commands" | grep -E '^(-D|-I|-std|/)' | grep -v -e '\.c[px][px]$' -e 'c++$' -e 'ccache$' |
        sed -e 's,^/,-isystem/,' -e 's,\\\\\\,",g' | sort -u || true)
key=$( (clang-tidy --version; cat .clang-tidy; echo "$flags"; cat "$folder"/*.cpp; find spoolflow addons -name '*.hpp' | sort | xargs cat) | sha256sum)
if [ "$(cat "$mark" 2>/dev/null)" = "$key" ]; then exit 0; fi

# tidy SOURCE
tidy() { clang-tidy --quiet "$1" -- $flags >"$mark.found" 2>"$mark.log"; }
# report: what the last one found
report() { cat "$mark.found"; grep -v -e 'warnings\? generated' -e '^Suppressed' -e '^Use -header-filter' "$mark.log" || true; }
for source in "$folder"/*.cpp; do echo "#include \"$root/$source\""; done >"$mark.all.cpp"
failed=0
if ! tidy "$mark.all.cpp"; then
  if grep -q 'clang-diagnostic-error' "$mark.found"; then
    for source in $(printf "%s\n" "$commands" | grep -e "^$root/.*\.c[px][px]$"); do
      if [ "$(dirname "$source")" = "$root/$folder" ] || grep -q "\"$root/$folder/[^/]*\.cpp\"" "$source"; then
        tidy "$source" || { report; failed=1; }
      fi
    done
  else
    report
    failed=1
  fi
fi
if [ $failed = 0 ]; then echo "$key" >"$mark"; fi
exit $failed
