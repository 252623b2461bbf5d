// SPDX-License-Identifier: Apache-2.0
// The tests of the npm package. Arguments: the folder with the package, the root of the project, the program; then optionally Python and a
// folder with the Python package.

import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { inspect } from "node:util";

import { run, test } from "./harness.mjs";

const [folder, root, program, python, pythonPackage] = process.argv.slice(2);
const js = await import(pathToFileURL(path.join(folder, "node.js")));
const { load, DocumentError, ArgumentError, EditError, MxgenError, OutOfMemoryError, CancelledError } = js;
const examples = path.join(root, "examples");
const bytes = fs.readFileSync(path.join(folder, "mxgen.wasm"));
const mxgen = await load();

const GOLD = `<?xml version="1.0"?>
<materialx version="1.39">
  <standard_surface name="SR" type="surfaceshader">
    <input name="base_color" type="color3" value="0.9, 0.6, 0.2" />
    <input name="metalness" type="float" value="1" />
    <input name="specular_roughness" type="float" nodename="Spots" />
  </standard_surface>
  <noise2d name="Spots" type="float" />
  <surfacematerial name="Gold" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SR" />
  </surfacematerial>
</materialx>
`;

function inFolder(work) {
    const made = fs.mkdtempSync(path.join(os.tmpdir(), "mxgen-js-"));
    try {
        return work(made);
    } finally {
        fs.rmSync(made, { recursive: true });
    }
}

// ---- The same bytes everywhere ----

/** All sources of a document for a target, by renderable and stage; null for one with errors. */
function sourcesByJs(file, target) {
    const document = loadAll(mxgen.createContext(), file), sources = {};
    for (const { path: element } of document.renderables) {
        try {
            const shader = document.generate(target, { element });
            sources[element] = [shader.vertex, shader.pixel, shader.reflectionJson];
        } catch (error) {
            assert(error instanceof DocumentError, String(error));
            sources[element] = null;
        }
    }
    return sources;
}

const documents = [examples, path.join(root, "tests/golden")].flatMap(
    from => fs.readdirSync(from).filter(name => name.endsWith(".mtlx")).map(name => path.join(from, name)));

function loadAll(context, file) {
    try {
        return context.load(file);
    } catch (error) {
        assert(error instanceof DocumentError, String(error));
        return error.document;
    }
}

test("the same bytes as the program", () => {
    let compared = 0;
    for (const file of documents)
        for (const target of mxgen.targets) {
            const made = Object.values(sourcesByJs(file, target.name)).filter(Boolean).flatMap(sources => sources.slice(0, 2)).filter(Boolean);
            const written = inFolder(out => {
                spawnSync(program, [file, "--target", target.name, "-o", out]);
                return fs.readdirSync(out).map(name => fs.readFileSync(path.join(out, name), "utf8"));
            });
            assert.deepEqual(new Set(made), new Set(written), `${file} ${target.name}`);
            compared += written.length;
        }
    assert(compared > 500, `${compared} files`);
});

const BY_PYTHON = `
import json, sys, mxgen
found = {}
for target in mxgen.targets():
    for path in sys.argv[1:]:
        try:
            document = mxgen.Context().load(path)
        except mxgen.DocumentError as error:
            document = error.document
        for item in document.renderables:
            try:
                shader = document.generate(target.name, item.path)
                made = [shader.vertex, shader.pixel, shader.reflection_json]
            except mxgen.DocumentError:
                made = None
            found.setdefault(target.name + " " + path, {})[item.path] = made
json.dump(found, sys.stdout)
`;

if (python)
    test("the same bytes as Python", () => {
        const text = execFileSync(python, ["-c", BY_PYTHON, ...documents], { env: { ...process.env, PYTHONPATH: pythonPackage }, encoding: "utf8",
                                                                            maxBuffer: 1 << 30 });
        const found = JSON.parse(text);
        for (const { name } of mxgen.targets)
            for (const file of documents)
                assert.deepEqual(sourcesByJs(file, name), found[`${name} ${file}`] ?? {}, `${file} ${name}`);
    });
else
    console.log("skip: the Python package was not built: its bytes were not compared");

test("the same messages as the program", () => {
    const broken = GOLD.replace("0.9, 0.6, 0.2", "red").replace('nodename="Spots"', 'nodename="Spot"');
    inFolder(out => {
        const file = path.join(out, "broken.mtlx");
        fs.writeFileSync(file, broken);
        const said = spawnSync(program, ["validate", file], { encoding: "utf8" }).stderr;
        const context = mxgen.createContext(), text = context.load(file).validate().format({ source: broken });
        assert(text.includes("^"), text);
        assert(said.startsWith(text), `${said}\n---\n${text}`);
    });
});

// ---- Documents ----

test("elements", () => {
    const gold = mxgen.createContext().parse(GOLD, { name: "gold.mtlx" }), color = gold.find("SR/base_color");
    assert.deepEqual([color.category, color.name, color.type, color.path], ["input", "base_color", "color3", "SR/base_color"]);
    assert.deepEqual(color.place, { file: "gold.mtlx", line: 4, column: 5 });
    assert(color.parent.equals(gold.find("SR")) && !color.equals(gold.root));
    assert.equal(gold.root.parent, null);
    assert.deepEqual([...gold.walk()].map(({ name }) => name),
                     ["", "SR", "base_color", "metalness", "specular_roughness", "Spots", "Gold", "surfaceshader"]);
    assert.equal(gold.root.child("SR").child("metalness").value, 1);
    assert.deepEqual(color.value.map(Math.fround), [0.9, 0.6, 0.2].map(Math.fround));
    assert.deepEqual([...color.attributes], [["type", "color3"], ["value", "0.9, 0.6, 0.2"]]);
    assert.equal(color.get("colorspace"), null);
    const { source, output } = gold.find("SR/specular_roughness").connection;
    assert.deepEqual([source.name, output, source.definition.name], ["Spots", "", "ND_noise2d_float"]);
    assert.equal(color.connection, null);
    assert.equal(gold.find("none"), null);
    assert.deepEqual([...gold].map(({ name }) => name), ["SR", "Spots", "Gold"]);
    assert.deepEqual(gold.find("Gold").edges.map(({ element, input, upstream }) => [element.name, input.name, upstream.name]),
                     [["Gold", "surfaceshader", "SR"], ["SR", "specular_roughness", "Spots"]]);
    assert.deepEqual(gold.find("Gold").upstream.map(({ name }) => name), ["SR", "Spots"]);
    assert.deepEqual(gold.find("SR").inputs.map(({ name }) => name), [...gold.find("SR")].map(({ name }) => name));
    assert.equal(gold.find("SR").input("metalness").value, 1);
    assert.equal(gold.find("SR").input("none"), null);
    assert.deepEqual(gold.find("SR").outputs, []);
    const shown = [gold, gold.find("SR"), gold.generate("glsl"), gold.context].map(thing => inspect(thing));
    assert.deepEqual(shown, ['Document "gold.mtlx", 3 elements', '<standard_surface "SR">', 'Shader "Gold" for glsl', "Context"]);
    assert.match(inspect(gold.library), /^Library, \d+ definitions$/);
    assert.throws(() => new js.Element(gold, 12345), ArgumentError);
    assert.deepEqual(gold.renderables, [{ path: "Gold", type: "material", category: "surfacematerial" }]);
    assert.deepEqual(gold.files, ["gold.mtlx"]);
    assert.equal(gold.diagnostics.length, 0);
    assert.deepEqual(gold.nodedefs, []);
    assert.deepEqual(gold.lookMaterials("none"), []);
    assert(gold.context.parse(gold.xml()).xml() === gold.xml());
    const values = mxgen.createContext().parse(`<materialx version="1.39"><nodegraph name="N"><input name="b" type="boolean" value="true"/>
        <input name="i" type="integer" value="16777217"/><input name="s" type="string" value="été"/><input name="n" type="float"/>
        </nodegraph></materialx>`).find("N").children.map(({ value }) => value);
    assert.deepEqual(values, [true, 16777217, "été", null]);
});

