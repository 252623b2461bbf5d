# SPDX-License-Identifier: Apache-2.0
"""Shaders, libraries, catalogues, diagnostics."""
import json
import pathlib
import re
import struct
import subprocess
import tempfile
import unittest
from dataclasses import fields

import common
import mxgen
from mxgen import _native
from mxgen._calls import lib


class Shaders(unittest.TestCase):
    def setUp(self):
        self.context = mxgen.Context()

    def test_same_bytes_as_the_program(self):
        count = 0
        for path in sorted(common.EXAMPLES.glob("*.mtlx")):
            document = self.context.load(path)
            for target in mxgen.targets():
                with tempfile.TemporaryDirectory() as folder:
                    run = subprocess.run([common.PROGRAM, path, "--target", target.name, "-o", folder], capture_output=True, check=False)
                    written = {file.name: file.read_text(encoding="utf-8") for file in pathlib.Path(folder).iterdir()}
                made = {}
                for renderable in document.renderables:
                    try:
                        shader = document.generate(target.name, renderable.path)
                    except mxgen.DocumentError:
                        self.assertEqual(run.returncode, 1, path)
                        continue
                    for stage in mxgen.Stage:
                        source = shader.source(stage)
                        if source is not None:
                            made[source] = True
                self.assertEqual(sorted(made), sorted(written.values()), f"{path.name} {target.name}")
                count += len(made)
        self.assertGreater(count, 100)

    def test_reflection(self):
        shader = self.context.load(common.EXAMPLES / "marble.mtlx").generate("vulkan")
        stone = shader.find_variable("NG_marble/stone")
        self.assertEqual((stone.document_type, stone.block, stone.uiname), ("color3", mxgen.Block.PUBLIC_UNIFORMS, "Stone"))
        self.assertEqual([round(value, 6) for value in stone.values], [0.8, 0.78, 0.75])
        self.assertIn(stone, shader.variables)
        self.assertIsNone(shader.find_variable("NG_marble/none"))
        self.assertIn(stone.name, shader.pixel)
        self.assertIn("void main", shader.vertex)
        self.assertEqual((shader.info.name, shader.info.target), ("Marble", "vulkan"))
        self.assertEqual(shader.reflection(), json.loads(shader.reflection_json))
        self.assertEqual(len(shader.closure_paths), shader.info.num_closures)
        self.assertTrue(all(path.startswith("SR_marble") for path in shader.closure_paths), shader.closure_paths)

    def test_places(self):
        shader = self.context.load(common.EXAMPLES / "marble.mtlx").generate("glsl")
        stage = mxgen.Stage.PIXEL
        lines = range(1, len(shader.pixel.splitlines()) + 1)
        places = [place for line in lines if (place := shader.source_place(stage, line))]
        self.assertIn("NG_marble/scaled", {place.path for place in places})
        self.assertTrue(all(place.file.endswith("marble.mtlx") and place.line > 1 for place in places))
        self.assertTrue({shader.source_path(stage, line) for line in lines} - {None})
        self.assertIsNone(shader.source_place(stage, 0))

    def test_textures(self):
        shader = self.context.load(common.EXAMPLES / "tiles.mtlx").generate("glsl")
        textures = {variable.path: variable for variable in shader.variables if variable.block == mxgen.Block.TEXTURES}
        paint = next(variable for path, variable in textures.items() if "paint" in path)
        foam = next(variable for path, variable in textures.items() if "foam" in path)
        self.assertEqual([(tile.u, tile.v) for tile in paint.tiles], [(0, 0), (1, 0), (0, 1), (1, 1)])
        self.assertTrue(paint.texture_file(tile=2).endswith("hull_paint.1011.exr"))
        self.assertEqual(paint.texture_file(tile=2), paint.tiles[2].file)
        self.assertEqual(paint.origin, str(common.EXAMPLES / "tiles.mtlx"))
        self.assertRegex(repr(paint), r"^Variable\(name='[a-z_]+', block=<Block.TEXTURES: 3>, .*file='[^']+'")
        self.assertNotIn("''", repr(paint)) # what is not set is left out
        self.assertTrue(foam.texture_file(frame=49).endswith("foam.0001.exr"))
        for wrong, error in ("1", TypeError), (1.5, TypeError), (1 << 31, OverflowError), (-(1 << 31) - 1, OverflowError):
            with self.assertRaisesRegex(error, "frame"):
                foam.texture_file(frame=wrong)

    def test_options(self):
        document = self.context.load(common.EXAMPLES / "marble.mtlx")
        complete, reduced = document.generate("glsl"), document.generate("glsl", options={"interface": "reduced"})
        self.assertLess(len(reduced.pixel), len(complete.pixel))
        self.assertIn("NG_marble/stone", [compiled.path for compiled in reduced.compiled_inputs])
        kept = document.generate("glsl", options={"interface": "reduced", "uniform": ["NG_marble/stone", "NG_marble/vein"], "max-lights": 2})
        self.assertIsNotNone(kept.find_variable("NG_marble/vein"))
        self.assertIn("u_lightData[2]", kept.pixel)
        for options in {"none": 1}, {"interface": "some"}, {"max-lights": -1}, {"max-lights": True}:
            with self.assertRaises(mxgen.ArgumentError) as caught:
                document.generate("glsl", options=options)
            self.assertIn(next(iter(options)), str(caught.exception))

    def test_host_functions(self):
        document = self.context.load(common.EXAMPLES / "gold.mtlx")
        shader = document.generate("vulkan", options={"host-lights": True, "host-environment": True})
        self.assertEqual(shader.host_functions, ("mxg_light_count", "mxg_light", "mxg_irradiance", "mxg_radiance"))
        self.assertEqual(document.generate("vulkan").host_functions, ())

    def test_device_feature(self):
        document = self.context.load(common.EXAMPLES / "gold.mtlx")
        self.assertEqual(document.generate("wgsl", options={"precision": "mediump"}).info.device_features, "shader-f16")
        self.assertEqual(document.generate("wgsl").info.device_features, "")

    def test_parts(self):
        shader = self.context.load(common.EXAMPLES / "car_paint.mtlx").generate("osl", options={"osl-network": True})
        self.assertGreater(len(shader.parts), 2)
        self.assertTrue(all("shader " in part.source and part.name for part in shader.parts))

    def test_cheaper_calls(self):
        document = self.context.load(common.EXAMPLES / "gold.mtlx")
        without = document.generate("glsl", without_source=True)
        self.assertIsNone(without.pixel)
        self.assertEqual(without.info.topology, document.generate("glsl", document["Gold"]).info.topology)
        bare = document.generate("glsl", only_diagnostics=True)
        self.assertEqual((bare.pixel, bare.variables, bare.diagnostics.errors), (None, (), 0))
        with self.assertRaises(mxgen.ArgumentError):
            bare.info
        with self.assertRaises(mxgen.Error):
            bare.reflection_json

    def test_states_and_changes(self):
        document = self.context.load(common.EXAMPLES / "marble.mtlx")
        shader, reduced = document.generate("vulkan"), document.generate("vulkan", options={"interface": "reduced"})
        self.assertEqual(shader.input_state("NG_marble/stone"), mxgen.InputState.UNIFORM)
        self.assertEqual(reduced.input_state("NG_marble/stone"), mxgen.InputState.COMPILED)
        self.assertEqual(shader.input_state("none"), mxgen.InputState.UNKNOWN)
        with document.edit() as edit:
            edit["NG_marble/stone"].set("value", "1, 0, 0")
        after = edit.document.generate("vulkan")
        change, variables = shader.change(after)
        self.assertEqual((change, [variable.path for variable in variables]), (mxgen.Change.VALUES, ["NG_marble/stone"]))
        self.assertEqual(variables[0].values, (1, 0, 0))
        self.assertEqual(shader.change(shader), (mxgen.Change.NOTHING, ()))
        self.assertEqual(shader.change(reduced)[0], mxgen.Change.SHADER)
        with self.assertRaises(TypeError):
            shader.change(5)

    def test_buffers(self):
        shader = self.context.load(common.EXAMPLES / "marble.mtlx").generate("vulkan")
        block = shader.block(mxgen.Block.PUBLIC_UNIFORMS)
        stone = shader.find_variable("NG_marble/stone")
        data = shader.pack(mxgen.Block.PUBLIC_UNIFORMS)
        self.assertEqual(len(data), block.byte_size)
        self.assertEqual(struct.unpack_from("<3f", data, stone.offset), stone.values[:3])
        shader.pack_value(data, stone, (1, 0.5, 0.25))
        self.assertEqual(struct.unpack_from("<3f", data, stone.offset), (1, 0.5, 0.25))
        scale = shader.find_variable("NG_marble/scale")
        shader.pack_value(data, scale, 5)
        self.assertEqual(struct.unpack_from("<f", data, scale.offset), (5,))
        for wrong, error in (((1, 2), mxgen.ArgumentError), (1, mxgen.ArgumentError), (("x",), TypeError), (None, TypeError)):
            with self.assertRaises(error):
                shader.pack_value(data, stone, wrong)
        counted = self.context.parse("<materialx version='1.39'><nodegraph name='G'><input name='n' type='integer' value='3'/><convert name='c' type='float'>"
                                     "<input name='in' type='integer' interfacename='n'/></convert><output name='out' type='float' nodename='c'/>"
                                     "</nodegraph></materialx>").generate("vulkan")
        number, integers = counted.find_variable("G/n"), counted.pack(mxgen.Block.PUBLIC_UNIFORMS)
        counted.pack_value(integers, number, 7)
        self.assertEqual(struct.unpack_from("<i", integers, number.offset), (7,))
        for inexact in 1.5, 16777218, float("nan"):
            with self.assertRaises(mxgen.ArgumentError):
                counted.pack_value(integers, number, inexact)
        with self.assertRaises(mxgen.ArgumentError):
            shader.pack_value(bytearray(4), stone, (1, 1, 1))
        with self.assertRaises(TypeError):
            shader.pack_value(data, 5, (1, 1, 1))
        with self.assertRaises((TypeError, BufferError)):
            shader.pack_value(bytes(data), stone, (1, 1, 1))
        self.assertEqual(shader.pack(mxgen.Block.TEXTURES), b"")

    def test_values_of_another_document(self):
        document = self.context.load(common.EXAMPLES / "marble.mtlx")
        shader = document.generate("vulkan")
        stone = shader.find_variable("NG_marble/stone")
        with document.edit() as edit:
            edit["NG_marble"].value("stone", (0.25, 0.5, 1), "color3")
        data = shader.pack_from(edit.document, mxgen.Block.PUBLIC_UNIFORMS)
        self.assertEqual(struct.unpack_from("<3f", data, stone.offset), (0.25, 0.5, 1))
        self.assertEqual(shader.pack_from(document, mxgen.Block.PUBLIC_UNIFORMS), shader.pack(mxgen.Block.PUBLIC_UNIFORMS))
        self.assertEqual(shader.pack_from(document, mxgen.Block.TEXTURES), b"")
        with self.assertRaises(ValueError):
            shader.pack_from(self.context.load(common.EXAMPLES / "gold.mtlx"), mxgen.Block.PUBLIC_UNIFORMS)
        other = mxgen.Context().load(common.EXAMPLES / "marble.mtlx")
        with self.assertRaises(mxgen.ArgumentError):
            shader.pack_from(other, mxgen.Block.PRIVATE_UNIFORMS)

    def test_lights(self):
        shader = self.context.load(common.EXAMPLES / "gold.mtlx").generate("glsl")
        lights = {light.type: light for light in shader.light_types}
        self.assertEqual(sorted(lights), [1, 2, 3])
        self.assertIn("point", lights[2].name)
        self.assertTrue(all(member is None or member.block == mxgen.Block.LIGHT_DATA for light in lights.values() for member in light.members))
        self.assertTrue(any(light.members for light in lights.values()))
        self.assertIn("worldMatrix", {semantic.semantic for semantic in mxgen.semantics()})

    def test_files(self):
        shader = self.context.load(common.EXAMPLES / "lamp.mtlx").generate("glsl")
        self.assertEqual([pathlib.Path(file).name for file in shader.files], ["lamp.ies"])

    def test_errors(self):
        document = self.context.parse(common.GOLD)
        for target, element in (("cobol", None), ("glsl", "none")):
            with self.assertRaises(mxgen.DocumentError) as caught:
                document.generate(target, element)
            self.assertGreater(caught.exception.diagnostics.errors, 0)
            self.assertIn("error", str(caught.exception))
        with self.assertRaises(ValueError):
            document.generate("glsl", self.context.parse(common.GOLD)["Gold"])

    def test_inspect(self):
        document = self.context.load(common.EXAMPLES / "marble.mtlx")
        for view, text in ((mxgen.View.ELEMENTS, "NG_marble"), (mxgen.View.GRAPH, "noise"), (mxgen.View.DOT, "digraph"),
                           (mxgen.View.CLOSURES, "bsdf"), (mxgen.View.IR, "="), (mxgen.View.STATISTICS, "closures  "),
                           (mxgen.View.SLABS, "a body, as slabs"), (mxgen.View.SLABS_JSON, '"recognised": true')):
            self.assertIn(text, document.inspect(view, "Marble", target="glsl"), view)
        with self.assertRaises(mxgen.DocumentError):
            document.inspect(mxgen.View.IR, "none")


