#!/usr/bin/python3
"""spdx_rules.py LIST.json SOURCE: what SPDX 2.3 asks of a document, as far as this one has it (clauses 6, 7 and 11), and that NOTICE
and Debian's copyright say under which licence all is that is compiled in or stands in pages."""
import json
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(sys.argv[2]) / "ci"))
import sbom  # noqa: E402

# Identifiers of SPDX's licence list that occur; a new one is looked up at https://spdx.org/licenses and added.
LICENCES = {"Apache-2.0", "BSD-2-Clause", "BSD-3-Clause", "BSL-1.0", "EPL-2.0", "LGPL-2.1-only", "LGPL-2.1-or-later", "MIT", "MPL-2.0",
            "PostgreSQL", "Zlib", "blessing", "curl"}
RELATIONS = {"DESCRIBES", "STATIC_LINK", "DYNAMIC_LINK", "CONTAINS"}

document = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
assert document["spdxVersion"] == "SPDX-2.3" and document["dataLicense"] == "CC0-1.0" and document["SPDXID"] == "SPDXRef-DOCUMENT"
assert re.fullmatch(r"https?://[^#\s]+", document["documentNamespace"]), document["documentNamespace"]
assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", document["creationInfo"]["created"])
assert all(re.match(r"(Tool|Person|Organization): ", each) for each in document["creationInfo"]["creators"])
ids = ["SPDXRef-DOCUMENT"] + [package["SPDXID"] for package in document["packages"]]
assert len(set(ids)) == len(ids), ids
for package in document["packages"]:
    assert re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", package["SPDXID"]), package
    assert package["name"] and package["versionInfo"] and package["filesAnalyzed"] is False, package
    assert package["downloadLocation"] == "NOASSERTION" or re.match(r"https?://", package["downloadLocation"]), package
    for field in ("licenseConcluded", "licenseDeclared"):
        assert set(re.split(r" (?:OR|AND) ", package[field])) <= LICENCES, package
    for reference in package.get("externalRefs", []):
        assert reference["referenceCategory"] == "PACKAGE-MANAGER" and re.fullmatch(r"pkg:[a-z]+/[^\s@]+@[^\s@]+", reference["referenceLocator"])
related = document["relationships"]
assert all({each["spdxElementId"], each["relatedSpdxElement"]} <= set(ids) and each["relationshipType"] in RELATIONS for each in related)
assert {each["relatedSpdxElement"] for each in related} == set(ids[1:]), "a package that nothing relates to"

source = pathlib.Path(sys.argv[2])
notice = (source / "NOTICE").read_text(encoding="utf-8")
copyrights = notice[notice.index("Copyright of what is compiled in"):notice.index("The MIT License")]
debian = " ".join((source / "cmake/debian/copyright").read_text(encoding="utf-8").split())
for row in sbom.components():
    if row["in"] in ("headers", "page"):
        assert row["name"] in copyrights, f"NOTICE states no copyright of {row['name']}"
        assert row["name"] in debian, f"cmake/debian/copyright does not name {row['name']}"