test("edits", () => {
    const context = mxgen.createContext(), edit = context.edit(null, { name: "copper" });
    const shader = edit.add("standard_surface", "SR", "surfaceshader").value("base_color", [0.9, 0.5, 0.25]).value("metalness", 1);
    const material = edit.add("surfacematerial", "Copper", "material").connect("surfaceshader", shader);
    const note = material.add("input", "displacementshader", "displacementshader");
    note.remove();
    assert.equal(material.child("surfaceshader").number > 0, true);
    assert.throws(() => edit.add("noise2d", "SR", "float"), EditError);
    assert.throws(() => shader.value("base_color", [NaN], "color3"), TypeError);
    assert.throws(() => shader.value("base", 1e40), TypeError);
    assert.throws(() => shader.value("base_color", [0, -1e40, 0], "color3"), TypeError);
    assert.throws(() => shader.value("base_color", {}, "color3"), TypeError);
    assert.throws(() => shader.connect("base_color", {}), TypeError);
    assert.throws(() => context.edit().add("a", "b").connect("x", shader), ArgumentError);
    assert.deepEqual(["SR", "new", "1 x", ""].map(name => edit.root.uniqueName(name)), ["SR2", "new", "_1_x", "_"]);
    const copper = edit.end();
    assert.throws(() => edit.add("noise2d", "n"), /the edit was destroyed/);
    assert.throws(() => shader.set("a", "b"), /the edit was destroyed/);
    const typed = context.parse(`<materialx version="1.39"><standard_surface name="SR" type="surfaceshader">
        <input name="base_color" type="color3" value="0.9, 0.5, 0.25"/><input name="metalness" type="float" value="1"/></standard_surface>
        <surfacematerial name="Copper" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial>
        </materialx>`);
    assert.equal(copper.xml(), typed.xml());
    const next = copper.edit();
    next.find(copper.find("SR")).rename("Surface").set("doc", "new");
    next.copy(copper.find("SR"), "Second").move(null, next.find("Surface"));
    const after = next.end();
    assert.deepEqual(after.root.children.map(({ name }) => name), ["Second", "Surface", "Copper"]);
    assert.equal(after.find("Copper/surfaceshader").get("nodename"), "Surface");
    assert.equal(after.find("Second").place, null);
    const flattened = after.edit();
    flattened.find("Surface").flatten();
    assert.equal(flattened.end().find("Surface").category, "surface");
    const grouped = copper.edit();
    assert.equal(grouped.group([grouped.add("constant", "C", "float")], "Graph").number, grouped.find("Graph").number);
    assert.deepEqual(grouped.end().find("Graph").children.map(({ name }) => name), ["C"]);
    const defining = copper.edit();
    defining.add("nodegraph", "NG").add("output", "out", "float").set("value", "1");
    assert.equal(defining.define(defining.find("NG"), "ND_one", "one").number, defining.find("ND_one").number);
    assert.throws(() => defining.define(defining.find("NG"), "ND_two", "two"), /implements 'ND_one' already/);
    const defined = defining.end();
    assert.equal(defined.find("NG").get("nodedef"), "ND_one");
    const using = defined.edit();
    using.find("SR").connect("specular_roughness", using.add("one", "One", "float"));
    assert.equal(using.end().find("One").definition.name, "ND_one");
    const lossy = after.edit();
    lossy.find("Surface").remove();
    assert.throws(() => lossy.end(), error => error instanceof DocumentError && error.diagnostics.items[0].id === "removed-reference");
    const joined = copper.edit();
    joined.add("layer", "L", "surfaceshader").connect("top", copper.find("SR")).move(null, copper.find("SR"));
    joined.cancel();
    const wrong = context.edit();
    assert.throws(() => wrong.add("standard_surface", "SR", "surfaceshader").value("base_color", "red", "color3"), EditError);
    wrong.cancel();
    assert.throws(() => wrong.end(), /the edit was destroyed/);
});

test("text for text", () => {
    const context = mxgen.createContext();
    assert(context.format("<materialx version='1.39'><!-- kept --><noise2d type='float' name='n'/></materialx>").includes("<!-- kept -->"));
    const old = context.upgrade('<materialx version="1.36"><standard_surface name="S" type="surfaceshader"/><material name="M"><shaderref name="r" node="standard_surface"/></material></materialx>');
    assert(old.text.includes('version="1.39"') && old.diagnostics.length > 0, old.text);
    const flat = context.parse('<materialx version="1.39"><standard_surface name="S" type="surfaceshader"><input name="metalness" type="float" value="0.25"/></standard_surface></materialx>');
    assert.match(flat.translate("gltf_pbr").text, /<gltf_pbr name="S"[^]*<input name="metallic" type="float" value="0.25"/);
    assert.throws(() => flat.translate("lambert"), DocumentError);
    const mixed = context.parse('<materialx version="1.39"><standard_surface name="A" type="surfaceshader"/><standard_surface name="B" type="surfaceshader"/>'
        + '<mix name="C" type="surfaceshader"><input name="fg" type="surfaceshader" nodename="A"/><input name="bg" type="surfaceshader" nodename="B"/>'
        + '<input name="mix" type="float" value="0.5"/></mix></materialx>');
    assert.match(mixed.translate("gltf_pbr").text, /<mix name="C"/);
    assert.match(mixed.translate("gltf_pbr", { joined: true }).text, /<gltf_pbr name="C"/);
    assert.throws(() => mixed.translate("gltf_pbr", { join: true }), ArgumentError);
    assert.throws(() => context.rewrite("shorten", "x", ""), ArgumentError);
    assert.throws(() => context.format("<"), DocumentError);
});