class Libraries(unittest.TestCase):
    def setUp(self):
        self.context = mxgen.Context()

    def test_definitions(self):
        library = self.context.library
        self.assertIs(library, self.context.library)
        mix = library.nodedef("ND_mix_color3")
        self.assertEqual((mix.node, [port.name for port in mix.inputs], [port.type for port in mix.outputs]),
                         ("mix", ["fg", "bg", "mix"], ["color3"]))
        self.assertEqual((mix.input("mix").type, mix.input("none")), ("float", None))
        self.assertIn(mix, library.nodedefs_of("mix"))
        self.assertTrue(library.supports(mix, "glsl"))
        self.assertEqual([(part.target, part.nodegraph, bool(part.sourcecode)) for part in mix.implementations], [("", "", True)])
        surface = library.nodedef("ND_standard_surface_surfaceshader").implementations[0]
        self.assertEqual((surface.target, surface.nodegraph), ("", "NG_standard_surface"))
        self.assertFalse(library.supports(mix, "cobol"))
        self.assertIsNone(library.nodedef("ND_none"))
        self.assertEqual(library.nodedefs_of("none"), ())
        self.assertGreater(len(library.nodedefs), 800)
        self.assertEqual((library.files, len(library.diagnostics)), ((), 0))
        with self.assertRaises(ValueError):
            mxgen.Context().library.supports(mix, "glsl")

    def test_own_library(self):
        text = """<materialx version="1.39"><nodedef name="ND_twice" node="twice"><input name="in" type="float" value="1"/>
            <output name="out" type="float"/></nodedef><nodegraph name="NG_twice" nodedef="ND_twice"><add name="sum" type="float">
            <input name="in1" type="float" interfacename="in"/><input name="in2" type="float" interfacename="in"/></add>
            <output name="out" type="float" nodename="sum"/></nodegraph></materialx>"""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "twice.mtlx"
            path.write_text(text, encoding="utf-8")
            library = self.context.load_library(path)
            self.assertEqual(library.files, (str(path),))
            self.assertEqual(library.nodedef("ND_twice").input("in").value, "1")
            document = self.context.parse('<materialx version="1.39"><twice name="t" type="float"/></materialx>', library=library)
            self.assertEqual(document["t"].definition.name, "ND_twice")
            path.write_text(text[:text.index("<nodegraph")] + "</materialx>", encoding="utf-8")
            alone = self.context.load_library(path, standalone=True)
            self.assertIn("ND_twice", alone.expand())
            self.assertEqual(len(alone.losses), 0)
            self.assertEqual(len(alone.nodedefs), 1)
            image = pathlib.Path(folder) / "twice.mxlib"
            image.write_bytes(alone.image())
            self.assertEqual(self.context.load_library(image, standalone=True).nodedefs[0].name, "ND_twice")
            with self.assertRaisesRegex(mxgen.ArgumentError, "standalone"):
                library.image()
            path.write_text("<materialx", encoding="utf-8")
            with self.assertRaises(mxgen.DocumentError):
                self.context.load_library(path, base=self.context.library)


