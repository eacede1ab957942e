"""Builds the wheel of the Python package (PEP 517) by CMake, with the standard library alone: nothing is fetched.

    python3 -m build --wheel --no-isolation

What CMake needs (packages.txt, pybind11, NumPy) must be there. `SPOOLFLOW_BUILD` names a build folder to use and keep, so
that what is built already is not built again; else build/wheel. The wheel is for this machine's kind of processor and system
and for this Python; the libraries that the module links (HDF5, matio, OpenSSL, fmt) are the system's. With `SPOOLFLOW_PORTABLE=1`
(needs patchelf) the wheel holds them, with their licences, but for those that every Linux of manylinux has; its tag says which
C library it needs at least. ci/wheels.sh makes one for each Python that is there.
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
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
NAME = "spoolflow"


def _version():
    return re.search(r"project\(spoolflow VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


def _metadata():
    return (f"Metadata-Version: 2.1\nName: {NAME}\nVersion: {_version()}\n"
            "Summary: Soft flow-rate sensor for solenoid-operated spool valves\n"
            "License: Apache-2.0\nLicense-File: LICENSE\nLicense-File: NOTICE\nKeywords: hydraulics,spool valve,flow rate,soft sensor\n"
            "Classifier: License :: OSI Approved :: Apache Software License\nClassifier: Operating System :: POSIX :: Linux\n"
            "Classifier: Programming Language :: C++\nClassifier: Topic :: Scientific/Engineering\n"
            + "".join(f"Classifier: Programming Language :: Python :: 3.{minor}\n" for minor in range(9, 14)) +
            "Requires-Python: >=3.9\nRequires-Dist: numpy\n"
            "Provides-Extra: pandas\nRequires-Dist: pandas; extra == \"pandas\"\n"
            "Provides-Extra: plot\nRequires-Dist: matplotlib; extra == \"plot\"\n"
            "Description-Content-Type: text/markdown\n\n" + (ROOT / "docs" / "python.md").read_text())


def _tag(platform):
    version = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{version}-{version}-{platform}"


# What manylinux lets a wheel take from the system.
SYSTEMS = re.compile(r"(lib(c|m|dl|rt|pthread|resolv|gcc_s|stdc\+\+)\.so\.\d+|ld-linux.*|linux-vdso.*)$")
OLDEST_GLIBC = 36  # of Debian 12, whose GCC 12 has the libstdc++ that the module is built with


def _said(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def _needed(library):
    """The paths of the libraries that it needs, in depth, without those of every system."""
    found = dict(re.findall(r"^\s*(\S+) => (/\S+)", _said("ldd", library), re.M))
    missing = re.findall(r"^\s*(\S+) => not found", _said("ldd", library), re.M)
    if missing:
        raise SystemExit(f"{library} needs {', '.join(missing)}, which are not here")
    return {name: pathlib.Path(path).resolve() for name, path in found.items() if not SYSTEMS.match(name)}


def _licence_of(library):
    """Of the Debian package that a library comes from: its name and copyright file; None where none has it."""
    for path in (library, str(library).replace("/usr/lib/", "/lib/", 1)):
        package = subprocess.run(["dpkg-query", "-S", str(path)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout.split(":")[0]
        text = pathlib.Path("/usr/share/doc") / package / "copyright"
        if package and text.exists():
            return package, text.read_bytes()
    raise SystemExit(f"{library}: no package of Debian's says under which licence it is")


def _bundled(module):
    """The module and the libraries that go with it by their path in the wheel, their licences, and the platform's tag."""
    needed, files, licences = _needed(module), {}, {}
    with tempfile.TemporaryDirectory() as place:
        copies = {}
        for name, path in needed.items():
            stem, _, rest = name.partition(".so")
            copies[name] = f"{stem}-{hashlib.sha256(path.read_bytes()).hexdigest()[:8]}.so{rest}"  # of no other wheel's
        for name, path in [(module.name, module), *needed.items()]:
            copy = pathlib.Path(place) / copies.get(name, name)
            copy.write_bytes(path.read_bytes())
            copy.chmod(0o755)
            mine = _said("patchelf", "--print-needed", str(copy)).split()
            options = [word for each in mine if each in copies for word in ("--replace-needed", each, copies[each])]
            if options:
                _said("patchelf", *options, str(copy))
            if name in copies:
                _said("patchelf", "--set-soname", copy.name, str(copy))  # patchelf 0.14 drops others in one call with this
            _said("patchelf", "--set-rpath", "$ORIGIN" if name in copies else f"$ORIGIN/../{NAME}.libs", str(copy))
            files[f"{NAME}.libs/{copy.name}" if name in copies else f"{NAME}/{name}"] = copy.read_bytes()
            if name in copies:
                package, text = _licence_of(path)
                licences[f"licenses/{package}.copyright"] = text
        symbols = "".join(_said("objdump", "-T", str(each)) for each in pathlib.Path(place).iterdir())
    minor = max(OLDEST_GLIBC, *(int(each) for each in re.findall(r"GLIBC_2\.(\d+)", symbols)))
    return files, licences, f"manylinux_2_{minor}_{os.uname().machine}"


def _built():
    """The folder in which the package stands, built for this Python."""
    build = pathlib.Path(os.environ.get("SPOOLFLOW_BUILD", ROOT / "build" / "wheel"))
    if not (build / "build.ninja").exists():
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DCMAKE_UNITY_BUILD=ON", "-DSPOOLFLOW_TESTS=OFF", "-DSPOOLFLOW_BENCH=OFF", "-DSPOOLFLOW_ADDONS=python;formats;cross",
                        f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "addons_python_modules"], check=True)
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
    if os.environ.get("SPOOLFLOW_PORTABLE"):
        libraries, licences, platform = _bundled(built / module)
        files.update(libraries)
        files.update({f"{info}/{name}": text for name, text in licences.items()})
    else:
        files[f"{NAME}/{module}"] = (built / module).read_bytes()
        platform = re.sub("[-.]", "_", sysconfig.get_platform())
    for name in ("LICENSE", "NOTICE"):
        files[f"{info}/{name}"] = (ROOT / name).read_bytes()
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: {NAME}\nRoot-Is-Purelib: false\nTag: {_tag(platform)}\n").encode()
    record = "".join(f"{name},{_digest(content)},{len(content)}\n" for name, content in files.items())
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    wheel = f"{NAME}-{_version()}-{_tag(platform)}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            about = zipfile.ZipInfo(name)  # of no date, so that the same files are the same wheel
            about.external_attr = (0o755 if ".so" in name else 0o644) << 16
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