// ---- Shaders ----

test("reflection", () => {
    const shader = mxgen.createContext().load(path.join(examples, "marble.mtlx")).generate("vulkan");
    const stone = shader.findVariable("NG_marble/stone");
    assert.deepEqual([stone.documentType, stone.block, stone.uiname, stone.stages], ["color3", "publicUniforms", "Stone", ["pixel"]]);
    assert.deepEqual(shader.variables[stone.index], stone);
    assert.equal(shader.findVariable("NG_marble/none"), null);
    assert.deepEqual(shader.reflection(), JSON.parse(shader.reflectionJson));
    assert.equal(shader.closurePaths.length, shader.info.numClosures);
    assert.equal(shader.inputState("NG_marble/stone"), "uniform");
    const data = shader.pack("publicUniforms");
    assert.equal(data.length, shader.block("publicUniforms").byteSize);
    shader.packValue(data, stone, [1, 0.5, 0.25]);
    assert.deepEqual([...new Float32Array(data.buffer, stone.offset, 3)], [1, 0.5, 0.25]);
    const scale = shader.findVariable("NG_marble/scale");
    shader.packValue(data, scale, 6);
    assert.equal(new Float32Array(data.buffer, scale.offset, 1)[0], 6);
    assert.throws(() => shader.packValue(data, stone, 1), ArgumentError);
    assert.throws(() => shader.packValue(data, stone, [1]), ArgumentError);
    assert.throws(() => shader.packValue(data, scale, "6"), TypeError);
    assert.throws(() => shader.packValue([1], stone, [1]), TypeError);
    assert.throws(() => shader.packValue(data, { index: 1e6, name: "x" }, [1]), ArgumentError);
    assert.throws(() => shader.packValue(data, { index: NaN, name: "x" }, [1]), ArgumentError);
    for (const number of [NaN, Infinity, -1, 1.5, 2 ** 32]) {
        assert.throws(() => shader.packValue(data, scale, 6, number), ArgumentError);
        assert.throws(() => shader.textureFile(scale, { tile: number }), ArgumentError);
        assert.throws(() => shader.textureFile(scale, { frame: number < 0 ? -(2 ** 32) : number }), ArgumentError);
    }
    assert.throws(() => shader.block("none"), ArgumentError);
    assert.deepEqual(shader.lightTypes.map(({ type }) => type).sort(), [1, 2, 3]);
    const lines = shader.pixel.split("\n").map((_, line) => shader.sourcePlace("pixel", line + 1));
    assert(lines.some(place => place?.path === "NG_marble/scaled"));
    assert(shader.pixel.split("\n").some((_, line) => shader.sourcePath("pixel", line + 1)));
    assert.equal(shader.sourcePlace("pixel", 0), null);
    const tiles = mxgen.createContext().load(path.join(examples, "tiles.mtlx")).generate("glsl").variables.find(({ tiles }) => tiles.length);
    assert.equal(tiles.tiles[2].file.replace(/.*1011/, "1011"), "1011.exr");
    assert.equal(tiles.origin, path.join(examples, "tiles.mtlx"));
    const lamp = mxgen.createContext().load(path.join(examples, "lamp.mtlx")).generate("glsl");
    assert.deepEqual(lamp.files.map(file => path.basename(file)), ["lamp.ies"]);
    const group = mxgen.createContext().load(path.join(examples, "car_paint.mtlx")).generate("osl", { options: { "osl-network": true } });
    assert(group.parts.length > 2 && group.parts.every(({ source }) => source.includes("shader ")));
});

test("textures by frame and tile", () => {
    const shader = mxgen.createContext().load(path.join(examples, "tiles.mtlx")).generate("glsl");
    const foam = shader.variables.find(({ path: at }) => at.includes("foam"));
    assert(shader.textureFile(foam, { frame: 49 }).endsWith("foam.0001.exr"));
});

test("options and changes", () => {
    const document = mxgen.createContext().load(path.join(examples, "marble.mtlx"));
    const complete = document.generate("glsl"), reduced = document.generate("glsl", { options: { interface: "reduced" } });
    assert(reduced.pixel.length < complete.pixel.length);
    assert(reduced.compiledInputs.some(({ path: at }) => at === "NG_marble/stone"));
    const kept = document.generate("glsl", { options: { interface: "reduced", uniform: ["NG_marble/stone", "NG_marble/vein"], "max-lights": 2 } });
    assert(kept.findVariable("NG_marble/vein") && kept.pixel.includes("u_lightData[2]"));
    for (const options of [{ none: 1 }, { interface: "some" }, { "max-lights": -1 }])
        assert.throws(() => document.generate("glsl", { options }), error => error instanceof ArgumentError && error.message.includes(Object.keys(options)[0]));
    assert.throws(() => document.generate("glsl", { options: { interface: null } }), TypeError);
    assert.throws(() => document.generate("glsl", "SR"), TypeError);
    assert.throws(() => document.generate("glsl", { elment: "SR" }), /no option 'elment'; known are element, stack/);
    const edit = document.edit();
    edit.find("NG_marble/stone").set("value", "1, 0, 0");
    const after = edit.end().generate("glsl"), change = complete.change(after);
    assert.deepEqual([change.kind, change.variables.map(({ path: at }) => at)], ["values", ["NG_marble/stone"]]);
    assert.equal(complete.change(reduced).kind, "shader");
    assert.equal(document.generate("glsl", { withoutSource: true }).pixel, null);
    assert.throws(() => document.generate("glsl", { onlyDiagnostics: true }).info, ArgumentError);
    assert(document.inspect("closures").includes("SR_marble"));
    assert.throws(() => document.inspect("none"), ArgumentError);
});

