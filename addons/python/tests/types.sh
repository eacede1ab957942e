#!/bin/sh
# types.sh PYTHON SOURCE BUILD: the package's annotations and its stub hold together, as mypy's strictest reading has it.
set -eu
"$1" -c 'import mypy' 2>/dev/null || {
  echo "SKIPPED: mypy is not installed (Debian: python3-mypy)"
  exit 77
}
cd "$2"
exec "$1" -m mypy --strict --cache-dir "$3/mypy" addons/python/package/spoolflow
