# SPDX-License-Identifier: Apache-2.0
"""Callbacks, wrong types, limits, lifetimes, threads."""
import copy
import gc
import os
import pickle
import threading
import unittest
import weakref

import common
import mxgen
from mxgen._calls import Handle

MAIN = '<materialx version="1.39"><xi:include href="lib/gold.mtlx" xmlns:xi="http://www.w3.org/2001/XInclude"/></materialx>'


class Resolvers(unittest.TestCase):
    def test_files(self):
        asked = []

        def resolve(origin, reference):
            asked.append((origin, reference))
            return {"main.mtlx": mxgen.File(MAIN, "db:main"), "lib/gold.mtlx": common.GOLD.encode()}.get(reference)

        document = mxgen.Context(resolver=resolve).load("main.mtlx")
        self.assertEqual(asked, [("", "main.mtlx"), ("db:main", "lib/gold.mtlx")])
        self.assertEqual(document.files, ("db:main", "lib/gold.mtlx"))
        self.assertIsNotNone(document.find("Gold"))
        with self.assertRaises(mxgen.DocumentError) as caught:
            mxgen.Context(resolver=resolve).load("other.mtlx")
        self.assertEqual(caught.exception.diagnostics[0].id, "file-missing")

    def test_exceptions(self):
        class Mine(Exception):
            pass

        def fail(*_arguments):
            raise Mine("from the callback")

        context = mxgen.Context(resolver=fail)
        for _ in range(2): # the context stays usable
            with self.assertRaisesRegex(Mine, "from the callback"):
                context.load("a.mtlx")
            with self.assertRaises(Mine):
                context.parse(MAIN)
            with self.assertRaises(Mine):
                context.rewrite(mxgen.Rewriting.FORMAT, "a.mtlx")
            self.assertEqual(context.parse(common.GOLD).renderables[0].path, "Gold")
        document = mxgen.Context(cancel=fail).parse(common.GOLD)
        with self.assertRaises(Mine):
            document.generate("glsl")
        with self.assertRaises(Mine):
            document.inspect(mxgen.View.IR)

    def test_first_exception_stops_further_callbacks(self):
        calls = []

        def resolve(_origin, reference):
            calls.append(reference)
            if reference != "main":
                raise KeyboardInterrupt
            return MAIN.replace("<materialx version=\"1.39\">", "<materialx version=\"1.39\">"
                                "<xi:include href='one.mtlx' xmlns:xi='http://www.w3.org/2001/XInclude'/>")

        with self.assertRaises(KeyboardInterrupt):
            mxgen.Context(resolver=resolve).load("main")
        self.assertEqual(calls, ["main", "one.mtlx"])

    def test_wrong_results(self):
        for wrong in 5, mxgen.File(5), mxgen.File("", 5), ["x"]:
            with self.assertRaises(TypeError):
                mxgen.Context(resolver=lambda _origin, _reference, wrong=wrong: wrong).load("a.mtlx")

    def test_own_context(self):
        context = mxgen.Context(resolver=lambda _origin, _reference: context.parse(common.GOLD).xml())
        with self.assertRaisesRegex(mxgen.Error, "its own context"):
            context.load("a.mtlx")

    def test_other_context(self):
        other = mxgen.Context()
        context = mxgen.Context(resolver=lambda _origin, _reference: other.parse(common.GOLD).xml())
        self.assertIsNotNone(context.load("a.mtlx").find("Gold"))

    def test_folders(self):
        text = (common.EXAMPLES / "tiles.mtlx").read_text(encoding="utf-8")
        start, end = text.index("<geominfo"), text.index("</geominfo>") + len("</geominfo>")
        asked = []

        def list_folder(origin, folder):
            asked.append((origin, folder))
            return [f"hull_paint.{tile}.exr" for tile in (1001, 1003)]

        context = mxgen.Context(resolver=lambda _origin, _reference: None, list_folder=list_folder)
        shader = context.parse(text[:start] + text[end:], name="tiles.mtlx").generate("glsl")
        paint = next(variable for variable in shader.variables if variable.num_tiles)
        self.assertEqual([(tile.u, tile.v) for tile in paint.tiles], [(0, 0), (2, 0)])
        self.assertTrue(asked)

        def fail(_origin, _folder):
            raise LookupError

        for wrong, error in ((fail, LookupError), (lambda _origin, _folder: "text", TypeError),
                             (lambda _origin, _folder: [1], TypeError)):
            context = mxgen.Context(resolver=lambda _origin, _reference: None, list_folder=wrong)
            with self.assertRaises(error):
                context.parse(text[:start] + text[end:], name="tiles.mtlx").generate("glsl")
        context = mxgen.Context(resolver=lambda _origin, _reference: None, list_folder=lambda _origin, _folder: None)
        context.parse(text[:start] + text[end:], name="tiles.mtlx").validate()

    def test_texels(self):
        text = '''<materialx version="1.39"><image name="i" type="color3"><input name="file" type="filename" value="paint.png"/></image>
            <slab name="a" type="BSDF"><input name="diffuse_albedo" type="color3" nodename="i"/></slab><slab name="b" type="BSDF"/>
            <slab_mix name="m" type="BSDF"><input name="fg" type="BSDF" nodename="a"/><input name="bg" type="BSDF" nodename="b"/>
            <input name="mix" type="float" value="0.5"/></slab_mix>
            <slab_surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="m"/></slab_surface></materialx>'''
        asked = []

        def draw(read_texels):
            mxgen.Context(read_texels=read_texels).parse(text).generate("glsl", element="S", options={"max-error": 5})

        def paint(_origin, file, layer, size):
            asked.append((file, layer))
            return [0.5] * (4 * size * size)

        def fail(_origin, _file, _layer, _size):
            raise LookupError

        draw(paint)
        self.assertEqual(asked, [("paint.png", "")])
        draw(lambda *_arguments: None)
        for wrong, error in ((fail, LookupError), (lambda *_arguments: [1.0, 2.0], ValueError), (lambda *_arguments: 5, TypeError)):
            with self.assertRaises(error):
                draw(wrong)

    def test_cancel(self):
        document = mxgen.Context(cancel=lambda: True).parse(common.GOLD)
        with self.assertRaises(mxgen.CancelledError):
            document.generate("glsl")
        self.assertIsNotNone(mxgen.Context(cancel=lambda: False).parse(common.GOLD).generate("glsl").pixel)


