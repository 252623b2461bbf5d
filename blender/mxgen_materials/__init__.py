# SPDX-License-Identifier: Apache-2.0
"""MaterialX documents in Blender: import as Principled materials, export as OpenPBR, preview by mxgen (docs/blender.md)."""
from __future__ import annotations

import os
import pathlib
import subprocess
import tempfile

import bpy
from bpy_extras.io_utils import ExportHelper, ImportHelper

bl_info = {
    "name": "MaterialX by mxgen",
    "description": "Imports and exports materials as MaterialX documents",
    "author": "mxgen developers",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "File > Import, File > Export, Properties > Material",
    "category": "Import-Export",
}

NO_PACKAGE = "the Python package 'mxgen' is missing (Debian: python3-mxgen; otherwise: pip install mxgen)"


def _tell(operator: bpy.types.Operator, losses: list[object], done: str) -> None:
    """Reports what was done and what was lost; the text block has all losses."""
    if not losses:
        operator.report({"INFO"}, done)
        return
    text = bpy.data.texts.get("mxgen report") or bpy.data.texts.new("mxgen report")
    text.from_string("\n".join(str(loss) for loss in losses) + "\n")
    operator.report({"WARNING"}, f"{done}; {len(losses)} parts were lost: the text 'mxgen report' lists them. {losses[0]}")


class ImportMaterialX(bpy.types.Operator, ImportHelper):
    """Makes Principled materials of a MaterialX document"""

    bl_idname = "mxgen.import_document"
    bl_label = "Import MaterialX"
    bl_options = {"UNDO"}
    filename_ext = ".mtlx"
    filter_glob: bpy.props.StringProperty(default="*.mtlx", options={"HIDDEN"})
    bake: bpy.props.BoolProperty(name="Bake graphs", default=True, description="Graphs without a counterpart become images beside the document")
    size: bpy.props.IntProperty(name="Size", default=0, min=0, max=16384, description="Texels along each side; 0: those of the largest texture, or 1024")
    on_object: bpy.props.BoolProperty(name="On the active object", default=False, description="Graphs are baked on the surface of the active mesh, so they "
                                      "may read positions and normals; otherwise over its texture coordinates alone")

    def execute(self, context: bpy.types.Context) -> set[str]:
        try:
            import mxgen
        except ImportError as error:
            self.report({"ERROR"}, f"{NO_PACKAGE}: {error}")
            return {"CANCELLED"}
        from .baking import Baking
        from .importing import import_file
        path = pathlib.Path(self.filepath)
        baking = Baking(path.with_name(f"{path.stem}_baked"), self.size, context.object if self.on_object else None)
        try:
            made, losses = import_file(self.filepath, baking if self.bake else None)
        except mxgen.DocumentError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if not made:
            self.report({"ERROR"}, "; ".join(map(str, losses)) or "the document has no surface material")
            return {"CANCELLED"}
        if context.object is not None and hasattr(context.object.data, "materials"):
            context.object.data.materials.append(made[0])
        _tell(self, losses, f"{len(made)} materials imported")
        return {"FINISHED"}


class ExportMaterialX(bpy.types.Operator, ExportHelper):
    """Writes the materials of the file as OpenPBR into a MaterialX document"""

    bl_idname = "mxgen.export_document"
    bl_label = "Export MaterialX"
    filename_ext = ".mtlx"
    filter_glob: bpy.props.StringProperty(default="*.mtlx", options={"HIDDEN"})
    only_active: bpy.props.BoolProperty(name="Active material only", default=False)

    def execute(self, context: bpy.types.Context) -> set[str]:
        try:
            import mxgen
        except ImportError as error:
            self.report({"ERROR"}, f"{NO_PACKAGE}: {error}")
            return {"CANCELLED"}
        from .exporting import export_file
        active = context.object.active_material if context.object is not None else None
        materials = [active] if self.only_active else [one for one in bpy.data.materials if not one.is_grease_pencil]
        if not any(materials):
            self.report({"ERROR"}, "there is no material to export")
            return {"CANCELLED"}
        try:
            losses = export_file(self.filepath, materials)
        except (mxgen.Error, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        _tell(self, losses, f"{len(materials)} materials exported")
        return {"FINISHED"}


class PreviewMaterialX(bpy.types.Operator):
    """Draws the active material with mxgen render, and shows the picture as an image"""

    bl_idname = "mxgen.preview"
    bl_label = "Preview by mxgen"
    size: bpy.props.IntProperty(name="Size", default=256, min=16, max=4096)

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.object is not None and context.object.active_material is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        with tempfile.TemporaryDirectory() as folder:
            document, picture = os.path.join(folder, "material.mtlx"), os.path.join(folder, "picture.png")
            if "FINISHED" not in bpy.ops.mxgen.export_document(filepath=document, only_active=True):
                return {"CANCELLED"}
            try:
                run = subprocess.run(["mxgen", "render", document, "-o", picture, "-s", str(self.size)], capture_output=True, text=True, check=False)
            except FileNotFoundError:
                self.report({"ERROR"}, "the program mxgen is not installed (Debian: mxgen)")
                return {"CANCELLED"}
            if run.returncode:
                self.report({"ERROR"}, run.stderr.strip())
                return {"CANCELLED"}
            old = bpy.data.images.get("mxgen preview")
            if old is not None:
                bpy.data.images.remove(old)
            image = bpy.data.images.load(picture)
            image.name = "mxgen preview"
            image.pack()
        return {"FINISHED"}


class MaterialPanel(bpy.types.Panel):
    """The preview in the properties of a material"""

    bl_idname = "MATERIAL_PT_mxgen"
    bl_label = "MaterialX"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "material"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, _context: bpy.types.Context) -> None:
        self.layout.operator(PreviewMaterialX.bl_idname)
        self.layout.operator(ExportMaterialX.bl_idname).only_active = True


CLASSES = (ImportMaterialX, ExportMaterialX, PreviewMaterialX, MaterialPanel)


def _import_item(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    menu.layout.operator(ImportMaterialX.bl_idname, text="MaterialX (.mtlx)")


def _export_item(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    menu.layout.operator(ExportMaterialX.bl_idname, text="MaterialX (.mtlx)")


def register() -> None:
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.TOPBAR_MT_file_import.append(_import_item)
    bpy.types.TOPBAR_MT_file_export.append(_export_item)


def unregister() -> None:
    bpy.types.TOPBAR_MT_file_export.remove(_export_item)
    bpy.types.TOPBAR_MT_file_import.remove(_import_item)
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
