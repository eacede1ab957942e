#!/usr/bin/env python3
"""SPDX 2.3 list, in JSON, of what built programs and modules hold and need.

sbom.py -o OUT.json PROGRAM...
sbom.py --check-headers BUILD

Names, licences and Debian packages stand in the tables of NOTICE; versions are those of this machine's packages, of uPlot
that of web/package.json. A library that a PROGRAM is linked with (the compiler's and the system's own aside) and that NOTICE
does not name is an error: exit status 1, one line. SOURCE_DATE_EPOCH sets the time; the same programs on the same packages
give the same bytes. `--check-headers` looks whether NOTICE names every package whose headers the objects of a build folder
include, those of tests and benchmarks aside. Standard library only; needs dpkg-query and readelf, or ninja.
"""
import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent
SYSTEM = ("libc6", "libgcc-s1", "libstdc++6")
SYSTEM_SOURCES = re.compile(r"(glibc|linux|gcc-\d+|llvm-toolchain-\d+|python3\.\d+)$")
RELATION = {"headers": "STATIC_LINK", "shared": "DYNAMIC_LINK", "page": "CONTAINS"}


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def components():
    """Rows of NOTICE's tables: name, in, licence, package, origin."""
    rows = []
    for line in (ROOT / "NOTICE").read_text(encoding="utf-8").splitlines():
        fields = re.split(r"\s{2,}", line.strip())
        if line.startswith("  ") and len(fields) == 5 and fields[1] in RELATION:
            rows.append(dict(zip(("name", "in", "licence", "package", "origin"), fields)))
    return rows


def unversioned(package):
    """The same for libfmt9 and libfmt10, libssl3 and libssl3t64, libboost1.74-dev and libboost1.83-dev: NOTICE serves every release."""
    return re.sub(r"t64$|[-.0-9]+", "", package)


def installed():
    """This machine's packages by their unversioned names."""
    return {unversioned(package): package for package in output_of("dpkg-query", "--show", "--showformat", "${Package}\n").split()}


def linked_libraries(programs):
    """(program, library, path) of each library that a program itself names as needed."""
    for program in programs:
        needed = re.findall(r"\(NEEDED\).*\[(.+?)\]", output_of("readelf", "--wide", "--dynamic", program))
        found = dict(re.findall(r"(\S+) => (/\S+)", output_of("ldd", program)))
        yield from ((program, library, found[library]) for library in needed if library in found)


def owners_of(paths):
    """Debian package of each path that one holds; a merged /usr knows some by their older names."""
    names = {}
    for path in paths:
        for name in (path, os.path.realpath(path), "/usr" + path, path.removeprefix("/usr")):
            names.setdefault(name, path)
    listed = subprocess.run(["dpkg-query", "--search", *names], capture_output=True, text=True).stdout
    return {names[path]: owner for owner, path in re.findall(r"^([^\s:,]+)(?::\w+)?: (/\S+)$", listed, re.M) if path in names}


def sources_of(packages):
    """Debian's source packages that these are of: libfmt9 and libfmt-dev are of one."""
    asked = subprocess.run(["dpkg-query", "--show", "--showformat", "${source:Package}\n", *packages], capture_output=True, text=True)
    return set(asked.stdout.split())


def check_headers(build):
    included = set()
    for entry in output_of("ninja", "-C", build, "-t", "deps").split("\n\n"):
        target, *paths = entry.split("\n")
        if not re.match(r"(.*/)?(tests|bench|examples)/", target.split(":")[0]):
            included.update(path.strip() for path in paths if path.strip().startswith("/usr/"))
    owners = set(owners_of(included).values())
    here = installed()
    named = sources_of(here[name] for row in components() if (name := unversioned(row["package"])) in here)
    missing = sorted(source for source in sources_of(owners) - named if not SYSTEM_SOURCES.match(source))
    if missing:
        sys.exit(f"sbom: headers of {', '.join(missing)} are compiled in, which NOTICE does not name")
    if not owners:
        sys.exit(f"sbom: {build} knows of no headers: build it first")
    print(f"headers of {len(owners)} packages, all named or the system's")


def version_of(package):
    if package.startswith("npm:"):
        return json.loads((ROOT / "web/package.json").read_text())["devDependencies"][package[len("npm:"):]]
    asked = subprocess.run(["dpkg-query", "--show", "--showformat", "${Version}", package], capture_output=True, text=True)
    return asked.stdout if asked.returncode == 0 else ""


def address_of(package, version):
    kind, name = ("npm", package[len("npm:"):]) if package.startswith("npm:") else ("deb/debian", package)
    return f"pkg:{kind}/{name}@{urllib.parse.quote(version, safe='')}"


def project_version():
    return re.search(r"project\(\s*spoolflow\s+VERSION\s+([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def package(name, version, licence, origin):
    return {"SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]+", "-", name).strip("-"), "name": name, "versionInfo": version,
            "downloadLocation": origin, "filesAnalyzed": False, "licenseConcluded": licence, "licenseDeclared": licence,
            "copyrightText": "NOASSERTION"}


def document(programs):
    rows = components()
    named = {unversioned(row["package"]) for row in rows}
    linked = list(linked_libraries(programs))
    owners = owners_of({path for _, _, path in linked})
    for program, library, path in linked:
        owner = owners.get(path, "none")
        if unversioned(owner) not in named and owner not in SYSTEM:
            sys.exit(f"sbom: {program} is linked with {library} of package {owner}, which NOTICE does not name")
    used = {unversioned(owner): owner for owner in owners.values()}
    here = installed() | used
    own = package("spoolflow", project_version(), "Apache-2.0", "NOASSERTION")
    packages, relations = [own], []
    for row in rows:
        name = unversioned(row["package"])
        found = here.get(name, row["package"])
        version = version_of(found)
        if not version or (row["in"] == "shared" and name not in used):
            continue  # of an add-on that is not among the programs
        part = package(row["name"], version, row["licence"], row["origin"])
        part["externalRefs"] = [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                                 "referenceLocator": address_of(found, version)}]
        packages.append(part)
        relations.append({"spdxElementId": own["SPDXID"], "relationshipType": RELATION[row["in"]],
                          "relatedSpdxElement": part["SPDXID"]})
    relations.insert(0, {"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES",
                         "relatedSpdxElement": own["SPDXID"]})
    digest = hashlib.sha256(json.dumps(packages, sort_keys=True).encode()).hexdigest()
    moment = datetime.datetime.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", datetime.datetime.now().timestamp())),
                                             datetime.timezone.utc)
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
            "name": f"spoolflow-{own['versionInfo']}",
            "documentNamespace": f"https://example.org/spdx/spoolflow-{own['versionInfo']}-{digest}",
            "creationInfo": {"created": moment.strftime("%Y-%m-%dT%H:%M:%SZ"), "creators": ["Tool: ci/sbom.py"]},
            "packages": packages, "relationships": relations}


def main(arguments):
    if len(arguments) == 2 and arguments[0] == "--check-headers":
        check_headers(arguments[1])
        return
    if len(arguments) < 3 or arguments[0] != "-o":
        sys.exit(__doc__)
    text = json.dumps(document(arguments[2:]), indent=1) + "\n"
    pathlib.Path(arguments[1]).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