test("libraries", () => {
    const context = mxgen.createContext(), { library } = context;
    assert(library.nodedefNames.length > 700);
    const mix = library.nodedef("ND_mix_color3");
    assert.deepEqual([mix.node, mix.inputs.map(({ name }) => name)], ["mix", ["fg", "bg", "mix"]]);
    assert.deepEqual(mix.implementations.map(({ target, nodegraph, sourcecode }) => [target, nodegraph, sourcecode !== ""]), [["", "", true]]);
    assert.equal(library.nodedef("none"), null);
    assert(library.supports("ND_mix_color3", "essl"));
    assert.throws(() => library.supports("none", "essl"), ArgumentError);
    assert.deepEqual([library.files, library.diagnostics.length], [[], 0]);
    const files = { "own.mtlx": `<materialx version="1.39"><nodedef name="ND_twice" node="twice"><input name="in" type="float" value="1"/>
        <output name="out" type="float"/></nodedef><implementation name="IM_twice" nodedef="ND_twice" sourcecode="{{in}} * 2.0"/></materialx>` };
    const own = mxgen.createContext({ resolver: (_, ref) => files[ref] });
    const alone = own.loadLibrary(["own.mtlx"], { standalone: true });
    assert.deepEqual([alone.files, alone.nodedefNames], [["own.mtlx"], ["ND_twice"]]);
    files["own.mxlib"] = alone.image();
    assert(alone.expand().includes("ND_twice"));
    assert(alone.losses.length === 0);
    assert.deepEqual(own.loadLibrary(["own.mxlib"], { standalone: true }).nodedefNames, ["ND_twice"]);
    const both = own.loadLibrary(["own.mtlx"]);
    assert.throws(() => both.image(), ArgumentError);
    const used = own.parse('<materialx version="1.39"><twice name="t" type="float"/><output name="o" type="float" nodename="t"/></materialx>', { library: both });
    assert(used.generate("glsl").pixel.includes("out1"));
    assert.throws(() => own.loadLibrary(["gone.mtlx"]), DocumentError);
    assert.throws(() => own.loadLibrary("own.mtlx"), TypeError);
});

test("catalogues", () => {
    assert.match(mxgen.version, /^\d+\.\d+\.\d+$/);
    assert.deepEqual(mxgen.targets.find(({ name }) => name === "essl").suffixes.pixel, "frag");
    assert(mxgen.options.some(({ key, type }) => key === "interface" && type === "enum"));
    assert(mxgen.optionApplies("osl-network", "osl") && !mxgen.optionApplies("osl-network", "essl"));
    assert.throws(() => mxgen.optionApplies("none", "osl"), ArgumentError);
    assert.throws(() => mxgen.optionApplies("interface", "cobol"), ArgumentError);
    assert(mxgen.diagnosticKinds.some(({ id, cure }) => id === "type-mismatch" && cure));
    assert(mxgen.semantics.some(({ semantic }) => semantic === "worldMatrix"));
    assert(js.Mxgen.valuesOf("mxg_view").includes("dot"));
});

// ---- Files ----

test("includes by the resolver", async () => {
    const files = { "a/main.mtlx": '<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href="part.mtlx"/></materialx>', "a/part.mtlx": GOLD };
    const asked = [], resolver = (from, ref) => {
        asked.push([from, ref]);
        const name = from ? `a/${ref}` : ref;
        return name in files ? { name, data: files[name] } : null;
    };
    const document = mxgen.createContext({ resolver }).load("a/main.mtlx");
    assert.deepEqual([document.files, asked], [["a/main.mtlx", "a/part.mtlx"], [["", "a/main.mtlx"], ["a/main.mtlx", "part.mtlx"]]]);
    const context = mxgen.createContext({ resolver: () => null });
    const later = await context.loadAsync("a/main.mtlx", async (from, ref) => resolver(from, ref));
    assert.equal(later.xml(), document.xml());
    await assert.rejects(context.loadAsync("none.mtlx", async () => null), DocumentError);
    await assert.rejects(context.loadAsync("a/main.mtlx", async () => { throw new RangeError("offline"); }), RangeError);
    assert.throws(() => context.load("a/main.mtlx"), DocumentError); // the context has its own resolver again
});

test("callbacks that throw", () => {
    const fault = new RangeError("from the callback");
    for (const options of [{ resolver: () => { throw fault; } }, { resolver: () => ({ data: GOLD }), cancel: () => { throw fault; } }]) {
        const context = mxgen.createContext(options);
        for (let round = 0; round < 2; round++)
            assert.throws(() => context.load("x.mtlx").generate("glsl"), error => error === fault);
        assert(context.parse(GOLD)); // the context still works
    }
    for (const answer of [5, {}, { data: 5 }, { data: "", name: 5 }])
        assert.throws(() => mxgen.createContext({ resolver: () => answer }).load("x"), TypeError);
    assert.throws(() => mxgen.createContext({ cancel: () => true }).parse(GOLD).generate("glsl"), CancelledError);
    assert.throws(() => mxgen.createContext({ resolver: 5 }), TypeError);
    assert.throws(() => mxgen.createContext({ listFolder: () => [], resolver: null, none: 1 }), /there is no option 'none'/);
    const tiles = '<materialx version="1.39"><image name="i" type="color3"><input name="file" type="filename" value="t/a.<UDIM>.png"/></image></materialx>'.replace("<UDIM>", "&lt;UDIM&gt;");
    assert.throws(() => mxgen.createContext({ resolver: () => null, listFolder: () => { throw fault; } }).parse(tiles).generate("glsl", { element: "i" }), error => error === fault);
    const shader = mxgen.createContext({ resolver: () => null, listFolder: () => ["a.1001.png", "b.png", "a.1012.png"] }).parse(tiles).generate("glsl", { element: "i" });
    assert.deepEqual(shader.variables.find(({ tiles: found }) => found.length).tiles, [{ file: "t/a.1001.png", u: 0, v: 0 }, { file: "t/a.1012.png", u: 1, v: 1 }]);
    assert.throws(() => mxgen.createContext({ resolver: () => null, listFolder: () => [5] }).parse(tiles).generate("glsl", { element: "i" }), TypeError);
    const painted = `<materialx version="1.39"><image name="i" type="color3"><input name="file" type="filename" value="paint.png"/></image>
        <slab name="a" type="BSDF"><input name="diffuse_albedo" type="color3" nodename="i"/></slab><slab name="b" type="BSDF"/>
        <slab_mix name="m" type="BSDF"><input name="fg" type="BSDF" nodename="a"/><input name="bg" type="BSDF" nodename="b"/><input name="mix" type="float" value="0.5"/></slab_mix>
        <slab_surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="m"/></slab_surface></materialx>`;
    const drawn = readTexels => mxgen.createContext({ readTexels }).parse(painted).generate("glsl", { element: "S", options: { "max-error": 5 } });
    const asked = [];
    assert(drawn((from, file, layer, size) => { asked.push([file, layer]); return new Float32Array(4 * size * size).fill(0.5); }));
    assert.deepEqual(asked, [["paint.png", ""]]);
    assert(drawn(() => null));
    assert.throws(() => drawn(() => [1, 2]), TypeError);
    assert.throws(() => drawn(() => { throw fault; }), error => error === fault);
    let reentered;
    const context = mxgen.createContext({ resolver: () => { try { context.parse(GOLD); } catch (error) { reentered = error; } return null; } });
    assert.throws(() => context.load("x"), DocumentError);
    assert.match(reentered.message, /cannot use its own context/);
    const other = mxgen.createContext(), nested = mxgen.createContext({ resolver: () => other.parse(GOLD).xml() });
    assert.equal(nested.load("x").renderables.length, 1); // another context can be used
});

