# SPDX-License-Identifier: Apache-2.0
"""What a user of Python expects of objects, files, values and notebooks."""
import errno
import gc
import io
import pathlib
import tempfile
import threading
import unittest
import unittest.mock
import zipfile

import common
import mxgen

try:
    import numpy
except ImportError:
    numpy = None


class Containers(unittest.TestCase):
    def setUp(self):
        self.context = mxgen.Context()
        self.gold = self.context.parse(common.GOLD, name="gold.mtlx")

    def test_document(self):
        self.assertTrue("SR" in self.gold and "SR/base_color" in self.gold and self.gold["SR"] in self.gold)
        self.assertFalse("SR/none" in self.gold or 5 in self.gold or self.context.parse(common.GOLD)["SR"] in self.gold)
        self.assertEqual(len(self.gold), 3)
        self.assertTrue(self.context.edit().end())

    def test_element(self):
        shader = self.gold["SR"]
        self.assertEqual(shader["base_color"], self.gold["SR/base_color"])
        self.assertEqual(shader.input("base_color"), shader.inputs[0])
        self.assertEqual(list(shader), list(shader.children))
        self.assertTrue("base_color" in shader and "none" not in shader)
        self.assertIsNone(shader.input("none"))
        self.assertIsNone(shader.output("base_color"))
        self.assertIsNone(shader.find("none"))
        with self.assertRaises(KeyError):
            shader["none"]
        self.assertEqual(self.gold.root.children[-1].name, "Gold")

    def test_edges(self):
        edges = self.gold["Gold"].edges
        self.assertEqual([(edge.element.name, edge.input.name, edge.upstream.name) for edge in edges],
                         [("Gold", "surfaceshader", "SR"), ("SR", "specular_roughness", "Spots")])
        self.assertEqual(self.gold["SR/specular_roughness"].edges, edges[1:])
        marble = self.context.load(common.EXAMPLES / "marble.mtlx")
        edges = marble["Marble"].edges
        self.assertEqual(len({edge.input for edge in edges}), len(edges))
        self.assertTrue(any(edge.element.name == "NG_marble" and edge.input.category == "output" for edge in edges))
        self.assertEqual(marble["NG_marble"].output("out").category, "output")

    def test_texts_of_objects(self):
        shader = self.gold.generate("glsl")
        scene = self.context.scene("/a/b")
        texts = [repr(thing) for thing in (self.context, self.context.library, self.gold, shader, scene)]
        self.assertRegex(" ".join(texts), r"<Context> <Library: \d+ definitions> <Document 'gold.mtlx': 3 elements> <Shader 'Gold' for glsl>"
                         r" <Scene: 2 primitives>")
        self.assertEqual(repr(self.gold.generate("glsl", only_diagnostics=True)), "<Shader: diagnostics only>")
        looks = self.context.load(common.EXAMPLES / "slots/looks.mtlx")
        bindings = looks.bind(self.context.load_scene(common.EXAMPLES / "slots/receiver.usda"), "finished")
        self.assertRegex(repr(bindings), r"<Bindings: \d+ stacks>")

    def test_renderables_generate(self):
        for renderable in self.gold.renderables:
            self.assertEqual(self.gold.generate("glsl", renderable).info.path, renderable.path)

    def test_end_of_a_block(self):
        with mxgen.Context() as context, context.parse(common.GOLD) as document:
            shader = document.generate("glsl")
        for use in lambda: context.parse("<materialx/>"), lambda: document.renderables, document.xml:
            with self.assertRaisesRegex(mxgen.Error, "has ended"):
                use()
        document.close()
        self.assertIn("void main", shader.pixel)  # what was made from it stays
        self.assertEqual((repr(document), repr(context)), ("<Document: ended>", "<Context: ended>"))
        with self.assertRaises(AttributeError):
            document.nothing

    def test_diagnostics_stay(self):
        context = mxgen.Context()
        document = context.parse(common.GOLD.replace("<standard_surface ", '<standard_surface typo="1" ', 1))
        found = document.validate()
        with self.assertRaises(mxgen.DocumentError) as caught:
            context.parse("<materialx").close()
        error = caught.exception
        texts = str(found), str(error.diagnostics)
        self.assertIn("typo", texts[0])
        for ended in document, error.document, context:
            if ended is not None:
                ended.close()
        del document, context
        others = [mxgen.Context().parse(common.GOLD) for _ in range(20)]  # their memory may be that of what has ended
        self.assertEqual((str(found), str(error.diagnostics)), texts)
        self.assertTrue(all(others))


