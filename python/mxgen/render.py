# SPDX-License-Identifier: Apache-2.0
"""Pictures of materials, by the program mxgen-render."""
from __future__ import annotations

import os
import pathlib
import subprocess
import tempfile
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from .error import Error

if TYPE_CHECKING:
    from .document import Document, Item


class RenderError(Error):
    """The program cannot draw the element, or is not there. The text is what it says."""


def _with_whole_paths(document: Document) -> Document:
    """The document as one that reads its textures from any folder."""
    folder = os.path.abspath(os.path.dirname(document.files[0]))
    with document.edit() as edit:
        for element in document.walk():
            prefix = element.get("fileprefix")
            if prefix is not None or element.parent is None:
                edit[element].set("fileprefix", os.path.join(folder, prefix or ""))
    return edit.document


def render_picture(document: Document, element: Item | None = None, *, suffix: str = ".png", size: int | tuple[int, int] = 512,
            options: Sequence[str] = (), program: str | os.PathLike[str] = "mxgen-render") -> bytes:
    """The file of a picture; `suffix` is its format. The rest is as in `render`."""
    path = element if element is None or isinstance(element, str) else getattr(element, "path", None)
    if element is not None and path is None:
        raise TypeError(f"element must be str, Element or Renderable, not {type(element).__name__}")
    width, height = (size, size) if isinstance(size, int) else size
    with tempfile.TemporaryDirectory() as folder:
        source, made = pathlib.Path(folder) / "document.mtlx", pathlib.Path(folder) / f"picture{suffix}"
        _with_whole_paths(document).save(source)
        command = [os.fspath(program), str(source), "-o", str(made), "--size", f"{width}x{height}", "--quiet", *options]
        command += [part for file in document.library.files for part in ("--library", file)]
        command += ["--element", path] if path is not None else []
        try:
            done = subprocess.run(command, capture_output=True, text=True, check=False)
        except OSError as error:
            raise RenderError(f"cannot start '{os.fspath(program)}': {error.strerror}") from error
        if done.returncode != 0:
            raise RenderError(done.stderr.strip())
        return made.read_bytes()


def render(document: Document, element: Item | None = None, *, size: int | tuple[int, int] = 512, options: Sequence[str] = (),
           program: str | os.PathLike[str] = "mxgen-render") -> Any:
    """A picture as an array of NumPy: rows from the top, by columns, by red, green and blue of sRGB from 0 to 255. `element` None: the first
    renderable. `options` are those of `mxgen render --help`: ["--mesh", "cloth"]. Raises RenderError."""
    import numpy # pylint: disable=import-outside-toplevel

    data = render_picture(document, element, suffix=".ppm", size=size, options=options, program=program)
    _, shape, _, pixels = data.split(b"\n", 3)
    width, height = map(int, shape.split())
    return numpy.frombuffer(pixels, numpy.uint8).reshape(height, width, 3)