test("wrong arguments are told, and the instance goes on", () => {
    const context = mxgen.createContext(), document = context.parse(GOLD), diagnostics = document.validate(), edit = document.edit();
    const hostile = { valueOf() { throw new Error("of the caller"); } };
    for (const index of [10n, "x", NaN, -1, undefined, hostile, diagnostics.length])
        assert.throws(() => diagnostics.formatOne(index), ArgumentError);
    assert.throws(() => edit.group(undefined), /^TypeError: nodes must be iterable, not undefined$/);
    assert.throws(() => context.scene().addEach(0.5), /^TypeError: primitives must be iterable, not number$/);
    assert.throws(() => context.scene().addEach([null]), /^TypeError: a primitive must be object, not null$/);
    assert.throws(() => context.loadLibrary(new Set(["a.mtlx"])), /^TypeError: paths must be an array, not Set$/);
    assert.throws(() => document.bind(context.scene(), null, { solo: new Set(["000"]) }), /^TypeError: solo must be an array, not Set$/);
    for (const call of [() => mxgen.createLanguageServer(null), () => document.translate("gltf_pbr", null), () => document.inspect("graph", null)])
        assert.throws(call, /^TypeError: options must be object, not null$/);
    for (const call of [() => context.load("a.mtlx", { libary: null }), () => context.parseScene("", { porpose: "full" }), () => context.passes("glsl", { option: {} })])
        assert.throws(call, /there is no option '(libary|porpose|option)'; known are /);
    assert.throws(() => mxgen.optionApplies(Symbol("role"), "glsl"), /^TypeError: key must be string, not symbol$/);
    assert(document.generate("glsl").pixel.length > 0);
});

// ---- Scenes ----

test("scenes", () => {
    const context = mxgen.createContext(), scene = context.scene("/set/table", "/set/chair/leg"), leg = scene.find("/set/chair/leg");
    assert.deepEqual([...scene].map(({ path: name }) => name), ["/set", "/set/table", "/set/chair", "/set/chair/leg"]);
    assert.deepEqual([leg.name, leg.type, leg.parent.path, leg.children, scene.metersPerUnit], ["leg", "", "/set/chair", [], 0]);
    assert.deepEqual(scene.find("/set").children.map(({ name }) => name), ["table", "chair"]);
    assert(leg.equals(scene.find("/set/chair/leg")) && !leg.equals(leg.parent) && scene.find("/set").parent === null && scene.find("/none") === null);
    assert.throws(() => scene.add("/a", "b c", "/d"), error => error instanceof DocumentError && /b c/.test(error.message));
    assert.equal(scene.length, 6);
    assert.throws(() => new js.Primitive(scene, 6), ArgumentError);
    assert.deepEqual([mxgen.encodeSlot("050::010"), mxgen.decodeSlot("_050:_:_010")], ["_050:_:_010", "050::010"]);
    assert.throws(() => mxgen.encodeSlot(""), ArgumentError);
    inFolder(out => {
        const file = path.join(out, "stage.usda");
        fs.writeFileSync(file, `#usda 1.0
( upAxis = "Z"; metersPerUnit = 0.5 )
def Mesh "box" {
    float[] primvars:wear = [0.25, 0.5] (interpolation = "vertex")
    token subdivisionScheme = "none"
    rel friends = [</ball>, </nowhere>]
    rel material:binding = </paint>
}
def Sphere "ball" {}
def Material "paint" {
    token outputs:mtlx:surface.connect = </paint/shader.outputs:out>
    def Shader "shader" { uniform token info:id = "ND_standard_surface_surfaceshader"; token outputs:out }
}
`);
        const stage = context.loadScene(file), box = stage.find("/box"), wear = box.property("primvars:wear");
        assert.deepEqual([stage.upAxis, stage.metersPerUnit, box.type, stage.diagnostics.length], ["Z", 0.5, "Mesh", 0]);
        assert.deepEqual([wear.type, wear.interpolation, wear.value, wear.line], ["float[]", "vertex", "[0.25, 0.5]", 4]);
        assert.deepEqual(box.properties.get("primvars:wear"), wear);
        assert.deepEqual([box.numbers("primvars:wear"), box.words("subdivisionScheme"), box.numbers("none"), box.property("none")],
                         [[0.25, 0.5], ["none"], [], null]);
        assert.deepEqual(box.targets("friends").map(target => target?.path), ["/ball", undefined]);
        assert.equal(context.sceneMaterials(stage).renderables.length, 1);
        const both = context.parse(GOLD).withMaterials(stage), bindings = both.bind(stage);
        assert.equal(both.renderables.length, 2);
        assert.equal(bindings.layers(box)[0].source.path, "/box");
        assert(both.generate("essl", { stack: bindings.stack("/box") }).pixel.includes("base_color"));
        const parsed = context.parseScene(fs.readFileSync(file), { name: "shot.usda" });
        assert.equal(parsed.find("/box").property("primvars:wear").file, "shot.usda");
        assert.throws(() => context.parseScene("#usda 1.0\ndef {"), DocumentError);
        fs.writeFileSync(file, "#usda 1.0\ndef {");
        assert.throws(() => context.loadScene(file), DocumentError);
    });
});

