#!/bin/sh
# installed.sh PYTHON WHEEL [MODEL]: pip installs the wheel, without any index, where nothing of this package is; it says which version it is and under
# which licence; a wheel of manylinux links nothing but the system's C and C++ libraries and what it holds; and it works: with NumPy,
# by an estimate with MODEL, without by its compiled part alone.
set -eu
python=$1 wheel=$2 model=${3:-}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
unset PYTHONPATH LD_LIBRARY_PATH
"$python" -m venv --system-site-packages --without-pip "$folder/venv"
"$python" -m pip --python "$folder/venv/bin/python" install -q --no-index --no-deps --no-cache-dir --disable-pip-version-check --root-user-action=ignore "$wheel" 2>/dev/null ||
  { "$python" -m venv --system-site-packages "$folder/venv" && "$folder/venv/bin/python" -m pip install -q --no-index --no-deps --no-cache-dir "$wheel"; }
cd "$folder"
"$folder/venv/bin/python" -B - "$folder/venv" "$wheel" $model <<'PYTHON'
import importlib.metadata, importlib.util, pathlib, re, subprocess, sys
venv, wheel = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).name
about = importlib.metadata.distribution("spoolflow")
site = pathlib.Path(about.locate_file("")).resolve()
assert venv.resolve() in site.parents, site
assert wheel.startswith(f"spoolflow-{about.version}-cp{sys.version_info[0]}{sys.version_info[1]}-"), wheel
fields = about.metadata
assert fields["License"] == "Apache-2.0" and fields["Summary"] and fields["Requires-Python"] == ">=3.9" and fields["Description-Content-Type"], fields
texts = {pathlib.Path(str(file)).name: file.locate().read_text(errors="replace") for file in about.files if "dist-info" in str(file)}
assert "Apache License" in texts["LICENSE"] and "pybind11" in texts["NOTICE"]
module, = (site / "spoolflow").glob("_native*.so")
linked = re.findall(r"^\s*(\S+) => (\S+)", subprocess.run(["ldd", module], check=True, stdout=subprocess.PIPE, universal_newlines=True).stdout, re.M)
own = [name for name, path in linked if str(site) in str(pathlib.Path(path).resolve())]
systems = {name for name, path in linked} - set(own)
if "manylinux" in wheel:
    beside = {name for name in systems if not re.match(r"lib(c|m|dl|rt|pthread|resolv|gcc_s|stdc\+\+)\.so\.|ld-linux|linux-vdso", name)}
    assert own and not beside, f"the wheel links {beside}"
    licences = [name for name in texts if name.endswith(".copyright")]
    assert len(licences) > 10 and all(texts[name].strip() for name in licences)
if importlib.util.find_spec("numpy"):
    import spoolflow
    assert spoolflow.__version__ == about.version
    if len(sys.argv) > 3:
        answer = spoolflow.load_model(sys.argv[3]).estimate(time_s=[0, 1e-3], current_A=[0, 0], position_m=[0, 0])
        assert len(answer.flow_m3_per_s) == 2 and answer.flow_upper_m3_per_s[1] >= 0, answer
    how = "works"
else:
    spec = importlib.util.spec_from_file_location("_native", module)
    native = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(native)
    assert native.__version__ == about.version and native.status_text(0) is not None
    how = "its compiled part loads and answers; NumPy is not here to try more"
print(f"{wheel}: {len(own)} libraries of its own, {len(systems)} of the system; {how}")
PYTHON
