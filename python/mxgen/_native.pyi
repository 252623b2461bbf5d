# SPDX-License-Identifier: Apache-2.0
# The extension module, as far as type checkers know it: its types are C's.
from collections.abc import Callable
from typing import Any, TypeVar

_Function = TypeVar("_Function", bound=Callable[..., Any])

class _FFI:
    def def_extern(self, *, error: Any = None, onerror: Any = None) -> Callable[[_Function], _Function]: ...
    def __getattr__(self, name: str) -> Any: ...

ffi: _FFI
lib: Any
