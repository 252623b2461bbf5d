# SPDX-License-Identifier: Apache-2.0
"""Files from other places than the file system."""
from __future__ import annotations

import os
import posixpath
import zipfile
from collections.abc import Sequence
from typing import IO

from .context import File


class ZipFiles:
    """The files of a zip archive:

        files = mxgen.ZipFiles("gold.zip")
        document = mxgen.Context(resolver=files.open, list_folder=files.list_folder).load("gold.mtlx")

    A name is relative to the referring file, "/" is the archive, and nothing outside of it is read."""

    def __init__(self, archive: str | os.PathLike[str] | IO[bytes] | zipfile.ZipFile) -> None:
        self._archive = archive if isinstance(archive, zipfile.ZipFile) else zipfile.ZipFile(archive)

    @staticmethod
    def _place(origin: str, name: str) -> str:
        return posixpath.normpath(posixpath.join("/", posixpath.dirname(origin), name)).lstrip("/")

    def open(self, origin: str, reference: str) -> File | None:
        """For `Context(resolver=...)`."""
        place = self._place(origin, reference)
        try:
            return File(self._archive.read(place), place)
        except KeyError:
            return None

    def list_folder(self, origin: str, folder: str) -> Sequence[str] | None:
        """For `Context(list_folder=...)`."""
        place = self._place(origin, folder)
        names = [name for name in self._archive.namelist() if posixpath.dirname(name) == place]
        return [posixpath.basename(name) for name in names if not name.endswith("/")] or None