class Types(unittest.TestCase):
    def test_wrong_types(self):
        context = mxgen.Context()
        document = context.parse(common.GOLD)
        edit = context.edit()
        draft = edit.add("add", "a", "float")
        shader = document.generate("glsl")
        for number, call in enumerate((
                lambda: mxgen.Context(resolver=5), lambda: mxgen.Context(cancel="x"), lambda: mxgen.Context(max_memory="x"),
                lambda: mxgen.Context(warnings=5), lambda: mxgen.Context(include_roots="x"), lambda: mxgen.Context(include_roots=[5]),
                lambda: mxgen.Context(list_folder=5, resolver=print), lambda: context.load(5), lambda: context.parse(5),
                lambda: context.parse("", name=5), lambda: context.parse("", library=5), lambda: context.load_library(5),
                lambda: context.load_library("x", base=5), lambda: context.edit(5), lambda: context.edit(library=5),
                lambda: context.rewrite(mxgen.Rewriting.FORMAT, "a", 5), lambda: document.find(5), lambda: document[5],
                lambda: document.look_materials(None), lambda: document.generate(5), lambda: document.generate(None),
                lambda: document.generate("glsl", 5), lambda: document.generate("glsl", options=5),
                lambda: document.generate("glsl", options={"interface": 1j}), lambda: document.generate("glsl", options={5: "x"}),
                lambda: document.generate("glsl", options={"constant": [5]}), lambda: document.generate("glsl", options={"constant": b"x"}),
                lambda: document.generate("glsl", context=5), lambda: document.root.child(5), lambda: document.root.get(5),
                lambda: mxgen.Element(5, 1), lambda: mxgen.Element(document, "x"), lambda: shader.find_variable(5),
                lambda: shader.source_place(mxgen.Stage.PIXEL, "x"), lambda: context.library.nodedef(5),
                lambda: context.library.nodedefs_of(5), lambda: context.library.supports(5, "glsl"),
                lambda: context.library.supports(context.library.nodedefs[0], 5), lambda: edit.add(5), lambda: edit.add("a", 5),
                lambda: draft.value(5, 1, "float"), lambda: draft.value("in1", None, "float"), lambda: draft.value("in1", b"x", "float"),
                lambda: draft.value("in1", ["x"], "float"), lambda: draft.value("in1", None), lambda: draft.value("in1", 1, 5),
                lambda: draft.connect("in1", 5), lambda: draft.set(5, "x"),
                lambda: draft.set("x", 5), lambda: draft.rename(5), lambda: draft.move(5), lambda: draft.copy(draft),
                lambda: draft.child(5), lambda: edit.find(5), lambda: document.diagnostics["x"],
                lambda: context.parse(common.BROKEN).validate()[0].format(5),
                lambda: context.parse(common.BROKEN).validate()[0].format(line=5))):
            with self.assertRaises(TypeError, msg=f"call {number}"):
                call()

    def test_wrong_values(self):
        context = mxgen.Context()
        document = context.parse(common.GOLD)
        for call in (lambda: document.find("a\0b"), lambda: context.load("a\0b"), lambda: mxgen.Context(list_folder=print),
                     lambda: document.generate("glsl").source(7), lambda: document.inspect(99), lambda: context.rewrite(9, "x", ""),
                     lambda: context.load_library("x", base=context.library, standalone=True),
                     lambda: context.parse(common.BROKEN).validate()[0].format("", line="")):
            with self.assertRaises(ValueError):
                call()
        for call in lambda: mxgen.Context(max_errors=-1), lambda: mxgen.Context(max_nodes=1 << 40), lambda: mxgen.Element(document, -1):
            with self.assertRaises(OverflowError):
                call()

    def test_native_objects_are_not_copied(self):
        context = mxgen.Context()
        document = context.parse(common.GOLD)
        for thing in context, document, context.library, document.generate("glsl"), context.edit():
            for attempt in copy.copy, copy.deepcopy, pickle.dumps:
                with self.assertRaisesRegex(TypeError, "cannot be copied"):
                    attempt(thing)

    def test_errors_reach_another_process(self):
        text = "<materialx version='1.39'>\n<gold name='x' type='float'/></materialx>"
        found = mxgen.Context().parse(text, name="x.mtlx").validate()
        one = pickle.loads(pickle.dumps(found[0]))
        self.assertEqual((one, str(one)), (found[0], str(found[0])))
        self.assertEqual(one.format(colour=True), found[0].format(colour=True))
        with self.assertRaisesRegex(ValueError, "a copied diagnostic cannot show"):
            one.format(text)
        for original in mxgen.Context().parse, mxgen.Context().load:
            with self.assertRaises(mxgen.DocumentError) as caught:
                original("<")
            again = copy.deepcopy(pickle.loads(pickle.dumps(caught.exception)))
            self.assertIs(type(again), type(caught.exception))
            self.assertEqual(str(again), str(caught.exception))
            self.assertEqual(list(again.diagnostics), list(caught.exception.diagnostics))
            self.assertEqual(again.diagnostics.errors, 1)
            self.assertIsNone(again.document)

    def test_limits(self):
        with self.assertRaises(MemoryError):
            mxgen.Context(max_memory=20_000).parse(common.GOLD)
        with self.assertRaises(mxgen.DocumentError):
            mxgen.Context(max_elements=3).parse(common.GOLD)
        with self.assertRaises(mxgen.EditError):
            edit = mxgen.Context(max_elements=2).edit()
            for number in range(3):
                edit.add("noise2d", f"n{number}", "float")
        folder = common.EXAMPLES
        origin = os.path.join(folder, "marble.mtlx")
        sandbox = mxgen.Context(sandbox=True)
        self.assertIsNone(sandbox.file_fault(origin, origin))
        self.assertIn("outside", sandbox.file_fault(origin, os.path.join(folder, "..", "README.md")))
        self.assertIn("regular", mxgen.Context().file_fault(origin, "/dev/null"))
        with self.assertRaises(mxgen.DocumentError):
            mxgen.Context(sandbox=True, include_roots=[folder]).parse(MAIN, name="elsewhere/main.mtlx")


