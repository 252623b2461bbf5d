# SPDX-License-Identifier: Apache-2.0
"""Documents: reading, elements, edits, text."""
import pathlib
import tempfile
import unittest

import common
import mxgen


class Elements(unittest.TestCase):
    def setUp(self):
        self.context = mxgen.Context()
        self.gold = self.context.parse(common.GOLD, name="gold.mtlx")

    def test_element(self):
        color = self.gold["SR/base_color"]
        self.assertEqual((color.category, color.name, color.type, color.path), ("input", "base_color", "color3", "SR/base_color"))
        self.assertEqual((color.file, color.line, color.column), ("gold.mtlx", 4, 5))
        self.assertEqual(color.parent, self.gold.find("SR"))
        self.assertEqual(color.parent.parent, self.gold.root)
        self.assertIsNone(self.gold.root.parent)
        self.assertEqual(self.gold.root.path, "")
        self.assertEqual(self.gold.root.child("SR").child("base_color"), color)
        self.assertIsNone(self.gold.root.child("None"))
        self.assertIsNone(self.gold.find("SR/none"))
        self.assertEqual(len({color, self.gold["SR/base_color"], self.gold["SR"]}), 2)
        self.assertEqual(repr(color), "<Element input 'SR/base_color'>")
        with self.assertRaises(KeyError):
            self.gold["SR/none"]
        with self.assertRaises(mxgen.ArgumentError):
            mxgen.Element(self.gold, 12345)

    def test_attributes(self):
        color = self.gold["SR/base_color"]
        self.assertEqual(color.attributes, {"type": "color3", "value": "0.9, 0.6, 0.2"})
        self.assertEqual((color.get("name"), color.get("value"), color.get("colorspace")), ("base_color", "0.9, 0.6, 0.2", None))

    def test_values(self):
        document = self.context.parse("""<materialx version="1.39"><nodegraph name="N">
            <input name="b" type="boolean" value="true"/><input name="i" type="integer" value="16777217"/>
            <input name="f" type="float" value="0.5"/><input name="v" type="vector2" value="1, 2.5"/>
            <input name="m" type="matrix33" value="1,0,0, 0,1,0, 0,0,1"/><input name="s" type="string" value="été"/>
            <input name="a" type="floatarray" value="1, 2, 3"/><input name="none" type="float"/>
            <output name="out" type="float" interfacename="f"/></nodegraph></materialx>""")
        values = {element.name: element.value for element in document["N"].inputs}
        self.assertEqual(values, {"b": True, "i": 16777217, "f": 0.5, "v": (1.0, 2.5), "m": (1, 0, 0, 0, 1, 0, 0, 0, 1), "s": "été",
                                  "a": "1, 2, 3", "none": None})
        self.assertIs(values["b"], True)
        connection = document["N/out"].connection
        self.assertEqual((connection.source, connection.interfacename), (document["N/f"], "f"))

    def test_graph(self):
        connection = self.gold["SR/specular_roughness"].connection
        self.assertEqual((connection.source.name, connection.output, connection.interfacename), ("Spots", "", ""))
        self.assertIsNone(self.gold["SR/base_color"].connection)
        self.assertEqual([element.name for element in self.gold["Gold"].upstream], ["SR", "Spots"])
        definition = self.gold["Spots"].definition
        self.assertEqual((definition.name, definition.node), ("ND_noise2d_float", "noise2d"))
        self.assertEqual([port.name for port in definition.outputs], ["out"])
        self.assertIsNone(self.gold["SR/base_color"].definition)

    def test_dangling(self):
        text = common.GOLD.replace('nodename="Spots"', 'nodename="Gone"')
        document = self.context.parse(text)
        self.assertIsNone(document["SR/specular_roughness"].connection.source)
        self.assertGreater(document.validate().errors, 0)

    def test_upstream_of_graphs(self):
        marble = self.context.load(common.EXAMPLES / "marble.mtlx")
        names = [element.name for element in marble["Marble"].upstream]
        self.assertEqual(len(names), len(set(names)))
        self.assertLess(names.index("NG_marble"), names.index("noise"))
        self.assertIn("place", names)

    def test_walk(self):
        self.assertEqual([element.name for element in self.gold], ["SR", "Spots", "Gold"])
        self.assertEqual([element.name for element in self.gold.walk()],
                         ["", "SR", "base_color", "metalness", "specular_roughness", "Spots", "Gold", "surfaceshader"])
        self.assertEqual([element.name for element in self.gold["SR"].children_of("input")],
                         [element.name for element in self.gold["SR"].inputs])
        marble = self.context.load(common.EXAMPLES / "marble.mtlx")
        self.assertEqual([element.name for element in marble["NG_marble"].outputs], ["out"])

    def test_document(self):
        self.assertEqual(self.gold.renderables, (mxgen.Renderable("Gold", "material", "surfacematerial"),))
        self.assertEqual(self.gold.files, ("gold.mtlx",))
        self.assertEqual(len(self.gold.diagnostics), 0)
        self.assertEqual(len(self.gold.nodedefs), len(self.context.library.nodedefs))
        look = self.context.parse(common.GOLD.replace("</materialx>", """<look name="L">
            <materialassign name="m" geom="*" material="Gold"/></look></materialx>"""))
        self.assertEqual([material.path for material in look.look_materials("L")], ["Gold"])
        self.assertEqual(look.look_materials("Gold"), ())

    def test_text(self):
        again = self.context.parse(self.gold.xml())
        self.assertTrue(mxgen.equal(again, self.gold))
        self.assertFalse(mxgen.equal(self.context.parse(common.GOLD.replace("0.9", "0.8")), self.gold))
        self.assertFalse(mxgen.equal(self.gold["SR"], self.gold["Gold"]))
        self.assertFalse(mxgen.equal(self.context.parse(common.GOLD.replace("<noise2d name=\"Spots\" type=\"float\" />", "")), self.gold))

    def test_broken(self):
        with self.assertRaises(mxgen.DocumentError) as caught:
            self.context.parse("<materialx", name="broken.mtlx")
        self.assertIn("broken.mtlx:1:", str(caught.exception))
        self.assertEqual(caught.exception.document.renderables, ())
        with self.assertRaises(mxgen.DocumentError) as caught:
            self.context.load("nowhere/none.mtlx")
        self.assertEqual(caught.exception.diagnostics[0].id, "file-missing")


