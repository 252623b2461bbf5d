# SPDX-License-Identifier: Apache-2.0
"""Scenes, and the layers of their primitives. examples/slots/looks.mtlx has the looks; docs/slots.md has the rules."""
import gc
import json
import pathlib
import subprocess
import tempfile
import unittest

import common
import mxgen

STAGE = """#usda 1.0
( upAxis = "Z"; metersPerUnit = 0.5 )
def Xform "world" {
    def Mesh "box" (prepend apiSchemas = ["MaterialBindingAPI"]) {
        float[] primvars:wear = [0.25, 0.5] (interpolation = "vertex")
        bool doubleSided = 1
        token subdivisionScheme = "none"
        rel friends = [</world/ball>, </nowhere>]
        rel material:binding = </world/paint>
    }
    def Sphere "ball" { double radius = 2 }
    def Material "paint" {
        token outputs:mtlx:surface.connect = </world/paint/shader.outputs:out>
        def Shader "shader" {
            uniform token info:id = "ND_standard_surface_surfaceshader"
            color3f inputs:base_color = (1, 0, 0)
            token outputs:out
        }
    }
}
"""


def write(folder, name, text):
    path = pathlib.Path(folder) / name
    path.write_text(text, encoding="utf-8")
    return path


class Slots(unittest.TestCase):
    def test_names(self):
        self.assertEqual(mxgen.encode_slot("050::010"), "_050:_:_010")
        self.assertEqual(mxgen.decode_slot("_050:_:_010"), "050::010")
        for function in mxgen.encode_slot, mxgen.decode_slot:
            with self.assertRaises(ValueError):
                function("")
            with self.assertRaises(TypeError):
                function(5)