class Values(unittest.TestCase):
    def setUp(self):
        self.gold = mxgen.Context().parse(common.GOLD)

    def test_types_of_the_definition(self):
        with self.gold.edit() as edit:
            shader = edit["SR"].value("coat", 0.5).value("coat_color", [1, 0, 0]).value("thin_walled", True).value("transmission_dispersion", 1)
            shader.connect("coat_roughness", self.gold["Spots"])
            edit.add("rotate3d", "R", "vector3").value("axis", (0, 1, 0))
            edit.add("constant", "M", "matrix33").value("value", ((1, 0, 0), (0, 1, 0), (0, 0, 2)))
        made = edit.document
        self.assertEqual([made[f"SR/{name}"].type for name in ("coat", "coat_color", "thin_walled")], ["float", "color3", "boolean"])
        self.assertEqual(made["M/value"].value, (1, 0, 0, 0, 1, 0, 0, 0, 2))
        self.assertEqual(made["SR/coat_roughness"].connection.source, made["Spots"])
        self.assertEqual(made.validate().errors, 0)

    @unittest.skipIf(numpy is None, "numpy is not installed")
    def test_arrays(self):
        with self.gold.edit() as edit:
            edit["SR"].value("base_color", numpy.array([1, 0.5, 0])).value("coat", numpy.float32(0.25)).value("base", numpy.array(0.5))
        values = [edit.document[f"SR/{name}"].value for name in ("base_color", "coat", "base")]
        self.assertEqual(values, [(1, 0.5, 0), 0.25, 0.5])

    def test_integers(self):
        class Number:  # as numpy.int64, which is no int
            def tolist(self):
                return 16777219

        with self.gold.edit() as edit:
            for name, value in (("A", 16777217), ("B", [16777217]), ("C", Number())):
                edit.add("constant", name, "integer").value("value", value)
            for kind, value in (("integer", 1.5), ("integer", 3e7), ("boolean", 0.5)):
                with self.assertRaisesRegex(mxgen.EditError, "fraction|0 or 1"):
                    edit.add("constant", None, kind).value("value", value)
        self.assertEqual([edit.document[f"{name}/value"].value for name in "ABC"], [16777217, 16777217, 16777219])

    def test_names(self):
        edit = self.gold.edit()
        self.assertEqual([edit.unique_name(name) for name in ("SR", "new", "1 x", "")], ["SR2", "new", "_1_x", "_"])
        edit.add("noise2d", edit.unique_name("SR"), "float")
        self.assertEqual(edit.unique_name("SR"), "SR3")
        self.assertEqual(edit["SR"].unique_name("base_color"), "base_color2")
        child, looked = mxgen.edit.Draft.child, []
        with unittest.mock.patch.object(mxgen.edit.Draft, "child", lambda draft, name: looked.append(name) or child(draft, name)):
            for _ in range(100):
                edit.add("constant", edit.unique_name("many"), "float")
        self.assertLess(len(looked), 400)  # not each number for each name
        self.assertTrue("SR2" in edit and "SR3" not in edit)
        edit.cancel()

    def test_elements_of_drafts(self):
        edit = self.gold.edit()
        added, gone = edit.add("noise2d", "N", "float"), edit.add("noise2d", "M", "float")
        with self.assertRaisesRegex(mxgen.Error, "not made a document"):
            _ = added.element
        added.rename("dots")
        gone.remove()
        made = edit.end()
        self.assertEqual((added.element, edit.document), (made["dots"], made))
        with self.assertRaises(mxgen.ArgumentError):
            _ = gone.element

    def test_removed_references(self):
        edit = self.gold.edit()
        edit["Spots"].remove()
        with self.assertRaises(mxgen.DocumentError) as caught:
            edit.end()
        self.assertEqual([diagnostic.id for diagnostic in caught.exception.diagnostics], ["removed-reference"])
        self.assertNotIn("Spots", caught.exception.document)

    def test_elements_of_another_document(self):
        edit = self.gold.edit()
        with self.assertRaisesRegex(ValueError, "another document"):
            edit["SR"].connect("base", mxgen.Context().parse(common.GOLD)["Spots"])


