# SPDX-License-Identifier: Apache-2.0
"""Files from other places than the file system."""
from __future__ import annotations

import errno
import os
import posixpath
import zipfile
import zlib
from collections.abc import Sequence
from typing import IO

from .context import File


class ZipFiles:
    """The files of a zip archive:

        files = mxgen.ZipFiles("gold.zip")
        document = mxgen.Context(resolver=files.open, list_folder=files.list_folder).load("gold.mtlx")

    A name is relative to the referring file, "/" is the archive, and nothing outside of it is read, nor any file that is larger than
    `max_file_mib` when it is unpacked."""

    def __init__(self, archive: str | os.PathLike[str] | IO[bytes] | zipfile.ZipFile, *, max_file_mib: int = 256) -> None:
        self._archive = archive if isinstance(archive, zipfile.ZipFile) else zipfile.ZipFile(archive)
        self._max_file_mib = max_file_mib

    @staticmethod
    def _place(origin: str, name: str) -> str:
        return posixpath.normpath(posixpath.join("/", posixpath.dirname(origin), name)).lstrip("/")

    def open(self, origin: str, reference: str) -> File | None:
        """For `Context(resolver=...)`. Raises OSError for an entry that cannot be read: too large, encrypted, damaged."""
        place = self._place(origin, reference)
        try:
            entry = self._archive.getinfo(place)
        except KeyError:
            return None
        if entry.file_size > self._max_file_mib << 20:
            raise OSError(errno.EFBIG, f"it is larger than {self._max_file_mib} MiB; ZipFiles has 'max_file_mib' if this is intended", place)
        try:
            return File(self._archive.read(entry), place)
        except (RuntimeError, ValueError, EOFError, zipfile.BadZipFile, zlib.error) as error:
            raise OSError(errno.EIO, f"the archive says: {error}", place) from error

    def list_folder(self, origin: str, folder: str) -> Sequence[str] | None:
        """For `Context(list_folder=...)`."""
        place = self._place(origin, folder)
        names = [name for name in self._archive.namelist() if posixpath.dirname(name) == place]
        return [posixpath.basename(name) for name in names if not name.endswith("/")] or None