class Scenes(unittest.TestCase):
    def setUp(self):
        self.context = mxgen.Context()

    def test_paths(self):
        scene = self.context.scene("/set/table", "/set/chair/leg")
        self.assertEqual([primitive.path for primitive in scene], ["/set", "/set/table", "/set/chair", "/set/chair/leg"])
        self.assertEqual(len(scene), 4)
        leg = scene["/set/chair/leg"]
        self.assertEqual((leg.name, leg.type, leg.parent, list(leg.children)), ("leg", "", scene["/set/chair"], []))
        self.assertEqual([child.name for child in scene["/set"].children], ["table", "chair"])
        self.assertIsNone(scene["/set"].parent)
        self.assertIsNone(scene.find("/none"))
        self.assertEqual(len({leg, scene["/set/chair/leg"], scene["/set"]}), 2)
        self.assertEqual(repr(leg), "<Primitive '/set/chair/leg'>")
        self.assertEqual((dict(leg.properties), leg.property("x"), leg.numbers("x"), leg.words("x"), leg.targets("x")),
                         ({}, None, (), (), ()))
        self.assertEqual(scene.meters_per_unit, 0)
        scene.add("/set/lamp")
        self.assertEqual(len(scene), 5)
        with self.assertRaises(KeyError):
            scene["/none"]
        with self.assertRaises(mxgen.ArgumentError):
            mxgen.Primitive(scene, 5)

    def test_wrong_paths(self):
        scene = self.context.scene()
        with self.assertRaises(mxgen.DocumentError) as caught:
            scene.add("/a", "b c", "/d")
        self.assertIn("b c", str(caught.exception))
        self.assertEqual([primitive.path for primitive in scene], ["/a", "/d"])
        with self.assertRaises(mxgen.DocumentError):
            self.context.load_scene("/nonexistent/stage.txt")
        for call in (lambda: scene.add(5), lambda: scene.find(5), lambda: self.context.load_scene(5), lambda: scene["/a"].numbers(5),
                     lambda: self.context.load_scene("a", purpose=5), lambda: mxgen.Primitive(5, 0),
                     lambda: self.context.scene_materials(5)):
            with self.assertRaises(TypeError):
                call()

    def test_changes(self):
        scene, other = self.context.scene("/set"), self.context.scene("/set")
        table = mxgen.NewPrimitive("table", scene["/set"], "Mesh")
        made, foot, lamp = scene.add_each([table, mxgen.NewPrimitive("leg/foot", table), mxgen.NewPrimitive("lamp")])
        self.assertEqual([(primitive.path, primitive.type) for primitive in (made, foot, lamp)],
                         [("/set/table", "Mesh"), ("/set/table/leg/foot", ""), ("/lamp", "")])
        with self.assertRaises(mxgen.DocumentError):
            scene.add_each([mxgen.NewPrimitive("a"), mxgen.NewPrimitive("b//c")])
        self.assertIsNotNone(scene.find("/a"))
        for wrong, error in (5, TypeError), (mxgen.NewPrimitive(5), TypeError), (mxgen.NewPrimitive("b", 5), TypeError), \
                            (mxgen.NewPrimitive("b", other["/set"]), ValueError), (mxgen.NewPrimitive("b", mxgen.NewPrimitive("c")), ValueError):
            with self.assertRaises(error):
                scene.add_each([wrong])
        scene.bind(None, "000", "Gold")
        scene.bind("/lamp", "050", "")
        self.assertEqual(scene.bindings_of(lamp), (mxgen.SlotBinding("050", "", False, False, False, "", 0),))
        self.assertEqual([binding.material for binding in scene.bindings_of(None)], ["Gold"])
        with self.assertRaises(mxgen.DocumentError):
            scene.bind("/lamp", "a:b", "Gold")
        for wrong, error in (5, TypeError), (other["/set"], ValueError), ("/none", KeyError):
            with self.assertRaises(error):
                scene.unbind(wrong, "000")
        document = self.context.parse(common.GOLD)
        before = document.bind(scene)
        self.assertEqual(before.num_resolved, len(scene))
        scene.bind("/set/table", "050", "Gold")
        scene.unbind("/lamp", "050")
        self.assertIsNone(before.stack("/lamp"))
        after = document.bind(scene, previous=before)
        self.assertEqual(after.num_resolved, 3)
        formats = mxgen.BindingsFormat
        self.assertEqual(after.text(formats.JSON), document.bind(scene).text(formats.JSON))
        self.assertEqual([(layer.slot, layer.source) for layer in after.layers(foot)], [("000", None), ("050", made)])
        with self.assertRaises(mxgen.ArgumentError):
            document.bind(other, previous=before)
        length = len(scene)
        scene.remove("/set/table/leg", lamp)
        self.assertEqual(len(scene), length - 3)
        self.assertIsNone(scene.find("/lamp"))
        self.assertEqual([primitive.path for primitive in scene if primitive.path.startswith("/set/")], ["/set/table"])
        for gone, error in (foot, mxgen.ArgumentError), ("/lamp", KeyError), (5, TypeError):
            with self.assertRaises(error):
                scene.remove(gone)
        last = document.bind(scene, previous=after)
        self.assertEqual(last.num_resolved, 0)
        self.assertEqual(last.text(formats.JSON), document.bind(scene).text(formats.JSON))
        with self.assertRaises(TypeError):
            document.bind(scene, previous=5)

    def test_usd(self):
        with tempfile.TemporaryDirectory() as folder:
            file = write(folder, "stage.usda", STAGE)
            scene = self.context.load_scene(file)
            with self.assertRaises(mxgen.DocumentError) as caught:
                self.context.load_scene(write(folder, "broken.usda", STAGE[:200]))
        self.assertEqual(caught.exception.diagnostics[0].severity, mxgen.Severity.ERROR)
        self.assertEqual(str(scene.diagnostics), "")
        self.assertEqual((scene.up_axis, scene.meters_per_unit), ("Z", 0.5))
        box = scene["/world/box"]
        self.assertEqual(box.type, "Mesh")
        wear = box.properties["primvars:wear"]
        self.assertEqual((wear.type, wear.interpolation, wear.file, wear.line), ("float[]", "vertex", str(file), 5))
        self.assertEqual(wear, box.property("primvars:wear"))
        self.assertEqual(box.numbers("primvars:wear"), (0.25, 0.5))
        self.assertEqual(box.numbers("doubleSided"), (1,))
        self.assertEqual(box.words("subdivisionScheme"), ("none",))
        self.assertEqual(box.words("friends"), ("/world/ball", "/nowhere"))
        self.assertEqual(box.targets("friends"), (scene["/world/ball"], None))
        # The stage brings the material and its binding.
        paint = self.context.scene_materials(scene)
        self.assertEqual([renderable.type for renderable in paint.renderables], ["material"])
        both = self.context.parse(common.GOLD).with_materials(scene)
        self.assertEqual(len(both.renderables), 2)
        bindings = both.bind(scene)
        self.assertEqual([layer.source for layer in bindings.layers(box)], [box])
        self.assertIn("base_color", both.generate("glsl", bindings.stack(box)).pixel)
        with self.assertRaises(TypeError):
            both.with_materials(5)

    def test_text_of_usd(self):
        scene = self.context.parse_scene(STAGE, name="shot.usda")
        self.assertEqual(scene["/world/box"].property("primvars:wear").file, "shot.usda")
        with self.assertRaises(mxgen.DocumentError) as caught:
            self.context.parse_scene(STAGE[:200].encode())
        self.assertEqual(caught.exception.diagnostics[0].file, "<text>")
        with self.assertRaises(TypeError):
            self.context.parse_scene(5)

    def test_stage_of_openusd(self):
        stage = ComposedStage("anon:0x1:shot.usda", "")
        scene = mxgen.usd.scene(stage, context=self.context)
        self.assertEqual(scene["/world/box"].property("primvars:wear").file, "anon:0x1:shot.usda")
        saved = mxgen.usd.scene(ComposedStage("shot.usda", "/show/shot.usda"))
        self.assertEqual(saved["/world/box"].property("primvars:wear").file, "/show/shot.usda")
        full = """#usda 1.0
def Sphere "ball" { rel material:binding:full = </paint> }
def Material "paint" {}
"""
        for purpose, number in ("full", 1), ("preview", 0), (None, 0):
            scene = mxgen.usd.scene(ComposedStage("a", "", full), purpose=purpose)
            self.assertEqual(sum(binding.is_purpose for binding in scene.bindings_of("/ball")), number)