class Passes(unittest.TestCase):
    def test_passes(self):
        context = mxgen.Context()
        passes = context.passes("vulkan", options={"max-lights": 1})
        self.assertEqual(list(passes), ["over", "classify", "compose", "light_simple", "light_single", "light_complex", "light_special", "show",
                                        "light_rays", "read"])
        self.assertIn("diffuse", context.passes("vulkan", options={"sss": "diffusion"}))
        self.assertIn("u_lightData[1]", passes["light_simple"].pixel)
        document = context.load(common.EXAMPLES / "deferred.mtlx")
        stored = document.generate("vulkan", "Lacquered", options={"role": "deferred", "interface": "reduced"})
        self.assertEqual(stored.storage.words, 10)
        lit = passes["light_complex"].storage.classes
        self.assertEqual(stored.storage.classes & lit, lit)
        self.assertEqual(stored.storage.classes & passes["light_special"].storage.classes, 0)
        self.assertEqual(stored.storage.layout, passes["show"].storage.layout)
        self.assertEqual(document.generate("vulkan", "Plain").storage.words, 0)
        self.assertEqual([(one.name, one.kind) for one in mxgen.pass_resources()][:2], [("words", "image2DArray"), ("word0", "image2D")])
        with self.assertRaises(mxgen.DocumentError):
            context.passes("osl")

    def test_module(self):
        context = mxgen.Context()
        module = context.module("mdl", options={"mdl-module": "studio"})
        self.assertTrue(module.pixel.startswith("mdl 1.8;\n\n// studio · module"))
        marble = context.load(common.EXAMPLES / "marble.mtlx").generate("mdl", options={"mdl-module": "studio"})
        self.assertIn("import ::studio::*;", marble.pixel)
        self.assertIn("export float mx_fractal_float_vec3(", module.pixel)
        with self.assertRaisesRegex(mxgen.DocumentError, "only mdl can have modules"):
            context.module("glsl", options={"mdl-module": "studio"})
        with self.assertRaisesRegex(mxgen.DocumentError, "the name of the module"):
            context.module("mdl", options={})

    def test_reflection(self):
        """The JSON of a pass and the library say the same."""
        resources = mxgen.pass_resources()
        for name, shader in mxgen.Context().passes("vulkan", options={"sss": "diffusion", "rough-refraction": "blur"}).items():
            info, described = shader.pass_info, json.loads(shader.reflection_json)["deferred"]
            self.assertEqual((info.name, list(info.group_size)), (name, described.get("groupSize", [0, 0, 0])))
            self.assertEqual(info.dispatch_offset if info.is_indirect else None, described.get("dispatchOffset"))
            used = {item["binding"]: item for item in described["resources"]}
            self.assertEqual(info.reads | info.writes, sum(1 << binding for binding in used))
            for binding, item in used.items():
                one, access = resources[binding], (info.reads >> binding & 1, info.writes >> binding & 1)
                self.assertEqual(item["access"], {(1, 0): "read", (0, 1): "write", (1, 1): "read-write"}[access])
                self.assertEqual((one.name, one.kind, one.format, one.num_layers, one.byte_size),
                                 (item["name"], item["kind"], item.get("format", ""), item.get("layers", 0), item.get("size", 0)))
                flat = [part for member in item.get("members", []) for part in (member, *member.get("members", []))]
                self.assertEqual([(member.name, member.type, member.offset, member.array_stride, member.per, member.values) for member in one.members],
                                 [(part["name"], part["type"], part["offset"], part.get("arrayStride", 0), part.get("per", ""), part.get("values", ""))
                                  for part in flat])
        self.assertTrue(resources[-1].name and next(one for one in resources if one.name == "rays").members[1].is_nested)
        self.assertIsNone(mxgen.Context().load(common.EXAMPLES / "deferred.mtlx").generate("vulkan", "Plain").pass_info)


