# SPDX-License-Identifier: Apache-2.0
"""The tasks of PyMaterialX's tutorials, with this package: docs/python.md has both side by side."""
import contextlib
import io
import os
import pathlib
import re
import tempfile
import unittest

import common
import mxgen


class Tasks(unittest.TestCase):
    def setUp(self):
        self.context = mxgen.Context()

    def test_build_traverse_validate_and_write(self):
        """A document with a nodegraph, a shader that uses it and a material; its traversal; its file, read again."""
        with self.context.edit(name="wood") as edit:
            graph = edit.add("nodegraph", "Grain")
            graph.value("light", (0.6, 0.4, 0.2), "color3")
            noise = graph.add("fractal3d", "rings", "float").value("octaves", 2, "integer")
            ramp = graph.add("mix", "ramp", "color3").value("bg", (0.3, 0.15, 0.05), "color3")
            ramp.connect("fg", graph.child("light")).connect("mix", noise)
            graph.add("output", "out", "color3").connect(None, ramp)
            shader = edit.add("standard_surface", "Varnish", "surfaceshader").connect("base_color", graph, "out")
            edit.add("surfacematerial", "Wood", "material").connect("surfaceshader", shader)
            look = edit.add("look", "Table")
            look.add("materialassign", "all").set("material", "Wood").set("geom", "*")
        wood = edit.document
        self.assertEqual(str(wood.validate()), "")
        self.assertEqual([(node.category, node.name) for node in wood["Wood"].upstream],
                         [("standard_surface", "Varnish"), ("nodegraph", "Grain"), ("mix", "ramp"), ("fractal3d", "rings")])
        values = {element.path: element.value for element in wood.walk() if element.value is not None}
        self.assertEqual(values["Grain/rings/octaves"], 2)
        self.assertEqual(wood.look_materials("Table")[0].path, "Wood")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "wood.mtlx"
            path.write_text(wood.xml(), encoding="utf-8")
            self.assertTrue(mxgen.equal(self.context.load(path), wood))

    def test_generate_for_every_target(self):
        """The shaders of a document, for each target that can draw them."""
        marble = self.context.load(common.EXAMPLES / "marble.mtlx")
        sources = {target.name: marble.generate(target.name).pixel for target in mxgen.targets()}
        self.assertEqual(len(set(sources.values())), len(sources))
        self.assertIn("#version", sources["glsl"])

    def test_look_up_definitions(self):
        """The definition of a node, its inputs with defaults, and the nodes of a group."""
        document = self.context.load(common.EXAMPLES / "marble.mtlx")
        definition = document["NG_marble/noise"].definition
        defaults = {port.name: port.value for port in definition.inputs}
        self.assertEqual((definition.group, defaults["octaves"]), ("procedural3d", "3"))
        written = {element.name for element in document["NG_marble/noise"].inputs}
        self.assertEqual(set(defaults) - written, {"amplitude", "lacunarity", "diminish"})
        self.assertIn("noise2d", {nodedef.node for nodedef in self.context.library.nodedefs if nodedef.group == "procedural2d"})

    def test_change_a_document(self):
        """All textures of a document with another prefix; a node replaced by a value."""
        textured = self.context.load(common.EXAMPLES / "textured.mtlx")
        files = [element for element in textured.walk() if element.type == "filename"]
        self.assertTrue(files)
        with textured.edit() as edit:
            for element in files:
                edit[element].set("value", "moved/" + str(element.value))
        moved = edit.document
        self.assertTrue(all(str(moved[element.path].value).startswith("moved/") for element in files))
        variables = [variable.file for variable in moved.generate("glsl").variables if variable.file]
        self.assertTrue(variables and all("moved/" in file for file in variables))

    def test_edit_many_inputs_of_every_material(self):
        """A property changed in all shaders of a folder."""
        for path in sorted(common.EXAMPLES.glob("*.mtlx")):
            document = self.context.load(path)
            shaders = [element for element in document if element.category == "standard_surface"]
            with document.edit() as edit:
                for shader in shaders:
                    edit[shader].value("specular_roughness", 0.25, "float")
            for shader in shaders:
                self.assertEqual(edit.document[shader.path + "/specular_roughness"].value, 0.25)

    def test_color_spaces_and_units(self):
        """An edit sets the colour space and the unit of inputs, and shaders have the values in those of the scene."""
        edit = self.context.edit()
        product = edit.add("multiply", "product", "color3").value("in1", (0.5, 0.5, 0.5)).value("in2", 300.0, "float")
        edit.add("output", "out", "color3").connect(None, product)
        edit["product/in1"].set("colorspace", "srgb_texture")
        edit["product/in2"].set("unittype", "distance").set("unit", "centimeter")
        document = edit.end()
        self.assertEqual((document["product/in1"].get("colorspace"), document["product/in1"].value), ("srgb_texture", (0.5, 0.5, 0.5)))
        for unit, length in ("meter", 3), ("millimeter", 3000):
            shader = document.generate("glsl", options={"distance-unit": unit, "interface": "reduced"})
            value = float(re.search(r"out1 = vec4\(([0-9.]+),", shader.pixel)[1])
            self.assertAlmostEqual(value / length, ((0.5 + 0.055) / 1.055) ** 2.4, 5) # the curve of IEC 61966-2-1

    def test_calls_beside_pymaterialx(self):
        """The right column of docs/pymaterialx.md, from top to bottom. Each call gives something, or makes the page's document."""
        page = (common.EXAMPLES.resolve().parent / "docs/pymaterialx.md").read_text(encoding="utf-8")
        calls = re.findall(r"^\| .* \| `(.+)` \|$", page, re.M)
        text = common.GOLD.replace("</materialx>", '<nodegraph name="NG"><output name="out" type="float" value="1"/></nodegraph></materialx>')
        with tempfile.TemporaryDirectory() as folder:
            path, own, out = (pathlib.Path(folder) / name for name in ("gold.mtlx", "own.mtlx", "out.mtlx"))
            path.write_text(text, encoding="utf-8")
            own.write_text('<materialx version="1.39"/>', encoding="utf-8")
            names = {"mxgen": mxgen, "text": text, "path": path, "own_path": own, "out": out}
            for call in calls:
                is_value = not re.match(r"\w+ = ", call)
                result = eval(call, names) if is_value else exec(call, names)
                nothing = call.startswith("doc.save") or re.search(r"(remove|flatten)\(\)", call) or "colorspace" in call or call == "doc.validate()"
                self.assertTrue(not is_value or nothing or result, call)
            self.assertTrue(mxgen.equal(self.context.load(out), self.context.parse(text)))
        document = names["doc"]
        self.assertGreater(len(calls), 50)
        names = [element.name for element in document if not element.name.startswith("SR_copy_")] # what was inside stays
        self.assertEqual(names, ["ND_pattern", "NG_pattern", "pattern", "SR", "Spots", "Gold", "NG", "wood", "Wood"])
        self.assertEqual(document["SR/base_color"].value, (1, 0, 0))
        self.assertEqual(document["wood/rings/octaves"].type, "integer")
        self.assertEqual(document.validate().errors, 0)

    def test_programs_of_the_documentation(self):
        """Every program of README.md and docs/python.md runs in the root of the project."""
        root = common.EXAMPLES.resolve().parent
        pages = [root / "README.md", root / "docs/python.md"]
        programs = [program for page in pages for program in re.findall(r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.M | re.S)]
        self.assertGreater(len(programs), 2)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(root)
        for program in programs:
            out = io.StringIO()
            with contextlib.redirect_stdout(out):
                exec(compile(program, "documentation", "exec"), {})
            self.assertEqual("print" in program, bool(out.getvalue()))
