#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The bill of materials of a release, as SPDX 2.3: its artefacts, what they contain and what they link, with versions and licences.

Arguments: the folder of the artefacts, which gets mxgen-VERSION.spdx.json; the source that they were made from. `components.txt` has the
licences; versions come from Debian's packages of this machine, and from the notices of archives that have packages of npm. SOURCE_DATE_EPOCH
is the date."""
import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import urllib.parse
import zipfile

FOLDER, SOURCE = map(pathlib.Path, sys.argv[1:])
# Archives with packages of npm: patterns of their names, their file of notices, where their packages are locked.
BUNDLES = [("*.vsix", "extension/ThirdPartyNotices.txt", "editors/vscode"), ("mxgen-page-*.zip", "NOTICES.txt", "web")]


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


def stop(text):
    raise SystemExit(f"script/sbom.py: {text}")


def components():
    """Package, patterns of artefacts, licence."""
    lines = (SOURCE / "script/components.txt").read_text(encoding="utf-8").splitlines()
    return [re.split(r"  +", line, maxsplit=2) for line in lines if line and not line.startswith("#")]


def version_of(package, inside):
    """Of an installed package, or of one inside whose source script/sources brings."""
    changelog = SOURCE / f"build-{package}/debian/changelog"
    if inside and changelog.exists():
        return re.search(r"\((.*?)\)", changelog.read_text(encoding="utf-8"))[1]
    return output_of("dpkg-query", "-W", "-f", "${Version}", package)


class Bill:
    def __init__(self, version):
        self.version, self.packages, self.relationships = version, {}, []

    def add(self, name, version, licence, **more):
        """A package, once; its id."""
        identity = "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", f"{name}-{version}")
        self.packages.setdefault(identity, {
            "SPDXID": identity, "name": name, "versionInfo": version, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "licenseConcluded": licence, "licenseDeclared": licence, "copyrightText": "NOASSERTION", **more})
        return identity

    def add_foreign(self, kind, name, version, licence):
        address = f"pkg:{kind}/{urllib.parse.quote(name)}@{urllib.parse.quote(version, safe='')}"
        return self.add(name, version, licence, externalRefs=[
            {"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": address}])

    def relate(self, one, kind, other):
        self.relationships.append({"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other})

    def text(self, commit):
        date = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
        return json.dumps({
            "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"mxgen-{self.version}",
            "documentNamespace": f"https://mxgen.invalid/spdx/{self.version}/{commit}",
            "creationInfo": {"created": date, "creators": ["Organization: mxgen developers", "Tool: script/sbom.py"]},
            "packages": [self.packages[name] for name in sorted(self.packages)], "relationships": self.relationships}, indent=1) + "\n"


def needs_of(package, own):
    """The packages that a Debian package names in its Depends; those of this release are in `own`."""
    names = re.findall(r"(?:^|, )([a-z0-9.+-]+)", output_of("dpkg-deb", "-f", package, "Depends"))
    return [name for name in dict.fromkeys(names) if name not in own]


def npm_packages(path, notices, folder):
    """Names, versions and licences of what is bundled in an archive."""
    with zipfile.ZipFile(path) as archive:
        found = re.findall(r"(?:\A|\n-{80}\n\n)(\S+) (\S+)\n", archive.read(notices).decode())
    locked = json.loads((SOURCE / folder / "package-lock.json").read_text(encoding="utf-8"))["packages"]
    licences = {(path.rpartition("node_modules/")[2], item["version"]): item["license"] for path, item in locked.items() if "license" in item and path}
    return [(name, version, licences.get((name, version)) or stop(f"no licence of {name} {version} in package-lock.json")) for name, version in found]


def main():
    version = re.search(r"^version = '(.*)'", (SOURCE / "pyproject.toml").read_text(encoding="utf-8"), re.MULTILINE)[1]
    commit, table = output_of("git", "-C", SOURCE, "rev-parse", "HEAD"), components()
    bill = Bill(version)
    root = bill.add("mxgen", version, "Apache-2.0")
    bill.relate("SPDXRef-DOCUMENT", "DESCRIBES", root)
    licences = {package: licence for package, _, licence in table}
    artefacts = sorted(FOLDER.iterdir())
    own = {path.name.split("_")[0] for path in artefacts if path.suffix == ".deb"}
    used = set()
    for path in artefacts:
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        this = bill.add(path.name, version, "Apache-2.0", packageFileName=path.name, checksums=[{"algorithm": "SHA256", "checksumValue": digest}])
        bill.relate(this, "GENERATED_FROM", root)
        for package, where, licence in table:
            if any(path.match(pattern) for pattern in where.split()):
                bill.relate(this, "CONTAINS", bill.add_foreign("deb/debian", package, version_of(package, True), licence))
                used.add(package)
        for _, notices, folder in [bundle for bundle in BUNDLES if path.match(bundle[0])]:
            for name, number, licence in npm_packages(path, notices, folder):
                bill.relate(this, "CONTAINS", bill.add_foreign("npm", name, number, licence))
        for package in needs_of(path, own) if path.suffix == ".deb" else []:
            licence = licences.get(package) or stop(f"{path.name} needs {package}: its licence is missing in script/components.txt")
            bill.relate(this, "DEPENDS_ON", bill.add_foreign("deb/debian", package, version_of(package, False), licence))
            used.add(package)
    for package in [package for package, _, _ in table if package not in used]:
        stop(f"no artefact has {package} of script/components.txt")
    (FOLDER / f"mxgen-{version}.spdx.json").write_text(bill.text(commit), encoding="utf-8")


main()