class Catalogues(unittest.TestCase):
    def test_lists(self):
        self.assertIn("glsl", [target.name for target in mxgen.targets()])
        self.assertTrue(mxgen.option_applies("lights", "glsl"))
        self.assertFalse(mxgen.option_applies("lights", "osl"))
        for wrong in (("light", "glsl"), ("lights", "gls")):
            with self.assertRaises(ValueError):
                mxgen.option_applies(*wrong)
        interface = next(option for option in mxgen.options() if option.key == "interface")
        self.assertEqual((interface.type, interface.values, interface.initial),
                         (mxgen.OptionType.ENUM, "complete|authored|reduced", "complete"))
        kinds = {kind.id: kind for kind in mxgen.diagnostic_kinds()}
        self.assertEqual(kinds["file-missing"].severity, mxgen.Severity.ERROR)
        self.assertEqual(mxgen.library_version(), mxgen.__version__)

    def test_color_difference(self) -> None:
        grey, lighter = (0.2, 0.2, 0.2), (0.21, 0.21, 0.21)
        self.assertEqual(mxgen.color_difference(grey, grey), 0)
        self.assertAlmostEqual(mxgen.color_difference((0, 0, 0), (1, 1, 1)), 100, delta=0.01)
        self.assertTrue(0.5 < mxgen.color_difference(grey, lighter) < 2)
        with self.assertRaises(ValueError):
            mxgen.color_difference(grey, (1.0, 1.0))

    def test_records_have_every_member(self):
        omitted = {"mxg_part": {"source_size"}, "mxg_light_type": {"num_members"}, "mxg_diagnostic": {"num_arguments"}}
        for cls, ctype in ((mxgen.Target, "mxg_target"), (mxgen.Option, "mxg_option"), (mxgen.DiagnosticKind, "mxg_diagnostic_kind"),
                           (mxgen.Diagnostic, "mxg_diagnostic"), (mxgen.Port, "mxg_port"), (mxgen.NodeDef, "mxg_nodedef"),
                           (mxgen.Variable, "mxg_variable"), (mxgen.Tile, "mxg_tile"), (mxgen.Part, "mxg_part"),
                           (mxgen.CompiledInput, "mxg_compiled_input"), (mxgen.ShaderInfo, "mxg_shader_info"), (mxgen.Storage, "mxg_storage"),
                           (mxgen.Renderable, "mxg_renderable"),
                           (mxgen.Semantic, "mxg_semantic"), (mxgen.BlockInfo, "mxg_block_info"), (mxgen.LightType, "mxg_light_type"), (mxgen.Connection, "mxg_connection")):
            native = {name for name, _ in getattr(_native, ctype)._fields_} - {"size"} - omitted.get(ctype, set())
            self.assertEqual({field.name for field in fields(cls) if not field.name.startswith("_")} - {"members", "arguments"}, native, ctype)

    def test_layout_is_that_of_c(self):
        root, count = common.EXAMPLES.resolve().parent, 0
        for line in (root / "tests/abi/abi.txt").read_text(encoding="utf-8").splitlines():
            match = re.match(r"struct (mxg_\w+)(?:: .*?(\w+)(?:\)\(.*\)|\[\d+\])?)? = (\d+)$", line)
            struct_type = getattr(_native, match[1], None) if match else None
            if struct_type:
                found = getattr(struct_type, match[2]).offset if match[2] else _native.sizeof(struct_type)
                self.assertEqual(found, int(match[3]), line)
                count += 1
        self.assertGreater(count, 250)

    def test_enumerations_have_every_member(self):
        for cls, ctype in ((mxgen.Severity, "mxg_severity"), (mxgen.Stage, "mxg_stage"), (mxgen.Block, "mxg_block"),
                           (mxgen.Alpha, "mxg_alpha"), (mxgen.View, "mxg_view"), (mxgen.OptionType, "mxg_option_type"),
                           (mxgen.Rewriting, "mxg_rewriting"), (mxgen.InputState, "mxg_input_state"), (mxgen.Change, "mxg_change")):
            names = [name for name in _native.ENUMS[ctype] if not re.search(r"_MAX_ENUM$|^MXG_NUM_", name)]
            self.assertEqual(sorted(int(member) for member in cls), sorted(getattr(lib, name) for name in names), ctype)
            for member in cls:
                self.assertTrue(any(name.endswith(member.name) and getattr(lib, name) == member for name in names), member)