test("a scene that changes", () => {
    const context = mxgen.createContext(), scene = context.scene("/set"), other = context.scene("/set");
    const table = { name: "table", parent: scene.find("/set"), type: "Mesh" }, items = [table, { name: "leg/foot", parent: table }, { name: "lamp" }];
    const [made, foot, lamp] = scene.addEach(items);
    assert.deepEqual([made, foot, lamp].map(({ path, type }) => [path, type]), [["/set/table", "Mesh"], ["/set/table/leg/foot", ""], ["/lamp", ""]]);
    assert.throws(() => scene.addEach([{ name: "a" }, { name: "b//c" }]), DocumentError);
    assert(scene.find("/a"));
    assert.throws(() => scene.addEach([{ name: 5 }]), TypeError);
    assert.throws(() => scene.addEach([{ name: "b", parent: other.find("/set") }]), /another scene/);
    scene.bind(null, "000", "Gold");
    scene.bind("/lamp", "050", "");
    assert.deepEqual(scene.bindingsOf(lamp), [{ slot: "050", material: "", isCollection: false, isStrong: false, isPurpose: false, file: "", line: 0 }]);
    assert.throws(() => scene.bind("/lamp", "a:b", "Gold"), DocumentError);
    assert.throws(() => scene.bind("/none", "000", "Gold"), /no primitive/);
    assert.throws(() => scene.unbind(other.find("/set"), "000"), /another scene/);
    const document = context.parse(GOLD), before = document.bind(scene);
    assert.equal(before.numResolved, scene.length);
    scene.bind("/set/table", "050", "Gold");
    scene.unbind("/lamp", "050");
    assert.equal(before.stack("/lamp"), null);
    const after = document.bind(scene, null, { previous: before });
    assert.equal(after.numResolved, 3);
    assert.equal(after.text("json"), document.bind(scene).text("json"));
    assert.deepEqual(after.layers(foot).map(({ slot, source }) => [slot, source?.path]), [["000", undefined], ["050", "/set/table"]]);
    assert.throws(() => document.bind(other, null, { previous: before }), ArgumentError);
    const length = scene.length;
    scene.remove("/set/table/leg", lamp);
    assert.equal(scene.length, length - 3);
    assert.equal(scene.find("/lamp"), null);
    assert.deepEqual([...scene].map(primitive => primitive.path).filter(path => path.startsWith("/set/")), ["/set/table"]);
    assert.throws(() => scene.remove(foot), ArgumentError);
    assert.throws(() => scene.remove("/lamp"), /no primitive/);
    const last = document.bind(scene, null, { previous: after });
    assert.equal(last.numResolved, 0);
    assert.equal(last.text("json"), document.bind(scene).text("json"));
    assert.throws(() => document.bind(scene, null, { previous: 5 }), TypeError);
});

test("the feature of a device", () => {
    const document = mxgen.createContext().parse(GOLD);
    assert.equal(document.generate("wgsl", { options: { precision: "mediump" } }).info.deviceFeatures, "shader-f16");
    assert.equal(document.generate("wgsl").info.deviceFeatures, "");
});

test("functions of the host", () => {
    const document = mxgen.createContext().parse(GOLD);
    assert.deepEqual(document.generate("essl").hostFunctions, []);
    const { hostFunctions } = document.generate("essl", { options: { role: "function", "host-environment": true } });
    assert.deepEqual(hostFunctions.sort(), ["mxg_irradiance", "mxg_light", "mxg_light_count", "mxg_radiance"]);
});

test("passes of the deferred pipeline", () => {
    const context = mxgen.createContext(), passes = context.passes("vulkan");
    inFolder(folder => {
        const { status, stderr } = spawnSync(program, ["pipeline", folder, "--target", "vulkan"], { encoding: "utf8" });
        assert.equal(status, 0, stderr);
        for (const { name, shader } of passes) {
            const file = fs.readdirSync(folder).find(file => file.startsWith(`${name}.`) && !file.endsWith(".json"));
            assert.equal(shader.pixel, fs.readFileSync(path.join(folder, file), "utf8"), name);
        }
    });
    assert(passes.length > 2);
    assert.equal(mxgen.passResources[0].kind.length > 0, true);
    assert(mxgen.passResources.some(({ name }) => name === "words"));
    const { members } = mxgen.passResources.find(({ name }) => name === "frame");
    assert.deepEqual(members.map(({ name, offset }) => [name, offset]).at(-1), ["mx_show", 80]);
    assert.deepEqual(passes[0].shader.passInfo.groupSize, [8, 8, 1]);
    assert.throws(() => context.passes("moon"), DocumentError);
});

