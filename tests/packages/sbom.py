#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The bill of materials of a release (SPDX 2.3, JSON): its form, and that it tells what is there. Argument: the folder of the release."""
import hashlib
import json
import pathlib
import re
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

FOLDER = pathlib.Path(sys.argv[1])
FILE = next(FOLDER.glob("*.spdx.json"))
BILL = json.loads(FILE.read_text(encoding="utf-8"))
PACKAGES = {package["SPDXID"]: package for package in BILL["packages"]}
LICENCE = re.compile(r"[A-Za-z0-9.+-]+( (AND|OR|WITH) [A-Za-z0-9.+-]+)*")

check(BILL["spdxVersion"] == "SPDX-2.3" and BILL["dataLicense"] == "CC0-1.0" and BILL["SPDXID"] == "SPDXRef-DOCUMENT", "the head is not that of SPDX 2.3")
check(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", BILL["creationInfo"]["created"]), f"no date: {BILL['creationInfo']['created']}")
check(len(PACKAGES) == len(BILL["packages"]), "two packages have one identifier")
for identity, package in PACKAGES.items():
    check(re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", identity), f"no identifier of SPDX: {identity}")
    check(package["versionInfo"], f"{identity} has no version")
    check(LICENCE.fullmatch(package["licenseDeclared"]), f"{identity} has no licence: {package['licenseDeclared']}")
for relationship in BILL["relationships"]:
    for key in "spdxElementId", "relatedSpdxElement":
        check(relationship[key] in PACKAGES or relationship[key] == BILL["SPDXID"], f"{relationship} leads nowhere")

files = {package["packageFileName"]: package for package in PACKAGES.values() if "packageFileName" in package}
present = {path.name for path in FOLDER.iterdir()} - {FILE.name, "SHA256SUMS"}
check(set(files) == present, f"files in one list only: {set(files) ^ present}")
for name in set(files) & present:
    digest = hashlib.sha256((FOLDER / name).read_bytes()).hexdigest()
    check(files[name]["checksums"] == [{"algorithm": "SHA256", "checksumValue": digest}], f"{name}: another checksum")


def inside(pattern, kind):
    """The names of what the artefact has in it or needs."""
    one = next(package["SPDXID"] for name, package in files.items() if pathlib.PurePath(name).match(pattern))
    return {PACKAGES[item["relatedSpdxElement"]]["name"] for item in BILL["relationships"] if item["spdxElementId"] == one and item["relationshipType"] == kind}


check(inside("*.whl", "CONTAINS") == {"libxml2"}, f"the wheel has {inside('*.whl', 'CONTAINS')}")
check({"libxml2", "jansson", "wasi-libc"} <= inside("*.tgz", "CONTAINS"), f"the npm package has {inside('*.tgz', 'CONTAINS')}")
check({"libxml2", "jansson", "vscode-languageclient", "@dagrejs/dagre"} <= inside("*.vsix", "CONTAINS"), f"the extension has {inside('*.vsix', 'CONTAINS')}")
check({"libxml2", "libc6"} <= inside("libmxgen0_*", "DEPENDS_ON"), "the library for Debian does not need libxml2")
check("libassimp5" in inside("mxgen_*", "DEPENDS_ON") and "glslang-dev" in inside("mxgen_*", "CONTAINS"), "the programs for Debian need no Assimp")
finish("sbom")
