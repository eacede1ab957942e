#!/bin/sh
# wheel.sh PYTHON SOURCE BUILD MODEL: makes a wheel of what is built, installs it where nothing else is, and uses it. With SPOOLFLOW_PORTABLE=1
# one that holds the libraries that it needs.
set -eu
python=$1 source=$2 build=$3 model=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
unset PYTHONPATH
export PYTHONDONTWRITEBYTECODE=1
if "$python" -c 'import build' 2>/dev/null; then
  SPOOLFLOW_BUILD=$build "$python" -m build --wheel --no-isolation --outdir made "$source" >build.log 2>&1 || { cat build.log; exit 1; }
else
  echo "python3-build is not installed: the wheel is made without it"
  mkdir made
  (cd "$source/addons/python/package" && SPOOLFLOW_BUILD=$build "$python" -B -c "import wheel_backend, sys; wheel_backend.build_wheel(sys.argv[1])" "$folder/made" >"$folder/build.log")
fi
wheel=$(ls made/spoolflow-*-cp3*linux_*.whl)
"$python" - "$wheel" site <<'PYTHON'
import base64, csv, hashlib, sys, zipfile
with zipfile.ZipFile(sys.argv[1]) as wheel:
    record = next(name for name in wheel.namelist() if name.endswith("/RECORD"))
    listed = {name: digest for name, digest, size in csv.reader(wheel.read(record).decode().splitlines())}
    assert set(listed) == set(wheel.namelist()), set(listed) ^ set(wheel.namelist())
    for name, digest in listed.items():
        content = base64.urlsafe_b64encode(hashlib.sha256(wheel.read(name)).digest()).rstrip(b"=").decode()
        assert name == record or digest == f"sha256={content}", name
    wheel.extractall(sys.argv[2])
PYTHON
"$source/addons/python/tests/installed.sh" "$python" "$folder/$wheel" "$model"
