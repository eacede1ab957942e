#!/bin/sh
# read.sh tables|arrays COMMAND MODEL FOLDER: what `estimate` writes, read by readers of other projects: Parquet by a package of
# npm, HDF5 and MATLAB by Debian's python3-h5py and python3-scipy.
set -eu
what=$1 command=$2 model=$3 folder=$4/$1
here=$(cd "$(dirname "$0")" && pwd)
skip() {
  echo "SKIPPED: $1"
  exit 77
}
mkdir -p "$folder"
cd "$folder"
if [ "$what" = tables ]; then
  command -v node >/dev/null && command -v npm >/dev/null || skip "node or npm is not installed (Debian: nodejs, npm)"
  cp "$here/package.json" "$here/package-lock.json" "$here/tables.mjs" .
  # Packages come with their sha512 in the lock file; their own scripts do not run.
  if ! npm ci --ignore-scripts --no-audit --no-fund --prefer-offline --fetch-retries=1 >npm.log 2>&1; then
    grep -q -E 'EINTEGRITY|EUSAGE' npm.log && { cat npm.log; exit 1; }
    skip "npm could not fetch the packages of package-lock.json"
  fi
  read="node tables.mjs" formats="parquet"
else
  /usr/bin/python3 -c 'import h5py, scipy' 2>/dev/null || skip "python3-h5py or python3-scipy is not installed"
  read="/usr/bin/python3 $here/arrays.py" formats="h5 mat"
fi
/usr/bin/python3 "$here/rows.py"
for name in run gaps; do
  for format in csv $formats; do "$command" estimate -q "$model" - -o "$name-read.$format" <$name.csv; done
  $read "$name-read"
done
