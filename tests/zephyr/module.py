#!/usr/bin/python3
"""module.py SPOOLFLOW MODEL.json SOURCES: examples/zephyr as far as it can be shown without Zephyr.

Its YAML files hold what Zephyr's schemas of modules and bindings ask for, and name files, properties and settings that are there and
that the driver uses; its CMakeLists takes an exported folder, with a library or with sources, and refuses one that is none;
the driver compiles in C99 and C11, as for Zephyr 3 and 4, and for a Cortex-M4F, and runs on this host (driver_test.c) against stand-ins
for Zephyr's headers. PyYAML.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import yaml

WARNINGS = "-Wall -Wextra -Wpedantic -Wconversion -Werror".split()
# Recorders of what a module's CMakeLists asks of Zephyr's build.
RECORDER = """function(said what)
  string(REPLACE ";" "\\n" words "${ARGN}")
  message(STATUS "${what} ${words}")
endfunction()
foreach(name IN ITEMS zephyr_include_directories zephyr_library_named zephyr_library_sources zephyr_library_import)
  cmake_language(EVAL CODE "function(${name})\\n said(${name} \\${ARGN})\\nendfunction()")
endforeach()
"""


def run(*command, **more):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)
    return done.returncode, done.stdout


def works(*command, **more):
    status, said = run(*command, **more)
    assert status == 0, f"{command}: {said}"
    return said


def check_module(folder):
    about = yaml.safe_load((folder / "zephyr/module.yml").read_text())
    assert set(about) == {"name", "build"} and set(about["build"]) == {"cmake", "kconfig", "settings"}, about
    assert (folder / about["build"]["cmake"] / "CMakeLists.txt").is_file() and (folder / about["build"]["kconfig"]).is_file()
    bindings = list((folder / about["build"]["settings"]["dts_root"] / "dts/bindings").rglob("*.yaml"))
    assert len(bindings) == 1
    return bindings[0], (folder / about["build"]["kconfig"]).read_text()


def check_binding(path, driver, kconfig):
    binding = yaml.safe_load(path.read_text())
    assert set(binding) == {"description", "compatible", "include", "properties"} and binding["include"] == "sensor-device.yaml"
    assert path.stem == binding["compatible"] and binding["description"].strip()
    symbol = re.sub("[,.-]", "_", binding["compatible"])
    assert re.search(r"^#define DT_DRV_COMPAT (\w+)$", driver, re.M)[1] == symbol
    assert f"DT_HAS_{symbol.upper()}_ENABLED" in kconfig
    for name, each in binding["properties"].items():
        assert each["type"] in ("phandles", "int", "boolean", "string") and each["description"].strip(), name
    used = set(re.findall(r"\bDT_INST_\w+\(inst, (\w+)", driver))
    assert used == {name.replace("-", "_") for name in binding["properties"]}, used


def check_settings(kconfig, *texts):
    defined = {"CONFIG_" + name for name in re.findall(r"^config (\w+)$", kconfig, re.M)}
    used = {name for text in texts for name in re.findall(r"\bCONFIG_SPOOLFLOW\w*", text)}
    assert used == defined, used ^ defined
    kinds = re.findall(r"^\t(bool|int|string) \"[^\"]+\"$", kconfig, re.M)
    assert len(kinds) == len(defined) and kconfig.count("if SPOOLFLOW") == kconfig.count("endif")


def built(folder, export, place):
    (place / "ask.cmake").write_text(RECORDER + f'set(CONFIG_SPOOLFLOW y)\nset(CONFIG_SPOOLFLOW_EXPORT "{export}")\n'
                                     f'include("{folder}/zephyr/CMakeLists.txt")\n')
    status, said = run("cmake", "-P", place / "ask.cmake")
    files = [word for word in re.findall(r"/\S+", said) if status == 0]
    assert all(os.path.exists(file) for file in files), files
    return status, said


def check_build(folder, export, place):
    status, said = built(folder, export, place)
    assert status == 0 and "valve_flow.c" in said and f"{export}/valve_sensor.cpp" in said and "import" not in said, said
    with_library = place / "with_library"
    shutil.copytree(export, with_library)
    (with_library / "libvalve_sensor.a").touch()
    status, said = built(folder, with_library, place)
    assert status == 0 and "zephyr_library_import valve_sensor" in said and "valve_sensor.cpp" not in said, said
    status, said = built(folder, place, place)
    assert status != 0 and "CONFIG_SPOOLFLOW_EXPORT" in said, said


def check_driver(folder, here, export, place):
    options = [*WARNINGS, "-DCONFIG_SPOOLFLOW_CHECKED_WORDS=32", f"-I{folder}/include", f"-I{here}/include", f"-I{export}"]
    driver = folder / "drivers/valve_flow.c"
    for standard, version in (("c99", []), ("c11", ["-DTEST_ZEPHYR_4"])):
        works("gcc", f"-std={standard}", "-Wno-pedantic", *version, *options, "-c", driver, "-o", place / "driver.o")
    if shutil.which("arm-none-eabi-gcc"):
        works("arm-none-eabi-gcc", "-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16", "-std=c11", *options, "-c", driver,
              "-o", place / "arm.o")
    works("gcc", "-std=c11", *options, "-c", here / "driver_test.c", "-o", place / "test.o")
    works("g++", "-std=c++17", "-O1", "-I", export, "-c", export / "valve_sensor.cpp", "-o", place / "sensor.o")
    works("g++", place / "test.o", place / "driver.o", place / "sensor.o", "-o", place / "driver_test")
    works(place / "driver_test", place / "older.bin", place / "newer.bin")


def main(spoolflow, model, sources):
    here, folder = pathlib.Path(__file__).resolve().parent, pathlib.Path(sources).resolve() / "examples/zephyr"
    driver, cmake = (folder / "drivers/valve_flow.c").read_text(), (folder / "zephyr/CMakeLists.txt").read_text()
    binding, kconfig = check_module(folder)
    check_binding(binding, driver, kconfig)
    check_settings(kconfig, driver, cmake)
    with tempfile.TemporaryDirectory() as name:
        place = pathlib.Path(name)
        works(spoolflow, "export", "cpp", model, "-o", place / "export")
        for page, when in (("older.bin", "1700000000"), ("newer.bin", "1800000000")):
            works(spoolflow, "export", "parameters", model, "--sensors", "observer", "-o", place / page, env={**os.environ, "SOURCE_DATE_EPOCH": when})
        check_build(folder, place / "export", place)
        check_driver(folder, here, place / "export", place)


main(*sys.argv[1:])
