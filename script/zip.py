#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a folder as a zip archive that depends on names and contents alone: sorted, with one date. Arguments: the archive, the folder."""
import pathlib
import sys
import zipfile

ARCHIVE, FOLDER = map(pathlib.Path, sys.argv[1:])
with zipfile.ZipFile(ARCHIVE, "w") as archive:
    for path in sorted(path for path in FOLDER.rglob("*") if path.is_file()):
        entry = zipfile.ZipInfo(path.relative_to(FOLDER).as_posix())
        entry.external_attr = 0o100644 << 16
        archive.writestr(entry, path.read_bytes(), zipfile.ZIP_DEFLATED, 9)
