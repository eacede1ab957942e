"""Builds the wheel of the Python package (PEP 517) by CMake, with the standard library alone: nothing is fetched.

    python3 -m build --wheel --no-isolation

What CMake needs (packages.txt, pybind11, NumPy) must be there. `SPOOLFLOW_BUILD` names a build folder to use and keep, so
that what is built already is not built again; else build/wheel. The wheel is for this machine's kind of processor and system
and for this Python; the libraries that the module links (HDF5, matio, OpenSSL, fmt) are the system's.
"""
import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
NAME = "spoolflow"


def _version():
    return re.search(r"project\(spoolflow VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


def _metadata():
    return (f"Metadata-Version: 2.1\nName: {NAME}\nVersion: {_version()}\n"
            "Summary: Soft flow-rate sensor for solenoid-operated spool valves\n"
            "Requires-Python: >=3.9\nRequires-Dist: numpy\n"
            "Provides-Extra: pandas\nRequires-Dist: pandas; extra == \"pandas\"\n"
            "Provides-Extra: plot\nRequires-Dist: matplotlib; extra == \"plot\"\n"
            "Description-Content-Type: text/markdown\n\n" + (ROOT / "docs" / "python.md").read_text())


def _tag():
    version = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{version}-{version}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def _built():
    """The folder in which the package stands, built for this Python."""
    build = pathlib.Path(os.environ.get("SPOOLFLOW_BUILD", ROOT / "build" / "wheel"))
    if not (build / "build.ninja").exists():
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DCMAKE_UNITY_BUILD=ON", "-DSPOOLFLOW_TESTS=OFF", "-DSPOOLFLOW_BENCH=OFF", "-DSPOOLFLOW_ADDONS=python;formats;cross",
                        f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "addons_python_module"], check=True)
    return build / "python" / NAME


def _digest(content):
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = pathlib.Path(metadata_directory) / f"{NAME}-{_version()}.dist-info"
    folder.mkdir()
    (folder / "METADATA").write_text(_metadata())
    return folder.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    built = _built()
    info = f"{NAME}-{_version()}.dist-info"
    module = f"_native{sysconfig.get_config_var('EXT_SUFFIX')}"
    if not (built / module).exists():
        raise SystemExit(f"{built / module} was not built: the build folder is for another Python than {sys.executable}")
    files = {}
    for path in sorted((ROOT / "addons" / "python" / "package" / NAME).iterdir()):
        if path.suffix in (".py", ".pyi") or path.name == "py.typed":
            files[f"{NAME}/{path.name}"] = path.read_bytes()
    files[f"{NAME}/{module}"] = (built / module).read_bytes()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: {NAME}\nRoot-Is-Purelib: false\nTag: {_tag()}\n").encode()
    record = "".join(f"{name},{_digest(content)},{len(content)}\n" for name, content in files.items())
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    wheel = f"{NAME}-{_version()}-{_tag()}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            about = zipfile.ZipInfo(name)  # of no date, so that the same files are the same wheel
            about.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
            about.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(about, content)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    """The files that git keeps."""
    base = f"{NAME}-{_version()}"
    kept = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True, stdout=subprocess.PIPE).stdout
    archive = pathlib.Path(sdist_directory) / f"{base}.tar.gz"
    with tarfile.open(archive, "w:gz", format=tarfile.PAX_FORMAT) as tar:
        for name in sorted(filter(None, kept.decode().split("\0"))):
            tar.add(ROOT / name, f"{base}/{name}", recursive=False)
        about = pathlib.Path(sdist_directory) / "PKG-INFO"
        about.write_text(_metadata())
        tar.add(about, f"{base}/PKG-INFO")
        about.unlink()
    return archive.name
