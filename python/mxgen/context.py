# SPDX-License-Identifier: Apache-2.0
"""Contexts: where files come from, the limits, and the start of every other object."""
from __future__ import annotations

import ctypes
import enum
import os
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Union

from ._calls import Handle, Native, c_number, c_path, c_text, c_texts, check_type, error_of, guarded, lib, new, optional_text, py_text, sized_text
from .definition import Library
from .diagnostic import Diagnostics
from .document import Document, Rewritten, rewritten
from .edit import Edit
from .error import ArgumentError, Error, OutOfMemoryError, document_error
from .scene import Scene
from .shader import OptionValue, Shader, make_options


@dataclass(frozen=True)
class File:
    """A file that a resolver gives."""

    data: bytes | str
    #: canonical name: messages show it, and includes in the file are relative to it; None: the name of the reference
    name: str | None = None


#: Finds a file: (canonical name of the referring file or "", reference) to its content, or None if there is no such file. An OSError that it
#: raises is the reason why a file cannot be read; it becomes a message at the reference.
Resolver = Callable[[str, str], Union[File, bytes, str, None]]
#: Lists the files of a texture folder: (canonical name of the referring file, folder) to names, or None: no such folder.
ListFolder = Callable[[str, str], Union[Sequence[str], None]]

#: Reads a texture for the estimated errors of budgets: (canonical name of the referring file, file, layer, size) to the means of size by size
#: equal parts, rows from the top, RGBA each, without a change of colour space; None: it cannot be read, and counts as a few fixed colours.
ReadTexels = Callable[[str, str, str, int], Union[Sequence[float], None]]


class Rewriting(enum.IntEnum):
    """What `Context.rewrite` does."""

    #: the document as it is, in one layout
    FORMAT = lib.MXG_REWRITE_FORMAT
    #: the same after the upgrade of an older version to 1.39
    UPGRADE = lib.MXG_REWRITE_UPGRADE


class _Host:
    """The callbacks of a context, as C calls them. An exception in a callback waits until the call of C returns."""

    def __init__(self, resolver: Resolver | None, list_folder: ListFolder | None, cancel: Callable[[], bool] | None,
                 read_texels: ReadTexels | None) -> None:
        for name, callback in ("resolver", resolver), ("list_folder", list_folder), ("cancel", cancel), ("read_texels", read_texels):
            if callback is not None and not callable(callback):
                raise TypeError(f"{name} must be callable, not {type(callback).__name__}")
        self.resolver = resolver
        self.list_folder = list_folder
        self.cancel = cancel
        self.read_texels = read_texels
        self.raised: BaseException | None = None
        self._lent: dict[int, tuple[bytes, bytes | None]] = {}
        self._next = 1
        self._unreadable = b"", b""

    def open(self, origin: bytes, reference: bytes, blob: Any, reason: Any) -> bool:
        assert self.resolver is not None
        try:
            found = self.resolver(py_text(origin), py_text(reference))
        except FileNotFoundError:
            found = None
        except OSError as error:
            self._unreadable = reference, c_text(error.strerror or str(error), "the reason")
            blob.contents.name, reason[0] = self._unreadable
            return False
        if found is None:
            return False
        file = found if isinstance(found, File) else File(found)
        data = file.data.encode("utf-8", "surrogateescape") if isinstance(file.data, str) else file.data
        if not isinstance(data, bytes):
            raise TypeError(f"the resolver must return File, bytes, str or None, not {type(found).__name__}")
        name = None if file.name is None else c_text(file.name, "File.name")
        blob.contents.data, blob.contents.size = data, len(data)
        if name is not None:
            blob.contents.name = name
        blob.contents.handle = self._next
        self._lent[self._next] = data, name
        self._next += 1
        return True

    def release(self, blob: Any) -> None:
        del self._lent[blob.contents.handle]

    def list(self, origin: bytes, folder: bytes, out: int, capacity: int) -> int:
        assert self.list_folder is not None
        names = self.list_folder(py_text(origin), py_text(folder))
        if isinstance(names, (str, bytes)):
            raise TypeError("list_folder must return a sequence of names")
        listed = b"".join(c_text(name, "a name of list_folder") + b"\0" for name in names or ())
        if len(listed) <= capacity:
            ctypes.memmove(out, listed, len(listed))
        return len(listed)

    def read(self, origin: bytes, file: bytes, layer: bytes, size: int, out: Any) -> bool:
        assert self.read_texels is not None
        texels = self.read_texels(py_text(origin), py_text(file), py_text(layer), size)
        if texels is None:
            return False
        count = 4 * size * size
        if len(texels) != count:
            raise ValueError(f"read_texels must return {count} numbers, not {len(texels)}")
        ctypes.memmove(out, (ctypes.c_float * count)(*texels), 4 * count)
        return True


