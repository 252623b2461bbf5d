# SPDX-License-Identifier: Apache-2.0
"""Node trees of Blender as graphs of MaterialX: which value a socket has. The formulas are those of Blender's manual and of Cycles
(intern/cycles/kernel/osl/shaders); docs/blender.md lists how close each node is."""
from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy

from .losses import Loss
from .values import Graph, Value

TYPES = {"RGBA": "color3", "VALUE": "float", "VECTOR": "vector3", "INT": "float", "BOOLEAN": "float"}


class Lost(Exception):
    """A node that has no counterpart, with the reason."""


class Place:
    """A group node, and the place of the tree that it stands in; None outside of groups."""

    def __init__(self, group: bpy.types.Node, above: Place | None) -> None:
        self.group, self.above = group, above


class Patterns(Graph):
    """The values of a material's sockets. What has no counterpart is lost, and the socket keeps the value that it shows."""

    def __init__(self, edit: Any, material: bpy.types.Material, folder: str, losses: list[Loss]) -> None:
        super().__init__(edit)
        self.material, self.folder, self.losses = material, folder, losses
        self.known: dict[tuple[int, int, str], Value] = {}
        self.places: dict[tuple[int, int], Place] = {} # one for each group node and place: equal keys of `known`
        self.told: set[tuple[str, str]] = set()

    def lose(self, what: str, reason: str) -> None:
        if (what, reason) not in self.told:
            self.told.add((what, reason))
            self.losses.append(Loss(self.material.name, what, reason))

    # ---- Sockets ----

    def link_of(self, socket: bpy.types.NodeSocket) -> bpy.types.NodeLink | None:
        """The link that counts."""
        return next((link for link in socket.links if link.is_valid and not link.is_muted), None) if socket.is_linked else None

    def default(self, socket: bpy.types.NodeSocket) -> Value:
        """The value that a socket shows."""
        kind = TYPES.get(socket.type)
        if kind is None:
            raise Lost(f"the socket '{socket.name}' has no value")
        given = socket.default_value
        return self.value(kind, float(given) if kind == "float" else [float(x) for x in given][:3])

    def source(self, socket: bpy.types.NodeSocket, place: Place | None) -> tuple[bpy.types.Node, bpy.types.NodeSocket, Place | None] | bpy.types.NodeSocket:
        """The node and output behind an input, through reroutes, groups and muted nodes; the input without a link where it ends there."""
        while True:
            link = self.link_of(socket)
            if link is None:
                return socket
            node, output = link.from_node, link.from_socket
            if node.type == "REROUTE":
                socket = node.inputs[0]
            elif node.mute:
                inner = next((one for one in node.internal_links if one.to_socket == output), None)
                if inner is None:
                    return socket
                socket = inner.from_socket
            elif node.type == "GROUP" and node.node_tree is not None:
                ends = [one for one in node.node_tree.nodes if one.type == "GROUP_OUTPUT" and one.is_active_output]
                if not ends:
                    return socket
                place = self.places.setdefault((node.as_pointer(), id(place)), Place(node, place))
                socket = next(one for one in ends[0].inputs if one.identifier == output.identifier)
            elif node.type == "GROUP_INPUT" and place is not None:
                socket = next(one for one in place.group.inputs if one.identifier == output.identifier)
                place = place.above
            else:
                return node, output, place

    def at(self, socket: bpy.types.NodeSocket, place: Place | None = None) -> Value:
        """The value of an input, in the socket's own type."""
        found = self.source(socket, place)
        if not isinstance(found, tuple):
            return self.default(found).to(TYPES.get(socket.type, "float"))
        node, output, inside = found
        try:
            return self.output(node, output, inside).to(TYPES.get(socket.type, "float"))
        except Lost as lost:
            self.lose(f"{node.name}", f"{lost}; '{socket.name}' of '{socket.node.name}' keeps its value")
            return self.default(socket)

    def output(self, node: bpy.types.Node, output: bpy.types.NodeSocket, place: Place | None) -> Value:
        key = (node.as_pointer(), id(place), output.identifier)
        if key not in self.known:
            convert = CONVERTERS.get(node.bl_idname)
            if convert is None:
                raise Lost(f"the node '{node.bl_label}' has no counterpart")
            before, self.base = self.base, node.label or node.name
            try:
                self.known[key] = convert(Reading(self, node, place), output.name)
            finally:
                self.base = before
        return self.known[key]


class Reading:
    """A node that is converted: its inputs by name or number."""

    def __init__(self, graph: Patterns, node: bpy.types.Node, place: Place | None) -> None:
        self.graph, self.node, self.place = graph, node, place

    def socket(self, name: str | int) -> bpy.types.NodeSocket:
        if isinstance(name, int):
            return self.node.inputs[name]
        named = [one for one in self.node.inputs if one.name == name]
        return next((one for one in named if one.enabled), named[0])

    def __getitem__(self, name: str | int) -> Value:
        return self.graph.at(self.socket(name), self.place)

    def is_linked(self, name: str | int) -> bool:
        return isinstance(self.graph.source(self.socket(name), self.place), tuple)

    def known(self, name: str) -> float:
        """The number of an input that a node of MaterialX needs as a constant."""
        value = self[name]
        if value.number is None:
            self.graph.lose(f"{self.node.name}", f"'{name}' cannot vary; its own value counts")
            return float(self.socket(name).default_value)
        return value.number


Converter = Callable[[Reading, str], Value]
CONVERTERS: dict[str, Converter] = {}


def converts(*names: str) -> Callable[[Converter], Converter]:
    """Registers the converter of nodes with these names in Blender."""
    def register(function: Converter) -> Converter:
        CONVERTERS.update(dict.fromkeys(names, function))
        return function
    return register