class Edits(unittest.TestCase):
    def setUp(self):
        self.context = mxgen.Context()

    def build(self):
        with self.context.edit(name="gold") as edit:
            shader = edit.add("standard_surface", "SR", "surfaceshader")
            shader.value("base_color", (0.9, 0.6, 0.2), "color3").value("metalness", 1, "float")
            shader.connect("specular_roughness", edit.add("noise2d", "Spots", "float"))
            edit.add("surfacematerial", "Gold", "material").connect("surfaceshader", shader)
        return edit.document

    def test_built_equals_parsed(self):
        built, parsed = self.build(), self.context.parse(common.GOLD)
        self.assertTrue(mxgen.equal(built, parsed), built.xml())
        self.assertEqual(built.generate("glsl").pixel, parsed.generate("glsl").pixel)
        self.assertEqual((built["SR"].file, built["SR"].line), (None, 0))

    def test_every_example_rebuilt_equals_itself(self):
        def rebuild(element, below):
            for child in element.children:
                draft = below.add(child.category, child.name or None, child.type or None)
                for name, value in child.attributes.items():
                    draft.set(name, value)
                rebuild(child, draft)

        count = 0
        for path in sorted(common.EXAMPLES.glob("*.mtlx")):
            read = self.context.load(path)
            edit = self.context.edit(name=str(path))
            for name, value in read.root.attributes.items():
                edit.root.set(name, value)
            rebuild(read.root, edit.root)
            self.assertTrue(mxgen.equal(edit.end(), read), path)
            count += 1
        self.assertGreater(count, 10)

    def test_values(self):
        with self.context.edit() as edit:
            node = edit.add("nodegraph", "N")
            for name, kind, value in (("b", "boolean", True), ("i", "integer", 16777217), ("f", "float", 0.1), ("n", "float", 3),
                                      ("v", "vector2", [1, 2.5]), ("s", "string", "a b")):
                node.value(name, value, kind)
            node.value("f", 0.25).value("v", (3.0, 4.0))
        values = {element.name: element.value for element in edit.document["N"].inputs}
        self.assertEqual(values, {"b": True, "i": 16777217, "f": 0.25, "n": 3.0, "v": (3.0, 4.0), "s": "a b"})

    def test_changes(self):
        built = self.build()
        with built.edit() as edit:
            shader = edit[built["SR"]]
            self.assertEqual(shader, edit["SR"])
            self.assertEqual(len({shader, edit["SR"], edit["Gold"]}), 2)
            self.assertEqual(shader.number, built["SR"].number)
            self.assertEqual(edit[built["SR"]].rename("Shader"), edit[built["SR"]])
            shader.set("xpos", "1").set("ypos", "2").set("ypos", None)
            edit["Spots"].remove()
            shader.value("specular_roughness", 0.1)
            self.assertIsNone(edit.find("Spots"))
            self.assertIsNone(shader.child("none"))
            self.assertEqual(shader.child("base_color"), edit["Shader/base_color"])
            shader.move(before=edit["Gold"])
            graph = edit.add("nodegraph", "N")
            graph.copy(built["Spots"], "noise")
            edit.copy(built["Spots"], "Other").move(graph)
            graph.add("output", "out", "float").connect(None, edit["N/noise"])
            edit["N/Other"].rename("other")
            edit["Shader"].connect("specular_roughness", graph, "out")
        changed = edit.document
        self.assertEqual([element.path for element in changed], ["Shader", "Gold", "N"])
        self.assertEqual(changed["Shader"].attributes, {"type": "surfaceshader", "xpos": "1"})
        self.assertEqual(changed["Gold/surfaceshader"].connection.source, changed["Shader"])
        self.assertEqual([element.name for element in changed["N"].children], ["noise", "other", "out"])
        self.assertEqual(changed["Shader/specular_roughness"].connection.source.name, "N")
        self.assertEqual(changed.validate().errors, 0)
        self.assertIsNotNone(built.find("Spots")) # documents stay
        with built.edit() as edit:
            edit["SR"].flatten()
        self.assertEqual(edit.document["SR"].category, "surface")
        self.assertEqual(edit.document["Gold/surfaceshader"].connection.source.name, "SR")
        with built.edit() as edit:
            graph = edit.group([edit["Spots"]], "Pattern")
            with self.assertRaisesRegex(mxgen.EditError, "no node of the root"):
                edit.group([graph], "Outer")
        self.assertEqual([element.name for element in edit.document["Pattern"].children], ["Spots", "Spots_out"])
        self.assertEqual(edit.document["SR/specular_roughness"].connection.output, "Spots_out")
        with edit.document.edit() as edit:
            definition = edit.define(edit["Pattern"], "ND_pattern", "pattern")
            self.assertEqual(definition, edit["ND_pattern"])
            with self.assertRaisesRegex(mxgen.EditError, "implements 'ND_pattern' already"):
                edit.define(edit["Pattern"], "ND_other", "other")
        self.assertEqual(edit.document["pattern"].definition.name, "ND_pattern")
        self.assertEqual(edit.document["SR/specular_roughness"].connection.source.name, "pattern")
        self.assertEqual(repr(mxgen.Draft(edit, 7)), "<Draft 7>")

    def test_failures(self):
        edit = self.context.edit()
        shader = edit.add("standard_surface", "SR", "surfaceshader")
        for failing, text in ((lambda: edit.add("noise2d", "SR", "float"), "already"), (lambda: edit.add("noise2d", "1x"), "name"),
                              (lambda: shader.value("base_color", 1.0), "type"), (lambda: shader.value("base", "red", "float"), "red"),
                              (lambda: shader.value("base", float("nan"), "float"), "base"), (lambda: shader.rename(""), "name"),
                              (lambda: shader.value("base", (1.0, 2.0), "float"), "components"),
                              (lambda: shader.move(shader), "itself"), (lambda: shader.set("a b", "1"), "name"),
                              (lambda: shader.set("xmlns:x", ""), "XML"), (lambda: edit.add("xi:include", "i"), "XML"),
                              (lambda: edit.root.set("version", "1.36"), "1.39")):
            with self.assertRaises(mxgen.EditError) as caught:
                failing()
            self.assertIn(text, str(caught.exception))
        with self.assertRaises(KeyError):
            edit["none"]
        self.assertTrue(mxgen.equal(edit.end(), self.context.parse(
            '<materialx version="1.39"><standard_surface name="SR" type="surfaceshader"/></materialx>')))

    def test_upgrades(self):
        with self.context.edit() as edit:
            edit.add("constant", "C", "boolean").add("parameter", "value", "boolean").set("value", "True")
        self.assertEqual([item.id for item in edit.document.diagnostics], ["upgraded", "outdated"])
        self.assertTrue(mxgen.equal(edit.document, self.context.parse(
            '<materialx version="1.39"><constant name="C" type="boolean"><input name="value" type="boolean" value="true"/></constant></materialx>')))

    def test_errors_at_the_end(self):
        edit = self.context.edit(name="sphere")
        edit.add("surfacematerial", "M", "material").add("input", "surfaceshader", "surfaceshader").set("nodename", "none")
        document = edit.end()
        found = document.validate()
        self.assertEqual((found.errors, found[0].path, found[0].line), (1, "M/surfaceshader", 0))

    def test_end(self):
        edit = self.context.edit()
        draft = edit.add("noise2d", "n", "float")
        edit.end()
        for use in (edit.end, lambda: edit.root, lambda: draft.set("a", "b"), lambda: edit.find("n"), lambda: edit["n"]):
            with self.assertRaisesRegex(mxgen.Error, "has ended"):
                use()
        edit.cancel()
        with self.assertRaises(ZeroDivisionError):
            with self.context.edit() as edit:
                1 / 0
        with self.assertRaisesRegex(mxgen.Error, "not made"):
            edit.document
        with self.context.edit() as edit:
            edit.cancel()

    def test_wrong_edit(self):
        one, two = self.context.edit(), self.context.edit()
        with self.assertRaisesRegex(ValueError, "another edit"):
            one.add("add", "a", "float").connect("in1", two.add("add", "a", "float"))
        with self.assertRaisesRegex(ValueError, "another document"):
            one[self.build()["SR"]]
        removed = self.build()
        with removed.edit() as edit:
            edit["Spots"].remove()
            edit["SR"].value("specular_roughness", 0.5)
            with self.assertRaisesRegex(mxgen.EditError, "no such element"):
                edit[removed["Spots"]].rename("Dots")
        other = mxgen.Context()
        with self.assertRaises(ValueError):
            self.context.edit(self.build(), library=other.library)