class Context(Native):
    """Loads documents and libraries. All arguments have defaults, and names as in mxg_context_desc:

    resolver       finds files; None: files of the file system
    list_folder    lists texture folders, beside a resolver
    cancel         is called repeatedly by generation and inspection, and stops them when it returns True
    read_texels    reads textures for the estimated errors of budgets
    max_...        limits (include/mxgen/mxgen.h); 0: the default
    warnings       changes the severity of diagnostics: "error,no-unused-input"
    trust          accepts shader source in documents
    sandbox        keeps references of a document in its folder and in `include_roots`

    An exception in a callback, but an OSError of the resolver, stops the call and leaves it unchanged. A callback cannot use its own context. Threads take turns
    with a context; give each thread its own to generate at the same time."""

    def __init__(self, *, resolver: Resolver | None = None, list_folder: ListFolder | None = None,
                 cancel: Callable[[], bool] | None = None, read_texels: ReadTexels | None = None,
                 max_memory: int = 0, max_file_mib: int = 0, max_elements: int = 0,
                 max_nodes: int = 0, max_output_mib: int = 0, max_errors: int = 0, max_depth: int = 0, max_include_depth: int = 0,
                 max_includes: int = 0, warnings: str | None = None, trust: bool = False, sandbox: bool = False,
                 include_roots: Sequence[str | os.PathLike[str]] = ()) -> None:
        if list_folder is not None and resolver is None:
            raise ValueError("list_folder needs a resolver")
        self._host = _Host(resolver, list_folder, cancel, read_texels)
        self._lock = threading.Lock()
        self._user: int | None = None
        if isinstance(include_roots, str):
            raise TypeError("include_roots must be a sequence of paths, not str")
        for word, value in ("trust", trust), ("sandbox", sandbox):
            check_type(value, bool, word)
        limits = {"max_file_mib": max_file_mib, "max_elements": max_elements, "max_nodes": max_nodes, "max_output_mib": max_output_mib,
                  "max_errors": max_errors, "max_depth": max_depth, "max_include_depth": max_include_depth, "max_includes": max_includes}
        desc = new("mxg_context_desc", max_memory=c_number(max_memory, "max_memory", 64),
                   **{name: c_number(limit, name) for name, limit in limits.items()}, trust=trust, sandbox=sandbox, warnings=optional_text(warnings, "warnings"),
                   include_roots=c_texts(c_path(root, "an include root") for root in include_roots), num_include_roots=len(include_roots))
        callbacks = self._set_callbacks(desc)
        out = ctypes.c_void_p()
        status = lib.mxg_context_create(desc, out)
        if status == lib.MXG_ERROR_ARGUMENT:
            raise ArgumentError(sized_text(lambda buffer, capacity: lib.mxg_context_desc_error(desc, buffer, capacity)))
        if status != lib.MXG_OK:
            raise error_of(status)

        def destroy(pointer: Any, _keep: Any = callbacks) -> None: # the context calls them until it ends
            lib.mxg_context_destroy(pointer)

        self._handle = Handle(out.value, destroy)
        self._library: Library | None = None

    def _set_callbacks(self, desc: Any) -> list[Any]:
        """Gives the callbacks of the host to a mxg_context_desc. They live as long as the result."""
        host, made = self._host, []

        def callback(name: str, work: Callable[..., Any], failed: Any) -> Any:
            made.append(guarded(name, host, work, failed))
            return made[-1]

        if host.resolver is not None:
            resolver = new("mxg_resolver", open=callback("open", host.open, False), release=callback("release", host.release, None))
            if host.list_folder is not None:
                resolver.list_folder = callback("list_folder", host.list, 0)
            desc.resolver = ctypes.pointer(resolver)
        if host.cancel is not None:
            cancel = host.cancel
            desc.cancel = callback("cancel", lambda: bool(cancel()), True)
        if host.read_texels is not None:
            made.append(new("mxg_texel_reader", read_texels=callback("read_texels", host.read, False)))
            desc.texels = ctypes.addressof(made[-1])
        return made

    # ---- Calls ----

    @contextmanager
    def _turn(self) -> Iterator[Any]:
        """A call of C that uses the context. Gives the context's pointer, and raises the exception of a callback afterwards."""
        me = threading.get_ident()
        if self._user == me:
            raise Error("a callback cannot use its own context; make another context")
        with self._lock:
            try:
                self._user = me
                yield self._handle.pointer
            finally:
                self._user = None
                raised, self._host.raised = self._host.raised, None
            if raised is not None:
                raise raised

    def _make(self, function: Callable[..., int], destroy: Callable[[Any], None], parents: Sequence[Handle],
              *arguments: Any) -> tuple[Handle, int]:
        """Calls a function that makes an object: with the context, the arguments and a place for the object."""
        out = ctypes.c_void_p()
        handle = None
        try:
            with self._turn() as pointer:
                status: int = function(pointer, *arguments, out)
                if out.value:
                    handle = Handle(out.value, destroy, (self._handle, *parents))
            if status not in (lib.MXG_OK, lib.MXG_ERROR_DOCUMENT):
                raise error_of(status)
            if handle is None:
                raise OutOfMemoryError("there is no memory for the result")
        except BaseException:
            if handle is not None:
                handle.release()
            raise
        return handle, status

    # ---- Passes ----

    def passes(self, target: str, *, options: Mapping[str, OptionValue] | None = None) -> dict[str, Shader]:
        """The passes of the deferred pipeline that belong to no material (docs/deferred.md), by name, in their order, as far
        as the options ask for them. The source of a pass is that of `Shader.pixel`, a compute stage. Raises DocumentError."""
        found = {}
        for index in range(lib.mxg_catalogue_num_passes()):
            desc = new("mxg_generate_desc", target=c_text(target, "target"))
            made_options = None if options is None else make_options(self, options)
            if made_options is not None:
                desc.options = made_options._handle.pointer
            handle, status = self._make(lib.mxg_generate_pass, lib.mxg_result_destroy, (), index, desc)
            shader = Shader(handle)
            if status != lib.MXG_OK:
                raise document_error(shader.diagnostics)
            if shader.pixel is not None:
                found[py_text(lib.mxg_catalogue_pass(index))] = shader
        return found

    def module(self, target: str, *, library: Library | None = None, options: Mapping[str, OptionValue]) -> Shader:
        """The module with functions of the library that shaders of a target import with the option `mdl-module` (docs/mdl.md). Its source is
        that of `Shader.pixel`, and its name that of `Shader.name`. Raises DocumentError."""
        used = self._library_for(library)
        made_options = make_options(self, options)
        desc = new("mxg_generate_desc", target=c_text(target, "target"), options=made_options._handle.pointer)
        handle, status = self._make(lib.mxg_generate_module, lib.mxg_result_destroy, (used._handle,), used._handle.pointer, desc)
        shader = Shader(handle)
        if status != lib.MXG_OK:
            raise document_error(shader.diagnostics)
        return shader

    # ---- Libraries ----

    @property
    def library(self) -> Library:
        """The library that is built in."""
        if self._library is None:
            with self._turn() as pointer:
                made = lib.mxg_library_builtin(pointer)
            if not made:
                raise OutOfMemoryError("there is no memory for the library")
            # The library holds its context's handle and not the context, so that no cycle delays the end of both.
            self._library = Library(Handle(made, lib.mxg_library_unref, (self._handle,)))
        return self._library

    def load_library(self, *paths: str | os.PathLike[str], base: Library | None = None, standalone: bool = False) -> Library:
        """Makes a library of files, folders (every .mtlx below) or an image (.mxlib), on top of `base` (None: the built-in
        library). `standalone`: on top of nothing; an image needs it. Raises DocumentError."""
        if base is not None and standalone:
            raise ValueError("a standalone library has no base")
        below = None if standalone else self.library if base is None else base
        if below is not None and not isinstance(below, Library):
            raise TypeError(f"base must be Library, not {type(below).__name__}")
        names = c_texts(c_path(path, "a path") for path in paths)
        handle, status = self._make(lib.mxg_library_load, lib.mxg_library_unref,
                                    (below._handle,) if below else (), below._handle.pointer if below else None, names,
                                    len(paths))
        library = Library(handle)
        if status != lib.MXG_OK:
            raise document_error(library.diagnostics)
        return library

    # ---- Documents ----

    def _library_for(self, library: Library | None) -> Library:
        if library is not None and not isinstance(library, Library):
            raise TypeError(f"library must be Library, not {type(library).__name__}")
        return self.library if library is None else library

    def _document(self, library: Library, function: Callable[..., int], *arguments: Any) -> Document:
        handle, status = self._make(function, lib.mxg_document_destroy, (library._handle,),
                                    library._handle.pointer, *arguments)
        document = Document(self, library, handle)
        if status != lib.MXG_OK:
            raise document_error(document.diagnostics, document)
        return document

    def load(self, path: str | os.PathLike[str], *, library: Library | None = None) -> Document:
        """Reads a file. Raises DocumentError; its `document` has the parts without errors."""
        return self._document(self._library_for(library), lib.mxg_document_load, c_path(path, "path"))

    def parse(self, text: str | bytes, *, name: str = "<text>", library: Library | None = None) -> Document:
        """Reads a document from its text. `name` appears in messages and is the base of includes. Raises DocumentError."""
        data = _text_bytes(text)
        return self._document(self._library_for(library), lib.mxg_document_parse, c_text(name, "name"), data, len(data))

    def edit(self, document: Document | None = None, *, name: str = "<edit>", library: Library | None = None) -> Edit:
        """Begins a new document, or a changed copy of one. `library` is for a new one; a copy keeps its own."""
        if document is not None and not isinstance(document, Document):
            raise TypeError(f"document must be Document, not {type(document).__name__}")
        if document is not None and library is not None and library is not document.library:
            raise ValueError("a changed document keeps its library")
        used = document.library if document is not None else self._library_for(library)
        return Edit(self, used, document, name)

    # ---- Scenes ----

    def file_fault(self, origin: str | os.PathLike[str], path: str | os.PathLike[str]) -> str | None:
        """Why `origin`, a file that the caller names, may not refer to the file at `path`: it is outside the sandbox, no regular
        file, or too large. None: it may, or there is no such file."""
        origin_text, path_text = c_path(origin, "origin"), c_path(path, "path")
        with self._turn() as pointer:
            fault = lib.mxg_context_file_fault(pointer, origin_text, path_text)
        return py_text(fault) if fault else None

    def scene(self, *paths: str) -> Scene:
        """A scene of primitives by their paths, "/set/table", and those above them. Raises DocumentError if a path is none."""
        scene = Scene(self._make(lib.mxg_scene_create, lib.mxg_scene_destroy, ())[0])
        scene.add(*paths)
        return scene

    def load_scene(self, path: str | os.PathLike[str], *, purpose: str | None = None) -> Scene:
        """Reads a list with one path in each line, or a USD text layer (.usda) with its bindings. `purpose` chooses among these:
        "full", "preview", or None for those of all purposes. Raises DocumentError."""
        return self._read_scene(lib.mxg_scene_load, c_path(path, "path"), optional_text(purpose, "purpose"))

    def parse_scene(self, text: str | bytes, *, name: str = "<text>", purpose: str | None = None) -> Scene:
        """Reads a USD text layer from its text. `name` appears in messages, and textures are found from there. Raises DocumentError."""
        data = _text_bytes(text)
        return self._read_scene(lib.mxg_scene_parse, c_text(name, "name"), data, len(data), optional_text(purpose, "purpose"))

    def _read_scene(self, function: Callable[..., int], *arguments: Any) -> Scene:
        handle, status = self._make(function, lib.mxg_scene_destroy, (), *arguments)
        scene = Scene(handle)
        if status != lib.MXG_OK:
            raise document_error(scene.diagnostics)
        return scene

    def scene_materials(self, scene: Scene, *, library: Library | None = None) -> Document:
        """The materials in a USD scene as a document. `Document.with_materials` adds them to one. Raises DocumentError."""
        check_type(scene, Scene, "scene")
        return self._document(self._library_for(library), lib.mxg_document_import, None, scene._handle.pointer)

    # ---- Texts ----

    def rewrite(self, rewriting: Rewriting, name: str | os.PathLike[str], text: str | bytes | None = None) -> Rewritten:
        """Reads a document and writes it again. `text` None: reads the file `name`. Raises DocumentError."""
        data = None if text is None else _text_bytes(text)
        size = 0 if data is None else len(data)
        handle, status = self._make(lib.mxg_rewrite, lib.mxg_result_destroy, (), Rewriting(rewriting),
                                    c_path(name, "name"), data, size)
        return rewritten(handle, status)

    def format(self, text: str | bytes, *, name: str = "<text>") -> str:
        """The text of a document in one layout; comments stay."""
        return self.rewrite(Rewriting.FORMAT, name, text).text

    def upgrade(self, text: str | bytes, *, name: str = "<text>") -> Rewritten:
        """A document of an older version as version 1.39."""
        return self.rewrite(Rewriting.UPGRADE, name, text)


def _text_bytes(text: str | bytes) -> bytes:
    if not isinstance(text, (str, bytes)):
        raise TypeError(f"text must be str or bytes, not {type(text).__name__}")
    return text.encode("utf-8", "surrogateescape") if isinstance(text, str) else text