class ComposedStage:
    """Stands in for pxr.Usd.Stage: the three members that mxgen reads."""

    def __init__(self, identifier, real_path, text=STAGE):
        self.identifier, self.realPath, self.text = identifier, real_path, text

    def GetRootLayer(self):
        return self

    def ExportToString(self, addSourceFileComment=True):
        return ("# Composed\n" if addSourceFileComment else "") + self.text


class Bindings(unittest.TestCase):
    def setUp(self):
        self.context = mxgen.Context()
        self.document = self.context.load(common.EXAMPLES / "slots/looks.mtlx")
        self.scene = self.context.load_scene(common.EXAMPLES / "slots/receiver.usda")

    def test_layers(self):
        bindings = self.document.bind(self.scene, "finished")
        self.assertEqual(str(bindings.diagnostics), "")
        layers = bindings.layers("/receiver/keys")
        kinds = mxgen.LayerKind
        self.assertEqual([(layer.kind, layer.slot, layer.material) for layer in layers],
                         [(kinds.LAYER, "000", "generic"), (kinds.OVERRIDE, "000::010", "generic_pattern"),
                          (kinds.VERTICAL, "000|010", "varnish"), (kinds.LAYER, "050", "dirt"),
                          (kinds.OVERRIDE, "050::010", "dirt_pattern")])
        self.assertEqual([layer.source for layer in layers],
                         [self.scene["/receiver"], self.scene["/receiver"], self.scene["/receiver/keys"], None, self.scene["/receiver"]])
        self.assertEqual((layers[2].assign, layers[2].look, layers[2].is_nodegraph, layers[4].is_nodegraph),
                         ("varnish", "finished", False, True))
        self.assertEqual(layers[0].file, str(common.EXAMPLES / "slots/looks.mtlx"))
        # The decisions of the paper: no dirt on the front panel.
        self.assertEqual([layer.slot for layer in bindings.layers(self.scene["/receiver/case/front_panel"])],
                         ["000", "000::010", "000|010"])

    def test_solo_and_mute(self):
        for words, slots in (({"solo": ["050"]}, ["050", "050::010"]), ({"mute": ["050"]}, ["000", "000::010", "000|010"])):
            bindings = self.document.bind(self.scene, "finished", **words)
            self.assertEqual([layer.slot for layer in bindings.layers("/receiver/keys")], slots)

    def test_stacks(self):
        bindings = self.document.bind(self.scene, "finished")
        one, other = (bindings.stack(f"/receiver/knobs/{name}/cap") for name in ("tuning", "tone"))
        self.assertEqual((one.number, one.name), (other.number, other.name))
        self.assertRegex(one.name, "^stack_[0-9a-f]{16}$")
        self.assertEqual(len({stack.name for stack in bindings.stacks}), len(bindings.stacks))
        self.assertEqual(bindings.stacks[one.number].name, one.name)
        compared = 0
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([common.PROGRAM, common.EXAMPLES / "slots/looks.mtlx", "--look", "finished", "--stage",
                            common.EXAMPLES / "slots/receiver.usda", "-o", folder], check=True, stdout=subprocess.DEVNULL)
            written = json.loads((pathlib.Path(folder) / "bindings.json").read_text(encoding="utf-8"))
            self.assertEqual([stack["name"] for stack in written["stacks"]], [stack.name for stack in bindings.stacks])
            for stack in bindings.stacks:
                if stack.name in {program["name"] for program in written["programs"]}:
                    self.assertEqual(self.document.generate("glsl", stack).pixel,
                                     (pathlib.Path(folder) / f"{stack.name}.frag").read_text(encoding="utf-8"))
                    compared += 1
        self.assertEqual(compared, len(written["programs"]))

    def test_texts(self):
        bindings = self.document.bind(self.scene, "finished")
        table = subprocess.run([common.PROGRAM, "bind", common.EXAMPLES / "slots/looks.mtlx", "--look", "finished", "--stage",
                                common.EXAMPLES / "slots/receiver.usda"], check=True, stdout=subprocess.PIPE).stdout.decode()
        self.assertEqual(bindings.text(), table)
        found = json.loads(bindings.text(mxgen.BindingsFormat.JSON))
        self.assertEqual(len(found["stacks"]), len(bindings.stacks))
        self.assertIn("/receiver/keys", bindings.explain("/receiver/keys"))
        with self.assertRaises(mxgen.DocumentError):
            self.document.bind(self.scene, "no such look")

    def test_facts(self):
        text = """<materialx version="1.39">
          <surfacematerial name="M" type="material"/>
          <geominfo name="g" geom="/a"><token name="Asset" type="string" value="car"/></geominfo>
          <look name="L">
            <materialassign material="M" geom="/"/>
            <visibility geom="/a/b" vistype="camera" visible="false"/>
            <propertyassign property="matte" type="boolean" value="true" target="fast" geom="/"/>
          </look></materialx>"""
        scene = self.context.scene("/a/b", "/c")
        bindings = self.context.parse(text, name="facts.mtlx").bind(scene, "L")
        facts = {fact.kind: fact for fact in bindings.facts("/a/b")}
        self.assertEqual((facts[mxgen.FactKind.TOKEN].name, facts[mxgen.FactKind.TOKEN].value, facts[mxgen.FactKind.TOKEN].type), ("Asset", "car", "string"))
        self.assertEqual(facts[mxgen.FactKind.TOKEN].source, scene["/a"])
        self.assertEqual((facts[mxgen.FactKind.VISIBILITY].name, facts[mxgen.FactKind.VISIBILITY].value), ("camera", "false"))
        self.assertEqual((facts[mxgen.FactKind.PROPERTY].target, facts[mxgen.FactKind.PROPERTY].source), ("fast", None))
        self.assertEqual((facts[mxgen.FactKind.PROPERTY].file, facts[mxgen.FactKind.PROPERTY].line), ("facts.mtlx", 7))
        self.assertEqual([fact.kind for fact in bindings.facts("/c")], [mxgen.FactKind.PROPERTY])

    def test_lifetime(self):
        """Bindings keep their scene and their document, whatever Python ends first."""
        bindings = mxgen.Context().load(common.EXAMPLES / "slots/looks.mtlx").bind(mxgen.Context().scene("/receiver/keys"), "finished")
        gc.collect()
        self.assertEqual(bindings.layers("/receiver/keys")[0].material, "generic")
        stack = bindings.stack("/receiver/keys")
        other = self.context.load(common.EXAMPLES / "slots/looks.mtlx")
        with self.assertRaises(ValueError):
            other.generate("glsl", stack)
        with self.assertRaises(ValueError):
            bindings.layers(self.scene["/receiver/keys"])
        for call in (lambda: bindings.layers(5), lambda: bindings.stack(5), lambda: other.bind(5), lambda: bindings.explain(5),
                     lambda: other.bind(self.scene, 5), lambda: other.bind(self.scene, solo="050")):
            with self.assertRaises(TypeError):
                call()
