# SPDX-License-Identifier: Apache-2.0
"""Pictures of materials, and patterns as images, by the program mxgen-render."""
from __future__ import annotations

import os
import pathlib
import subprocess
import tempfile
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ._calls import check_type
from .error import Error

if TYPE_CHECKING:
    from .document import Document, Item


class RenderError(Error):
    """The program cannot draw the element, or is not there. The text is what it says."""


def _run(program: str | os.PathLike[str], task: str, arguments: Sequence[str], document: Document) -> None:
    """Runs a task of the program, the name that it starts with, over a file that has the document, with its library."""
    command = [task, *arguments, *(part for file in document.library.files for part in ("--library", file))]
    try:
        done = subprocess.run(command, executable=os.fspath(program), capture_output=True, text=True, check=False)
    except OSError as error:
        raise RenderError(f"cannot start '{os.fspath(program)}': {error.strerror}") from error
    if done.returncode != 0:
        raise RenderError(done.stderr.strip())


def _path_of(element: Item | None) -> str | None:
    path = element if element is None or isinstance(element, str) else getattr(element, "path", None)
    if element is not None and path is None:
        raise TypeError(f"element must be str, Element or Renderable, not {type(element).__name__}")
    return path


def _with_whole_paths(document: Document) -> Document:
    """The document as one that reads its textures from any folder."""
    from .document import Document # pylint: disable=import-outside-toplevel,redefined-outer-name

    check_type(document, Document, "document")
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
    path = _path_of(element)
    width, height = (size, size) if isinstance(size, int) else size
    with tempfile.TemporaryDirectory() as folder:
        source, made = pathlib.Path(folder) / "document.mtlx", pathlib.Path(folder) / f"picture{suffix}"
        _with_whole_paths(document).save(source)
        _run(program, "render", [str(source), "-o", str(made), "--size", f"{width}x{height}", "--quiet", *options,
                                *(["--element", path] if path is not None else [])], document)
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


def bake(document: Document, folder: str | os.PathLike[str], element: Item | None = None, *, options: Sequence[str] = (),
         program: str | os.PathLike[str] = "mxgen-render") -> pathlib.Path:
    """Writes a flat document and its images to a folder: patterns become images (docs/bake.md). Gives the path of the document. `element`
    None: all materials. `options` are those of `mxgen bake --help`: ["--size", "1024"]. Raises RenderError; the folder is then as it was."""
    path = _path_of(element)
    with tempfile.TemporaryDirectory() as place:
        whole = _with_whole_paths(document)
        source = pathlib.Path(place) / pathlib.Path(document.files[0]).name
        whole.save(source)
        _run(program, "bake", [str(source), "-o", os.fspath(folder), "--quiet", *options,
                              *(["--element", path] if path is not None else [])], document)
    return pathlib.Path(folder) / source.with_suffix(".mtlx").name