class DiagnosticObjects(unittest.TestCase):
    def test_objects(self):
        document = mxgen.Context().parse(common.BROKEN, name="broken.mtlx")
        found = document.validate()
        self.assertEqual((found.errors, found.warnings, len(found)), (1, 0, len(found)))
        first = found[0]
        self.assertEqual((first.severity, first.file, first.line), (mxgen.Severity.ERROR, "broken.mtlx", 4))
        self.assertTrue(str(first).startswith("broken.mtlx:4:"))
        kind = next(kind for kind in mxgen.diagnostic_kinds() if kind.id == first.id)
        self.assertEqual(kind.message.replace("%u", "%s") % first.arguments, first.message)
        self.assertIsNone(mxgen.diagnostic._line_of(common.BROKEN, 10000))
        self.assertEqual(first.format("no such line"), first.format())
        line = common.BROKEN.splitlines()[3]
        self.assertEqual(first.format(common.BROKEN), first.format(line=line))
        self.assertIn("^", first.format(line=line))
        self.assertIn("\x1b[", first.format(colour=True))
        self.assertIn(str(first), str(found))
        self.assertEqual(found.format(common.BROKEN)[:20], first.format(common.BROKEN)[:20])
        self.assertEqual(repr(found), "<Diagnostics: 1 errors, 0 warnings>")
        self.assertEqual(found[-1], found[len(found) - 1])
        with self.assertRaises(IndexError):
            found[len(found)]

    def test_notes(self):
        text = common.GOLD.replace("</materialx>", '<noise2d name="Spots" type="float" /></materialx>')
        first = mxgen.Context().parse(text).diagnostics[0]
        notes = first.notes
        self.assertTrue(notes and all(note.severity == mxgen.Severity.NOTE for note in notes))

    def test_warnings(self):
        with self.assertRaisesRegex(mxgen.ArgumentError, "the unknown word 'no-such-word'"):
            mxgen.Context(warnings="error,no-such-word,no-unused-node")
        text = '<materialx version="1.39"><noise2d name="n" type="float" typo="1"/></materialx>'
        self.assertEqual(mxgen.Context().parse(text).validate().errors, 0)
        strict = mxgen.Context(warnings="error")
        self.assertGreater(strict.parse(text).validate().errors, 0)