class Lifetimes(unittest.TestCase):
    def test_objects_outlive_the_names_of_their_parents(self):
        variable = mxgen.Context().parse(common.GOLD).generate("glsl").variables[0]
        gc.collect()
        self.assertEqual(variable.tiles, ())
        element = mxgen.Context().parse(common.GOLD)["SR/base_color"]
        port = mxgen.Context().library.nodedef("ND_mix_color3")
        diagnostics = mxgen.Context().parse(common.BROKEN).validate()
        draft = mxgen.Context().edit().add("noise2d", "n", "float")
        gc.collect()
        self.assertEqual(element.value, element.document["SR/base_color"].value)
        self.assertEqual(port.inputs[0].name, "fg")
        self.assertIn("red", str(diagnostics))
        self.assertEqual(draft.set("xpos", "1").edit.end()["n"].get("xpos"), "1")
        self.assertIsNotNone(mxgen.Context().parse(common.GOLD).edit().end().find("Gold"))

    def test_cycles(self):
        def make():
            held = []
            context = mxgen.Context(resolver=lambda _origin, _reference: held and None or common.GOLD)
            document = context.load("a.mtlx")
            held.extend([context, document, document.generate("glsl"), context.edit(document), document.generate("glsl", context=mxgen.Context())])
            return weakref.ref(context), weakref.ref(document)

        references = [reference for _ in range(10) for reference in make()]
        gc.collect()
        self.assertEqual([reference() for reference in references], [None] * len(references))

    def test_children_end_first(self):
        ended = []
        parent = Handle("parent", ended.append)
        child, other = (Handle(name, ended.append, (parent,)) for name in ("child", "other"))
        parent.release()
        child.release()
        self.assertEqual(ended, ["child"])
        other.release()
        self.assertEqual(ended, ["child", "other", "parent"])

    def test_result_of_another_context(self):
        document = mxgen.Context().parse(common.GOLD)
        expected = document.generate("glsl").pixel
        shader = document.generate("glsl", options={"interface": "complete"}, context=mxgen.Context())
        found = document.validate(context=mxgen.Context())
        del document
        gc.collect()
        self.assertEqual((shader.pixel, found.errors), (expected, 0))

    def test_nothing_leaks(self):
        """The limit of a context counts all its objects: a few rounds fit in, all rounds do not."""
        context = mxgen.Context(max_memory=8_000_000)

        def make():
            document = context.parse(common.GOLD)
            context.parse(common.BROKEN).validate()
            document.edit().add("noise2d", "n", "float")
            return document.edit().end().generate("glsl", options={"interface": "reduced"}), document.xml(), context.format(common.GOLD)

        with self.assertRaises(MemoryError):
            held = [make() for _ in range(300)]
        held = None
        self.assertIsNone(held)
        for _ in range(300):
            make()

    def test_threads(self):
        document = mxgen.Context().parse(common.GOLD)
        expected = document.generate("glsl").pixel
        found = []

        def generate(context):
            for _ in range(5):
                found.append(document.generate("glsl", context=context).pixel)

        threads = [threading.Thread(target=generate, args=(context,)) for context in (None, None, mxgen.Context(), mxgen.Context())]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [expected] * 20)
