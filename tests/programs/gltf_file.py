# SPDX-License-Identifier: Apache-2.0
"""Makes files of glTF 2.0: accessors of any type, and quads of them."""
import base64
import json
import struct

FORMATS = {"b": 5120, "B": 5121, "h": 5122, "H": 5123, "I": 5125, "f": 5126}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
CORNERS = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
UV = [(0, 1), (1, 1), (1, 0), (0, 0)]  # v counts from the top
INDICES = [0, 1, 2, 0, 2, 3]


class File:
    def __init__(self, **members):
        self.root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "bufferViews": [], "accessors": [], **members}
        self.data = bytearray()

    def view(self, data, **members):
        self.data += bytes(-len(self.data) % 4)
        self.root["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data), **members})
        self.data += data
        return len(self.root["bufferViews"]) - 1

    def accessor(self, values, kind="f", normalized=False, stride=0, **members):
        """The number of an accessor of rows; `stride` is the distance of rows in bytes."""
        rows = [struct.pack(f"<{len(row)}{kind}", *row) for row in values]
        data = b"".join(row.ljust(stride, b"\xff") for row in rows)
        made = {"bufferView": self.view(data, **({"byteStride": stride} if stride else {})), "componentType": FORMATS[kind], "count": len(rows),
                "type": TYPES[len(values[0])], **({"normalized": True} if normalized else {}), **members}
        self.root["accessors"].append(made)
        return len(self.root["accessors"]) - 1

    def sparse(self, accessor, at, values, kind="f"):
        """Replaces elements of an accessor."""
        self.root["accessors"][accessor]["sparse"] = {
            "count": len(at), "indices": {"bufferView": self.view(struct.pack(f"<{len(at)}H", *at)), "componentType": 5123},
            "values": {"bufferView": self.view(b"".join(struct.pack(f"<{len(row)}{kind}", *row) for row in values))}}

    def primitive(self, indices=INDICES, kind="H", **attributes):
        """A quad with other attributes than these, or more."""
        made = {"POSITION": lambda: self.accessor(CORNERS), "NORMAL": lambda: self.accessor([(0, 0, 1)] * 4), "TEXCOORD_0": lambda: self.accessor(UV)}
        names = {name: attributes[name] if name in attributes else make() for name, make in made.items()}
        names.update(attributes)
        out = {"attributes": {name: number for name, number in names.items() if number is not None}}
        if indices:
            out["indices"] = self.accessor([(i,) for i in indices], kind)
        return out

    def mesh(self, *primitives, **members):
        self.root["meshes"].append({"primitives": list(primitives), **members})
        return len(self.root["meshes"]) - 1

    def node(self, is_root=True, **members):
        self.root["nodes"].append(members)
        number = len(self.root["nodes"]) - 1
        if is_root:
            self.root["scenes"][0]["nodes"].append(number)
        return number

    def write(self, path):
        uri = "data:application/octet-stream;base64," + base64.b64encode(bytes(self.data)).decode()
        path.write_text(json.dumps({"buffers": [{"byteLength": len(self.data), "uri": uri}], **self.root}))
        return path
