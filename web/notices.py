#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the licences of the code of others in the page: the packages of the editor, and what the compiler has.

Arguments: the folder web, the built npm package, the output. script/sbom.py reads the names and versions."""
import json
import pathlib
import sys

RULE = "\n" + "-" * 80 + "\n\n"


def notice(folder, path, package):
    licence = next((folder / path).glob("LICENSE*"), None)
    if not licence:
        raise SystemExit(f"{path} has no licence; npm ci --prefix web --ignore-scripts installs it")
    return f"{path.rpartition('node_modules/')[2]} {package['version']}\n\n{licence.read_text(encoding='utf-8').strip()}\n"


def main():
    folder, library, output = map(pathlib.Path, sys.argv[1:])
    packages = json.loads((folder / "package-lock.json").read_text(encoding="utf-8"))["packages"]
    parts = [notice(folder, path, package) for path, package in sorted(packages.items()) if path]
    output.write_text(RULE.join([*parts, "mxgen.js\n\n" + (library / "NOTICES.txt").read_text(encoding="utf-8")]), encoding="utf-8")


main()