class Text(unittest.TestCase):
    def test_format(self):
        text = '<materialx   version="1.39"><!-- why --><noise2d type="float" name="n"/></materialx>'
        formatted = mxgen.Context().format(text)
        self.assertIn("<!-- why -->", formatted)
        self.assertIn('  <noise2d name="n" type="float"', formatted)
        self.assertEqual(mxgen.Context().format(formatted.encode(), name="n"), formatted)

    def test_translate(self):
        context = mxgen.Context()
        document = context.parse('<materialx version="1.39"><standard_surface name="S" type="surfaceshader">'
                                 '<input name="base" type="float" value="1"/><input name="metalness" type="float" value="0.25"/>'
                                 '<input name="thin_film_thickness" type="float" value="300"/></standard_surface></materialx>')
        translated = document.translate("UsdPreviewSurface")
        self.assertEqual({diagnostic.id for diagnostic in translated.diagnostics}, {"translation-loss"})
        self.assertEqual(context.parse(translated.text)["S/metallic"].value, 0.25)
        with self.assertRaises(mxgen.DocumentError):
            document.translate("lambert")
        mixed = context.parse('<materialx version="1.39"><standard_surface name="A" type="surfaceshader"/>'
                              '<standard_surface name="B" type="surfaceshader"/><mix name="C" type="surfaceshader">'
                              '<input name="fg" type="surfaceshader" nodename="A"/><input name="bg" type="surfaceshader" nodename="B"/>'
                              '<input name="mix" type="float" value="0.5"/></mix></materialx>')
        self.assertIn('<mix name="C"', mixed.translate("gltf_pbr").text)
        self.assertIn('<gltf_pbr name="C"', mixed.translate("gltf_pbr", joined=True).text)

    def test_upgrade(self):
        path = common.EXAMPLES / "old_copper.mtlx"
        context = mxgen.Context()
        upgraded = context.upgrade(path.read_text(encoding="utf-8"), name="old.mtlx")
        self.assertIn('version="1.39"', upgraded.text)
        self.assertEqual({diagnostic.id for diagnostic in upgraded.diagnostics}, {"upgraded"})
        self.assertEqual(context.rewrite(mxgen.Rewriting.UPGRADE, path).text, upgraded.text)
        with self.assertRaises(mxgen.DocumentError):
            context.upgrade("<materialx")

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "größe.mtlx"
            path.write_text(common.GOLD, encoding="utf-8")
            self.assertEqual(mxgen.Context().load(path).files, (str(path),))