class Files(unittest.TestCase):
    def test_missing(self):
        context = mxgen.Context()
        for call in lambda: context.load("none.mtlx"), lambda: context.load_library("none.mtlx"), lambda: context.load_scene("none.usda"):
            with self.assertRaises(FileNotFoundError) as caught:
                call()
            self.assertIsInstance(caught.exception, mxgen.MissingFileError)
            self.assertIn("none", str(caught.exception))
            self.assertEqual(caught.exception.errno, errno.ENOENT)

    def test_save(self):
        gold = mxgen.Context().parse(common.GOLD)
        with tempfile.TemporaryDirectory() as folder:
            gold.save(pathlib.Path(folder) / "gold.mtlx")
            self.assertTrue(mxgen.equal(mxgen.Context().load(pathlib.Path(folder) / "gold.mtlx"), gold))

    def test_archive(self):
        data = io.BytesIO()
        with zipfile.ZipFile(data, "w") as archive:
            archive.writestr("looks/main.mtlx", '<materialx version="1.39"><xi:include href="../gold.mtlx" xmlns:xi='
                             '"http://www.w3.org/2001/XInclude"/><image name="i" type="color3"><input name="file" type="filename"'
                             ' value="maps/a.&lt;UDIM&gt;.png"/></image></materialx>')
            archive.writestr("gold.mtlx", common.GOLD)
            archive.writestr("looks/maps/a.1001.png", b"")
            archive.writestr("looks/maps/a.1002.png", b"")
        files = mxgen.ZipFiles(data)
        context = mxgen.Context(resolver=files.open, list_folder=files.list_folder)
        document = context.load("looks/main.mtlx")
        self.assertEqual(document.files, ("looks/main.mtlx", "gold.mtlx"))
        image = next(variable for variable in document.generate("glsl", "i").variables if variable.tiles)
        self.assertEqual([tile.u for tile in image.tiles], [0, 1])
        with self.assertRaises(FileNotFoundError):
            context.load("../gold/none.mtlx")
        self.assertIsNone(files.list_folder("", "none"))

    def test_entries_that_cannot_be_read(self):
        data = io.BytesIO()
        with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("large.mtlx", common.GOLD + " " * (3 << 20))
            archive.writestr("damaged.mtlx", common.GOLD)
            offset = archive.getinfo("damaged.mtlx").header_offset + 40
            archive.writestr("main.mtlx", '<materialx version="1.39"><xi:include href="damaged.mtlx" xmlns:xi="http://www.w3.org/2001/XInclude"/></materialx>')
        damaged = bytearray(data.getvalue())
        damaged[offset:offset + 60] = bytes(60)
        context = mxgen.Context(resolver=mxgen.ZipFiles(io.BytesIO(damaged), max_file_mib=2).open)
        for name, reason in ("large.mtlx", "larger than 2 MiB"), ("damaged.mtlx", "the archive says"), ("main.mtlx", "the archive says"):
            with self.assertRaisesRegex(mxgen.DocumentError, reason) as raised:
                context.load(name)
            self.assertIn(raised.exception.diagnostics[0].id, ("file-unreadable", "include-missing"))
        self.assertTrue(mxgen.Context(resolver=mxgen.ZipFiles(data).open).load("large.mtlx"))


class Pictures(unittest.TestCase):
    def setUp(self):
        self.gold = mxgen.Context().load(common.EXAMPLES / "textured.mtlx")
        self.program = pathlib.Path(common.PROGRAM).resolve().with_name("mxgen-render")

    @unittest.skipIf(numpy is None, "numpy is not installed")
    def test_render(self):
        if not self.program.exists():
            self.skipTest("mxgen-render is not built")
        with self.assertRaisesRegex(mxgen.RenderError, "textures/wood_color.png.*missing-texture"): # the textures are not there
            mxgen.render(self.gold, program=self.program)
        pixels = mxgen.render(self.gold, self.gold.renderables[0], size=(24, 16), options=["--missing-texture", "checker"], program=self.program)
        self.assertEqual((pixels.shape, pixels.dtype), ((16, 24, 3), numpy.uint8))
        self.assertGreater(len(numpy.unique(pixels)), 20)
        with self.assertRaisesRegex(mxgen.RenderError, "none"):
            mxgen.render(self.gold, "none", program=self.program)

    def test_bake(self):
        if not self.program.exists():
            self.skipTest("mxgen-render is not built")
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(mxgen.RenderError, "textures/wood_color.png.*missing-texture"):
                mxgen.bake(self.gold, folder, program=self.program)
            marble = mxgen.Context().load(common.EXAMPLES / "marble.mtlx")
            path = mxgen.bake(marble, folder, marble.renderables[0], options=["--mesh", "plane", "--size", "16"], program=self.program)
            flat = mxgen.Context().load(path)
            self.assertEqual([element.category for element in flat if element.category in ("image", "nodegraph")], ["image"])
            self.assertTrue((pathlib.Path(folder) / "SR_marble_base_color.png").exists())
            with self.assertRaisesRegex(mxgen.RenderError, "none"):
                mxgen.bake(marble, folder, "none", program=self.program)

    def test_without_the_program(self):
        with self.assertRaisesRegex(mxgen.RenderError, "no-such-program"):
            mxgen.render_picture(self.gold, program="no-such-program")
        with self.assertRaises(TypeError):
            mxgen.render_picture(self.gold, 5)
        with self.assertRaises(ImportError if numpy is None else mxgen.RenderError):
            mxgen.render(self.gold, program="no-such-program")

    def test_notebook(self):
        broken = mxgen.Context().parse(common.BROKEN, name="<b>")
        self.assertIn("&lt;b&gt;:4:", broken._repr_html_())
        png = self.gold._repr_png_()
        self.assertTrue(png is None or png.startswith(b"\x89PNG"))


class Locks(unittest.TestCase):
    def test_generation_runs_beside_python(self):
        """Two threads generate at once: each waits in a callback until the other is there, too."""
        meeting = threading.Barrier(2, timeout=60)
        met = []

        def cancel():
            if not met:
                meeting.wait()
                met.append(True)
            return False

        def work():
            mxgen.Context(cancel=cancel).parse(common.GOLD).generate("glsl")

        threads = [threading.Thread(target=work) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertFalse(meeting.broken)
        gc.collect()