test("the module of the materials of MDL", () => {
    const context = mxgen.createContext(), options = { "mdl-module": "studio" };
    const module = context.module("mdl", { options }), marble = context.load(path.join(examples, "marble.mtlx")).generate("mdl", { options });
    assert.match(module.pixel, /^export float mx_fractal_float_vec3\(/m);
    assert.match(marble.pixel, /^import ::studio::\*;$/m);
    assert.throws(() => context.module("glsl", { options }), DocumentError);
});

test("facts of primitives", () => {
    const context = mxgen.createContext(), scene = context.scene("/set/table", "/set/chair");
    const document = context.parse(`<materialx version="1.39"><geominfo name="G" geom="/set/table"><token name="id" type="string" value="7"/></geominfo>
        <look name="L"><visibility name="v" visible="false" geom="/set"/></look></materialx>`);
    const facts = document.bind(scene, "L").facts("/set/table").map(({ kind, name, value, source }) => [kind, name, value, source?.path]);
    assert.deepEqual(facts.sort(), [["token", "id", "7", "/set/table"], ["visibility", "", "false", "/set"]]);
    assert.deepEqual(document.bind(scene, "L").facts("/set/chair").map(({ kind }) => kind), ["visibility"]);
});

test("the values of another document", () => {
    const context = mxgen.createContext(), document = context.load(path.join(examples, "marble.mtlx")), shader = document.generate("vulkan");
    const stone = shader.findVariable("NG_marble/stone"), edit = context.edit(document);
    edit.find("NG_marble/stone").set("value", "0.5, 0.25, 0.125");
    const data = shader.packFrom(edit.end(), "publicUniforms");
    assert.deepEqual([...new Float32Array(data.buffer, stone.offset, 3)], [0.5, 0.25, 0.125]);
    assert.throws(() => shader.packFrom(shader, "publicUniforms"), TypeError);
    assert.throws(() => shader.packFrom(context.parse("<materialx version='1.39'/>"), "publicUniforms"), ArgumentError);
});

test("the layers of primitives", () => {
    const looks = path.join(examples, "slots/looks.mtlx"), receiver = path.join(examples, "slots/receiver.usda");
    const context = mxgen.createContext(), document = context.load(looks);
    const scene = context.loadScene(receiver), bindings = document.bind(scene, "finished");
    const layers = bindings.layers("/receiver/keys");
    assert.deepEqual(layers.map(({ kind, slot, material }) => [kind, slot, material]),
                     [["layer", "000", "generic"], ["layerOverride", "000::010", "generic_pattern"], ["layerVertical", "000|010", "varnish"],
                      ["layer", "050", "dirt"], ["layerOverride", "050::010", "dirt_pattern"]]);
    assert.deepEqual(layers.map(({ source }) => source?.path ?? null), ["/receiver", "/receiver", "/receiver/keys", null, "/receiver"]);
    assert.deepEqual(document.bind(scene, "finished", { solo: ["050"] }).layers("/receiver/keys").map(({ slot }) => slot), ["050", "050::010"]);
    assert.deepEqual(document.bind(scene, "finished", { mute: ["050"] }).layers("/receiver/keys").map(({ slot }) => slot), ["000", "000::010", "000|010"]);
    const table = spawnSync(program, ["bind", looks, "--look", "finished", "--stage", receiver],
                            { encoding: "utf8" });
    assert.equal(bindings.text(), table.stdout);
    assert.equal(JSON.parse(bindings.text("json")).stacks.length, bindings.stacks.length);
    assert.match(bindings.explain("/receiver/keys"), /varnish/);
    inFolder(out => {
        spawnSync(program, [looks, "--look", "finished", "--stage", receiver, "-o", out]);
        const written = fs.readdirSync(out).filter(name => name.endsWith(".frag"));
        for (const name of written) {
            const stack = bindings.stacks.find(made => `${made.name}.frag` === name);
            assert.equal(document.generate("glsl", { stack }).pixel, fs.readFileSync(path.join(out, name), "utf8"));
        }
        assert(written.length > 3);
    });
    assert.throws(() => document.bind(scene, "none"), DocumentError);
    assert.throws(() => bindings.text("xml"), ArgumentError);
    assert.throws(() => bindings.layers("/none"), /no primitive/);
    assert.throws(() => bindings.layers(context.scene("/device").find("/device")), /another scene/);
    assert.throws(() => context.parse(GOLD).generate("glsl", { stack: bindings.stacks[0] }), ArgumentError);
    for (const use of [() => document.bind({}), () => document.withMaterials({}), () => context.sceneMaterials({}), () => scene.find(5), () => bindings.stack(5)])
        assert.throws(use, TypeError);
    const { pixel } = document.generate("glsl", { stack: bindings.stack("/receiver/keys") });
    scene.destroy();
    document.destroy();
    assert.throws(() => bindings.layers("/device"), /the scene was destroyed/);
    bindings.destroy();
    assert(pixel.length > 100);
});

// ---- Lifetimes and limits ----

test("objects used after free", () => {
    const context = mxgen.createContext(), document = context.parse(GOLD), element = document.find("SR"), shader = document.generate("glsl");
    const { diagnostics } = document;
    document.destroy();
    document.destroy();
    for (const use of [() => document.renderables, () => element.name, () => document.generate("glsl"), () => context.edit(document)])
        assert.throws(use, /the document was destroyed/);
    assert.equal(shader.info.name, "Gold"); // it keeps the document
    assert.deepEqual([diagnostics.length, diagnostics.format()], [0, ""]);
    context.destroy();
    assert.throws(() => context.parse(GOLD), /the context was destroyed/);
    assert(shader.pixel.length > 100);
    shader.destroy();
    assert.throws(() => shader.pixel, /the shader was destroyed/);
    assert(new MxgenError("x") instanceof Error);
});

test("limits", () => {
    assert.throws(() => mxgen.createContext({ maxMemory: 20000 }).parse(GOLD), OutOfMemoryError);
    assert.throws(() => mxgen.createContext({ maxElements: 3 }).parse(GOLD), DocumentError);
    for (const maxNodes of [-1, 2 ** 33, 1.5, "5"])
        assert.throws(() => mxgen.createContext({ maxNodes }), ArgumentError);
    assert.throws(() => mxgen.createContext({ warnings: "no-such-id" }), /warnings has the unknown word 'no-such-id'/);
    const context = mxgen.createContext({ maxMemory: 8_000_000 }), held = [];
    assert.throws(() => { for (;;) held.push(context.parse(GOLD).generate("glsl")); }, OutOfMemoryError);
    for (const shader of held)
        shader.destroy();
    for (let round = 0; round < 300; round++) { // nothing leaks: the limit counts all objects
        const document = context.parse(GOLD), shader = document.generate("glsl");
        assert.throws(() => context.parse("<"), error => (error.document.destroy(), true));
        shader.destroy();
        document.destroy();
    }
});

test("a language server", async () => {
    const sent = [], asked = [], uri = "file:///w/main.mtlx";
    const files = { "/w/part.mtlx": '<materialx version="1.39"><noise2d name="Grain" type="float"/></materialx>', "/secret.mtlx": "<materialx/>" };
    const server = mxgen.createLanguageServer({
        send: message => sent.push(message), messagesUrl: "https://example.com/messages",
        readFile: async path => (asked.push(path), files[path]), listFolder: async path => (asked.push(path), path === "/w" ? ["main.mtlx", "part.mtlx", "sub/"] : null) });
    const notify = (method, params) => server.handle({ jsonrpc: "2.0", method, params });
    const request = async (method, params) => {
        const id = sent.length + 1;
        await server.handle(JSON.stringify({ jsonrpc: "2.0", id, method, params }));
        return sent.find(message => message.id === id).result;
    };
    const published = () => sent.findLast(({ method, params }) => method === "textDocument/publishDiagnostics" && params.uri === uri).params;
    const at = (line, character) => ({ textDocument: { uri }, position: { line, character } });
    const text = ['<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href="part.mtlx"/><xi:include href="../secret.mtlx"/>',
                  '  <standard_surface name="SR" type="surfaceshader"><input name="bse" type="float" nodename="Grain"/></standard_surface>', "</materialx>"].join("\n");
    assert((await request("initialize", { rootUri: "file:///w", capabilities: {} })).capabilities.hoverProvider);
    await notify("textDocument/didOpen", { textDocument: { uri, languageId: "materialx", version: 1, text } });
    assert.deepEqual(published().diagnostics.map(({ code }) => code), ["include-missing", "unknown-input"]);
    assert.match(published().diagnostics[0].message, /outside the folders/);
    assert.equal(published().diagnostics[1].codeDescription.href, "https://example.com/messages#unknown-input");
    const [fix] = await request("textDocument/codeAction", { ...at(1, 0), range: published().diagnostics[1].range, context: { diagnostics: [published().diagnostics[1]] } });
    assert.equal(fix.edit.changes[uri][0].newText, "base");
    assert.match((await request("textDocument/hover", at(1, 10))).contents.value, /standard_surface/);
    assert.equal((await request("textDocument/definition", at(1, text.split("\n")[1].indexOf("Grain") + 1))).uri, "file:///w/part.mtlx");
    const renamed = await request("textDocument/rename", { ...at(1, text.split("\n")[1].indexOf("Grain") + 1), newName: "Dust" });
    assert.deepEqual(Object.keys(renamed.changes).sort(), [uri, "file:///w/part.mtlx"]);
    await notify("textDocument/didChange", { textDocument: { uri, version: 2 }, contentChanges: [{ range: { start: { line: 1, character: 2 }, end: { line: 1, character: 2 } }, text: "<" }] });
    assert.equal(published().version, 2);
    assert((await request("textDocument/completion", at(1, 3))).items.some(({ label }) => label === "standard_surface"));
    delete files["/w/part.mtlx"];
    await notify("workspace/didChangeWatchedFiles", { changes: [] });
    await notify("textDocument/didChange", { textDocument: { uri, version: 3 }, contentChanges: [{ text }] });
    assert.deepEqual(published().diagnostics.map(({ code }) => code), ["include-missing", "include-missing", "unknown-input"]);
    assert.deepEqual([...new Set(asked)].sort(), ["/w", "/w/part.mtlx", "/w/sub"]);
    server.destroy();
    assert.throws(() => mxgen.createLanguageServer({}), TypeError);
    assert.throws(() => mxgen.createLanguageServer({ send() {}, warnings: "no-such-id" }), /warnings has the unknown word 'no-such-id'/);
    assert.throws(() => mxgen.createLanguageServer({ send() {}, resolver() {} }), ArgumentError);
});

test("a document of 50 MB", () => {
    const context = mxgen.createContext();
    const wide = Array.from({ length: 400_000 }, (_, i) => `<constant name="c${i}" type="float" doc="a text of some length for each of the elements, so that the file is large, as scanned ones are"/>\n`).join("");
    const document = context.parse(`<materialx version="1.39">${wide}</materialx>`);
    assert.equal(document.find("c399999").name, "c399999");
    document.destroy();
});

test("wrong types", () => {
    const context = mxgen.createContext(), document = context.parse(GOLD);
    for (const use of [() => context.parse(5), () => context.parse(GOLD, { name: 5 }), () => context.load(5), () => document.find(5), () => document.generate(5),
                       () => document.generate("glsl", { options: 5 }), () => context.edit({}), () => document.generate("glsl").change({}),
                       () => context.parse(GOLD, { library: {} }), () => new js.Element({}, 1)])
        assert.throws(use, TypeError);
    assert.throws(() => document.find("a\0b"), /contains a NUL character/);
    assert.throws(() => document.generate("glsl", { element: context.parse(GOLD).find("Gold") }), ArgumentError);
    assert.throws(() => document.generate("glsl").sourcePlace("compute", 1), ArgumentError);
    assert.throws(() => document.generate("cobol"), error => error instanceof DocumentError && error.diagnostics.items[0].id === "unknown-target" && error.diagnostics.items[0].arguments[0] === "cobol");
});

test("broken modules", async () => {
    await assert.rejects(load(path.join(folder, "none.wasm")), { code: "ENOENT" });
    await assert.rejects(js.instantiate(new Uint8Array([1, 2, 3])), WebAssembly.CompileError);
    const module = await WebAssembly.compile(bytes), one = await load(module), two = await js.instantiate(module);
    assert.equal(one.createContext().parse(GOLD).generate("glsl").pixel, two.createContext().parse(GOLD).generate("glsl").pixel);
    const mixed = two.createContext().parse(GOLD).find("SR");
    assert.throws(() => one.createContext().edit().copy(mixed), ArgumentError);
    assert.throws(() => two.createContext().load("x.mtlx"), DocumentError); // no callbacks: no files
});

// ---- The package as a whole ----

test("every function and member is declared, and every function of C is used", () => {
    const declared = fs.readFileSync(path.join(folder, "index.d.ts"), "utf8");
    const layout = fs.readFileSync(path.join(folder, "layout.js"), "utf8");
    const structs = JSON.parse(layout.slice(layout.indexOf("STRUCTS = ") + 10, layout.lastIndexOf(";")));
    const shown = { mxg_variable: "Variable", mxg_diagnostic: "Diagnostic", mxg_port: "Port", mxg_nodedef: "NodeDef", mxg_compiled_input: "CompiledInput",
                    mxg_shader_info: "ShaderInfo", mxg_storage: "Storage", mxg_block_info: "BlockInfo", mxg_option: "Option", mxg_semantic: "Semantic", mxg_tile: "Tile",
                    mxg_diagnostic_kind: "DiagnosticKind", mxg_renderable: "Renderable", mxg_pass_resource: "PassResource", mxg_pass_member: "PassMember",
                    mxg_pass: "PassInfo", mxg_property: "Property", mxg_implementation: "Implementation", mxg_context_desc: "ContextOptions" };
    const hidden = ["size", "numValues", "numTiles", "numMembers", "numArguments", "numInputs", "numOutputs", "realloc", "reallocUserData", "cancelUserData", "sandbox", "includeRoots",
                    "numIncludeRoots", "numSourcePaths", "nodeCodes", "numNodeCodes", "dialects", "numDialects", "texels"]; // nodes in C and targets of a host: not from JavaScript
    for (const [struct, name] of Object.entries(shown)) {
        const [, base, own] = declared.match(new RegExp(`export interface ${name}(?: extends (\\w+))? \\{([^}]*)\\}`));
        const body = own + (base ? declared.match(new RegExp(`export interface ${base} \\{([^}]*)\\}`))[1] : "");
        for (const member of Object.keys(structs[struct].members))
            assert(hidden.includes(member) || new RegExp(`\\b${member}\\??:`).test(body), `${name} lacks ${member}`);
    }
    for (const [name, value] of Object.entries(js)) {
        assert(new RegExp(`export (class|function) ${name}\\b`).test(declared), `index.d.ts lacks ${name}`);
        for (const member of Object.getOwnPropertyNames(value.prototype ?? {}).filter(member => !member.startsWith("_") && member !== "constructor" && member !== "toString"))
            assert(new RegExp(`^    (readonly )?${member}\\b`, "m").test(declared), `index.d.ts lacks ${name}.${member}`);
    }
    const sources = fs.readdirSync(folder).filter(name => name.endsWith(".js")).map(name => fs.readFileSync(path.join(folder, name), "utf8")).join("");
    const headers = fs.readdirSync(path.join(root, "include/mxgen")).filter(name => name !== "node.h").map(name => fs.readFileSync(path.join(root, "include/mxgen", name), "utf8")).join("");
    const notUsed = ["mxg_library_ref", "mxg_context_file_fault", "mxg_document_num_nodedefs", "mxg_edit_set_numbers", "mxg_color_difference"].filter(name => !sources.includes(name));
    const functions = [...headers.matchAll(/MXG_API [^;]*?\b(mxg_\w+)\(/g)].map(([, name]) => name);
    assert(functions.length > 80);
    assert.deepEqual(functions.filter(name => !notUsed.includes(name) && !sources.includes(name) && !sources.includes(name.replace("mxg_", "mxgen_js_")) &&
                                              name !== "mxg_context_create"), []);
});

await run("npm");
