# SPDX-License-Identifier: Apache-2.0
"""What a conversion could not keep."""
from __future__ import annotations

from typing import NamedTuple


class Loss(NamedTuple):
    """A value or connection that the other side does not have."""

    material: str
    #: the input or the socket
    what: str
    reason: str
    #: an image in the place of a graph would keep it
    is_graph: bool = False

    def __str__(self) -> str:
        return f"{self.material}: {self.what}: {self.reason}"
