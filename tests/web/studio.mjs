// SPDX-License-Identifier: Apache-2.0
// How the page shows a material, in Chromium: tones, pictures to save, light, meshes, comparison. Arguments: the folder of the page, Chromium, the root of the project,
// and if mxgen-render is built, the program and write_maps.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";

import { run, test } from "../js/harness.mjs";
import { Browser } from "./browser.mjs";
import { readLight } from "../../web/studio/light.js";
import { readMesh } from "../../web/studio/mesh.js";
import { change, compile, DIFFERENCE, drop, MEAN, pick, RED, type, WHOLE, withPage } from "./page.mjs";

const [folder, chromium, root, program, writeMaps] = process.argv.slice(2);
const onDisk = pathToFileURL(path.join(folder, "index.html")).href;
const example = name => path.join(root, "examples", name);
const work = fs.mkdtempSync(path.join(os.tmpdir(), "mxgen-studio-"));
const browser = new Browser(chromium);

const withStudio = (work, size = { width: 960, height: 420 }) => withPage(browser, onDisk, async page => {
    await page.until(`document.body.dataset.studio && document.body.dataset.editor && document.body.dataset.compiled && ${WHOLE}`);
    await change(page, pick("shape", "plane"));
    await work(page);
}, size);

/** A surface that sends this light to everywhere. */
const lamp = light => `<materialx version="1.39"><surface_unlit name="S" type="surfaceshader"><input name="emission_color" type="color3" value="${light.join(", ")}"/>
    </surface_unlit><surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>`;

const close = (found, wanted, tolerance, about) => assert(found.every((x, i) => Math.abs(x - wanted[i]) <= tolerance), `${about}: ${found} instead of ${wanted}`);

// ---- Tones ----

const EXPOSURE = 0.6;
const LIGHTS = [[0.02, 0.05, 0.1], [0.9, 0.2, 0.1], [4, 0.5, 0.02], [0.01, 6, 0.3], [40, 60, 80]];
const encode = x => 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);

async function shown(page, tones, light) {
    await page.evaluate(pick("tones", tones));
    await compile(page, type(page, lamp(light)));
    return page.evaluate(MEAN);
}

/** The results of the tone maps of three.js for lights, by WebGL: sRGB from 0 to 255. */
const byThree = (source, name, lights) => `(() => {
    const gl = new OffscreenCanvas(1, 1).getContext("webgl2"), program = gl.createProgram();
    const sources = ["#version 300 es\\nvoid main() { gl_Position = vec4(0, 0, 0, 1); gl_PointSize = 1.0; }", "#version 300 es\\nprecision highp float;\\n" + ${JSON.stringify(source)} + \`
        uniform vec3 u_light;
        out vec4 color;
        void main()
        {
            vec3 x = clamp(${name}(u_light), 0.0, 1.0);
            color = vec4(mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x)), 1.0);
        }\`];
    sources.forEach((text, index) => {
        const shader = gl.createShader(index ? gl.FRAGMENT_SHADER : gl.VERTEX_SHADER);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        gl.attachShader(program, shader);
    });
    gl.linkProgram(program);
    gl.useProgram(program);
    gl.uniform1f(gl.getUniformLocation(program, "toneMappingExposure"), ${EXPOSURE});
    return ${JSON.stringify(lights)}.map(light => {
        gl.uniform3f(gl.getUniformLocation(program, "u_light"), ...light);
        gl.drawArrays(gl.POINTS, 0, 1);
        const pixel = new Uint8Array(4);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        return [...pixel.subarray(0, 3)];
    });
})()`;

test("no tones by default: light is cut off", () => withStudio(async page => {
    assert.equal(await page.evaluate("document.getElementById('tones').value"), "None");
    for (const light of LIGHTS)
        close(await shown(page, "None", light), light.map(x => encode(Math.min(1, EXPOSURE * x))), 1, `None of ${light}`);
}));

test("Khronos Neutral is the specification: what is neither dark nor bright loses 0.04, and white stays white", () => withStudio(async page => {
    for (const light of [[0.3, 0.3, 0.3], [1, 0.5, 0.25], [0.2, 0.6, 0.9]])
        close(await shown(page, "Khronos Neutral", light), light.map(x => encode(EXPOSURE * x - 0.04)), 1, `Neutral of ${light}`);
    close(await shown(page, "Khronos Neutral", [3000, 3000, 3000]), [255, 255, 255], 1, "Neutral of white");
}));

test("AgX: 0.18 becomes one half of its curve, and light of any brightness fits", () => withStudio(async page => {
    const grey = 0.18 / EXPOSURE, middle = encode(0.5 ** 2.2);
    close(await shown(page, "AgX", [grey, grey, grey]), [middle, middle, middle], 1, "AgX of grey");
    const [red, green] = await shown(page, "AgX", [20, 0.2, 0.2]);
    assert(red > green + 20 && green > 80, `bright red loses its colour: ${red} ${green}`);
}));

test("Neutral and AgX agree with three.js", async () => {
    const file = path.join(root, "tests/npm/node_modules/three/src/renderers/shaders/ShaderChunk/tonemapping_pars_fragment.glsl.js");
    if (!fs.existsSync(file))
        return console.log("skip: three is not installed (npm ci --prefix tests/npm): tones were not compared");
    const { default: source } = await import(pathToFileURL(file));
    await withStudio(async page => {
        for (const [tones, name, tolerance] of [["Khronos Neutral", "NeutralToneMapping", 1], ["AgX", "AgXToneMapping", 3]]) { // whose curve is a fit there
            const wanted = await page.evaluate(byThree(source, name, LIGHTS));
            for (const [index, light] of LIGHTS.entries())
                close(await shown(page, tones, light), wanted[index], tolerance, `${tones} of ${light}`);
        }
        await change(page, pick("tones", "None"));
    });
});

// ---- Pictures ----

/** The picture of the program, as base64. */
function render(document, ...options) {
    const file = path.join(work, "rendered.png");
    execFileSync(program, ["render", document, ...options, "-o", file], { stdio: "pipe" });
    return fs.readFileSync(file).toString("base64");
}

/** Asserts that the mean difference of two pictures, from 0 to 255, is below a limit. */
async function compare(page, mine, theirs, limit, about) {
    const [difference, ...sizes] = await page.evaluate(DIFFERENCE(mine, theirs));
    console.log(`${about}: ${difference.toFixed(2)} of 255 ${sizes.join(" ")}`);
    assert(difference < limit, `${about}: ${difference} of 255 ${sizes}`);
}

/** Saves a picture; its name and its bytes, as base64. */
async function save(page, size, isTransparent) {
    const files = fs.mkdtempSync(path.join(work, "save-"));
    await browser.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: files });
    await page.evaluate(`document.getElementById("size").value = "${size}", document.getElementById("transparent").checked = ${isTransparent}, document.getElementById("save").click()`);
    await page.until("!document.getElementById('save').disabled");
    while (!fs.readdirSync(files).some(name => name.endsWith(".png")))
        await new Promise(resolve => setTimeout(resolve, 30));
    const [name] = fs.readdirSync(files);
    return [name, fs.readFileSync(path.join(files, name)).toString("base64")];
}

const hasRender = () => program || console.log("skip: mxgen-render is not built: pictures were not compared");

/** A surface that is drawn fast, in colours that show texture coordinates. */
const PAPER = `<materialx version="1.39"><ramp4 name="r" type="color3"><input name="valuetl" type="color3" value="1, 0, 0"/><input name="valuetr" type="color3" value="0, 1, 0"/>
    <input name="valuebl" type="color3" value="0, 0, 1"/><input name="valuebr" type="color3" value="1, 1, 1"/></ramp4><surface_unlit name="S" type="surfaceshader">
    <input name="emission_color" type="color3" nodename="r"/></surface_unlit><surfacematerial name="Paper" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/>
    </surfacematerial></materialx>`;

test("a saved picture is that of mxgen render, of any size, with and without a background", () => withStudio(async page => {
    await change(page, pick("shape", "ball"));
    const [name, transparent] = await save(page, 512, true);
    assert.equal(name, "Gold.png");
    await compile(page, type(page, PAPER));
    const [, opaque] = await save(page, 1024, false); // of several tiles
    await change(page, pick("shape", "sphere")); // the view draws on
    if (!hasRender())
        return;
    const paper = path.join(work, "paper.mtlx");
    fs.writeFileSync(paper, PAPER);
    await compare(page, transparent, render(example("gold.mtlx"), "-s", "512", "--background", "none"), 0.5, "transparent");
    await compare(page, opaque, render(paper, "-s", "1024"), 0.5, "opaque");
}));

// ---- Light ----

const maps = path.join(work, "maps");
fs.mkdirSync(maps);
if (writeMaps)
    execFileSync(writeMaps, [maps]);

/** The map of write_maps.cpp. */
function mapAt(x, y) {
    const up = 1 - (y + 0.5) / 128, isLamp = Math.abs(x - 60) < 12 && Math.abs(y - 50) < 6;
    return Math.abs(x - 150) < 2 && Math.abs(y - 30) < 2 ? [300, 200, 100] : [0.4 - 0.2 * up, isLamp ? 20 : 0.3, 0.1 + 0.6 * up];
}

test("maps of OpenImageIO: every compression, half and float, are read as they were written", () => {
    for (const name of fs.readdirSync(maps)) {
        const bytes = new Uint8Array(fs.readFileSync(path.join(maps, name)));
        if (name === "b44.exr") {
            assert.throws(() => readLight(name, bytes), /compression is unknown/);
            continue;
        }
        const { maps: { radiance: [{ width, height, pixels }] } } = readLight(name, bytes), tolerance = { "dwaa.exr": 0.05, "runs.hdr": 0.01 }[name] ?? 0.001;
        assert.deepEqual([width, height], [256, 128]);
        for (let y = 0; y < height; y += 3)
            for (let x = 0; x < width; x += 3) {
                const wanted = mapAt(x, y), scale = Math.max(...wanted);
                close([...pixels.subarray(4 * (y * width + x), 4 * (y * width + x) + 3)], wanted, tolerance * scale, `${name} at ${x}, ${y}`);
            }
    }
});

const ascii = text => new TextEncoder().encode(text);
const joined = (...parts) => Uint8Array.from(parts.flatMap(part => [...part]));

test("a .hdr without runs, and with runs of whole pixels", () => {
    const head = ascii("#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n"), red = [128, 0, 0, 129], blue = [0, 0, 64, 128];
    for (const rows of [[red, red, red, blue, blue, blue, blue, blue], [red, [1, 1, 1, 2], blue, blue, [1, 1, 1, 3]]]) {
        const { maps: { radiance: [{ pixels }] } } = readLight("x.hdr", joined(head, ...rows));
        assert.deepEqual([...pixels], [...[1, 1, 1].flatMap(() => [1, 0, 0, 1]), ...[1, 1, 1, 1, 1].flatMap(() => [0, 0, 0.25, 1])]);
    }
});

test("maps that are damaged, too large, or of another kind are told", () => {
    const head = size => ascii(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n${size}\n`);
    const faults = [
        ["x.hdr", ascii("no map"), /header has no end/], ["x.hdr", ascii("no map\n\n-Y 2 +X 2\n"), /does not begin with/],
        ["x.hdr", head("-Y 4 +X 4"), /ends after 0 of 4 rows/], ["x.hdr", head("-Y 60000 +X 60000"), /60000 × 60000 pixels; the page reads up to/],
        ["x.hdr", head("+X 4 -Y 4"), /rows from the top/], ["x.hdr", joined(head("-Y 1 +X 9"), [2, 2, 0, 9, 200, 1]), /pixels are damaged/],
        ["x.hdr", joined(head("-Y 1 +X 9"), [2, 2, 0, 9, 0]), /pixels are damaged/],
        ["x.hdr", ascii("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 2 +X 2\n"), /32-bit_rle_xyze/], ["x.exr", ascii("no map, but long enough"), /no picture of OpenEXR/],
    ];
    for (const [name, bytes, message] of faults)
        assert.throws(() => readLight(name, bytes), message, String(message));
    for (const name of fs.readdirSync(maps).filter(name => name.endsWith(".exr"))) // cut off anywhere
        for (const part of [0.1, 0.5, 0.9]) {
            const bytes = fs.readFileSync(path.join(maps, name));
            assert.throws(() => readLight(name, new Uint8Array(bytes.subarray(0, part * bytes.length))), Error, name);
        }
});

test("dropped light is that of mxgen render --environment", () => withStudio(async page => {
    await change(page, pick("shape", "ball"));
    const bad = [...ascii("#?RADIANCE\n\n-Y 4 +X 4\n")];
    await page.evaluate(drop([["bad.hdr", "image/vnd.radiance", bad]]));
    await page.until("/cannot use the environment 'bad.hdr': it ends after 0 of 4 rows/.test(document.getElementById('messages').textContent)");
    assert.equal(await page.evaluate("document.getElementById('light').value"), "Sky");
    if (!hasRender())
        return;
    for (const name of ["runs.hdr", "piz_half.exr"]) {
        const file = path.join(maps, name);
        await compile(page, drop([[name, "", [...fs.readFileSync(file)]]]));
        assert.equal(await page.evaluate("document.getElementById('light').value"), name);
        assert.equal(await page.evaluate("document.getElementById('messages').textContent"), "No errors, no warnings.");
        const [, mine] = await save(page, 512, false);
        await compare(page, mine, render(example("gold.mtlx"), "--environment", file), 0.5, name);
    }
    await change(page, pick("light", "Sky"));
    const [, mine] = await save(page, 512, false);
    await compare(page, mine, render(example("gold.mtlx")), 0.5, "the sky again");
}));

// ---- Meshes ----

/** Corners of a torus around z: position, normal, texture coordinates, by places on its grid. */
const ACROSS = 24, AROUND = 12;
const torus = Array.from({ length: (ACROSS + 1) * (AROUND + 1) }, (_, i) => {
    const s = i % (ACROSS + 1) / ACROSS, t = Math.floor(i / (ACROSS + 1)) / AROUND, a = 2 * Math.PI * s, b = 2 * Math.PI * t, n = [Math.cos(a) * Math.cos(b), Math.sin(a) * Math.cos(b), Math.sin(b)];
    return { position: [2 * Math.cos(a) + 0.8 * n[0], 2 * Math.sin(a) + 0.8 * n[1], 0.8 * n[2]], normal: n, texcoord: [2 * s, t] };
});
const quads = Array.from({ length: ACROSS * AROUND }, (_, i) => {
    const corner = i % ACROSS + Math.floor(i / ACROSS) * (ACROSS + 1), above = corner + ACROSS + 1;
    return [corner, corner + 1, above + 1, above];
});

/** `parts` are of "vt" and "vn". */
function objOf(parts) {
    const lines = torus.flatMap(({ position, normal, texcoord }) => [`v ${position.join(" ")}`, ...(parts.includes("vt") ? [`vt ${texcoord.join(" ")}`] : []), ...(parts.includes("vn") ? [`vn ${normal.join(" ")}`] : [])]);
    const corner = i => `${i}/${parts.includes("vt") ? i : ""}/${parts.includes("vn") ? i : ""}`.replace(/\/+$/, "");
    return ["# a torus", "o torus", ...lines, ...quads.map((quad, k) => `f ${quad.map(i => corner(k % 2 ? i + 1 : i - torus.length)).join(" ")}`), ""].join("\n");
}

/** With `isShort`, texture coordinates are normalized integers. */
function glbOf(change = () => {}, isShort = false) {
    const indices = quads.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]), views = [], parts = [];
    const add = (array, stride) => {
        views.push({ buffer: 0, byteOffset: parts.reduce((sum, part) => sum + part.length, 0), byteLength: array.byteLength, ...stride });
        parts.push(new Uint8Array(array.buffer));
        return views.length - 1;
    };
    const mixed = Float32Array.from(torus.flatMap(({ position, normal }) => [...position, ...normal])), texcoords = torus.flatMap(({ texcoord: [s, t] }) => [s / 2, 1 - t]);
    const count = torus.length, corners = add(mixed, { byteStride: 24 }), coordinates = add(isShort ? Uint16Array.from(texcoords, x => Math.round(65535 * x)) : Float32Array.from(texcoords), {}), triangles = add(Uint16Array.from(indices), {});
    const xs = c => torus.map(({ position }) => position[c]);
    const gltf = {
        asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], bufferViews: views, buffers: [{ byteLength: parts.reduce((sum, part) => sum + part.length, 0) }],
        nodes: [{ rotation: [0.5, 0.5, 0.5, 0.5], children: [1], scale: [1, 2, 1] }, { mesh: 0, translation: [3, 1, 0], scale: [-1, 1, 1] }],
        meshes: [{ primitives: [{ attributes: { POSITION: 0, NORMAL: 1, TEXCOORD_0: 2 }, indices: 3 }] }],
        accessors: [{ bufferView: corners, componentType: 5126, count, type: "VEC3", min: [0, 1, 2].map(c => Math.min(...xs(c))), max: [0, 1, 2].map(c => Math.max(...xs(c))) }, { bufferView: corners, byteOffset: 12, componentType: 5126, count, type: "VEC3" },
            { bufferView: coordinates, componentType: isShort ? 5123 : 5126, normalized: isShort, count, type: "VEC2" }, { bufferView: triangles, componentType: 5123, count: indices.length, type: "SCALAR" }],
    };
    change(gltf);
    const json = ascii(JSON.stringify(gltf)), text = joined(json, new Uint8Array(-json.length & 3).fill(32)), binary = joined(...parts);
    const word = x => [x & 255, x >> 8 & 255, x >> 16 & 255, x >>> 24], chunk = (kind, bytes) => joined(word(bytes.length), word(kind), bytes);
    const chunks = joined(chunk(0x4e4f534a, text), chunk(0x004e4942, joined(binary, new Uint8Array(-binary.length & 3))));
    return joined(word(0x46546c67), word(2), word(chunks.length + 12), chunks);
}

/** The length of the file stands in its header. */
function resized(bytes) {
    const copy = Uint8Array.from(bytes);
    new DataView(copy.buffer).setUint32(8, copy.length, true);
    return copy;
}

test("meshes that are damaged, too large, or of another kind are told", () => {
    const faults = [
        ["x.obj", ascii("nothing"), /no triangles/], ["x.obj", ascii("v 0 0 0\nf 1 2 3"), /line 2 has a corner '2' that is not there/], ["x.obj", ascii("v 0 zero 0"), /line 1 has no 3 numbers/],
        ["x.obj", ascii("v 0 0 0\nf 1 1 1"), /no area/], ["x.obj", ascii(`v 0 0 0\nv 1 0 0\nv 0 1 0\n${"f 1 2 3\n".repeat(500_001)}`), /more than 500000 triangles/],
        ["x.glb", ascii("glTF, but no mesh at all"), /no binary glTF 2.0/], ["x.glb", ascii("glTF"), /no binary glTF 2.0/],
        ["x.glb", glbOf().subarray(0, 3000), /has 3000 bytes, and its header says \d+/], ["x.glb", joined(glbOf(), [0, 0, 0, 0]), /has \d+ bytes, and its header says \d+/],
        ["x.glb", resized(glbOf().subarray(0, 3000)), /last chunk is longer/], ["x.glb", resized(joined(glbOf(), [0, 0, 0, 0])), /last chunk is longer/],
        ["x.glb", glbOf(gltf => { gltf.accessors[3].count = 1e6; }), /behind its end/], ["x.glb", glbOf(gltf => { gltf.accessors[0].count = 3; }), /corners that are not there/],
        ["x.glb", glbOf(gltf => { gltf.nodes[1].children = [0]; }), /nested more than 100 deep/], ["x.glb", glbOf(gltf => { gltf.buffers[0].uri = "x.bin"; }), /in another file/],
        ["x.glb", glbOf(gltf => { gltf.accessors[0].sparse = {}; }), /sparse or compressed/], ["x.glb", glbOf(gltf => { gltf.meshes[0].primitives[0].extensions = { KHR_draco_mesh_compression: {} }; }), /Draco/],
        ["x.glb", glbOf(gltf => { gltf.meshes[0].primitives[0].mode = 1; }), /no triangles/],
        ["x.glb", glbOf(gltf => { gltf.extensionsRequired = ["KHR_mesh_quantization", "EXT_foo"]; }), /requires the extension 'EXT_foo'/],
    ];
    for (const [name, bytes, message] of faults)
        assert.throws(() => readMesh(name, bytes), message, String(message));
});

test("a mesh fills the view, and has unit normals and tangents at right angles", () => {
    for (const [name, bytes, told] of [["x.obj", ascii(objOf("vt vn")), 0], ["x.obj", ascii(objOf("vt")), 0], ["x.obj", ascii(objOf("")), 1], ["x.glb", glbOf(), 0]]) {
        const { mesh: { position, normal, tangent, texcoord, indices, count }, notes } = readMesh(name, bytes), at = (values, i) => [...values.subarray(3 * i, 3 * i + 3)];
        assert.equal(notes.length, told);
        assert.equal(indices.length, 6 * quads.length);
        assert.deepEqual([position.length, normal.length, tangent.length, texcoord.length], [3, 3, 3, 2].map(size => size * count));
        let most = 0;
        for (let i = 0; i < count; i++) {
            const [n, t] = [at(normal, i), at(tangent, i)];
            most = Math.max(most, Math.hypot(...at(position, i)));
            close([Math.hypot(...n), Math.hypot(...t), n[0] * t[0] + n[1] * t[1] + n[2] * t[2]], [1, 1, 0], 1e-5, `${name} corner ${i}`);
        }
        close([most], [1], 1e-5, name);
    }
});

test("texture coordinates of glTF may be integers", () => {
    const [{ mesh: { texcoord: one } }, { mesh: { texcoord: other } }] = [false, true].map(isShort => readMesh("x.glb", glbOf(() => {}, isShort)));
    close([...other], [...one], 1e-5, "texcoord");
    assert(Math.max(...one) > 0.99);
});

test("a part without texture coordinates leaves those of others", () => {
    const quad = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    const bare = glbOf(gltf => { gltf.meshes[0].primitives.push({ attributes: { POSITION: 0 }, indices: 3 }); });
    for (const [name, alone, both] of [["x.obj", ascii(quad), ascii(`${quad}v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nf 5 6 7\n`)], ["x.glb", glbOf(), bare]]) {
        const { mesh: { texcoord: one } } = readMesh(name, alone), { mesh: { texcoord: two, normal, indices, position }, notes } = readMesh(name, both);
        assert.deepEqual(notes, ["has parts with no texture coordinates; they were made"]);
        assert.deepEqual([...two.subarray(0, one.length)], [...one], name);
        const [a, b, c] = [...indices.subarray(-3)], across = [0, 1, 2].map(k => [b, c].map(i => position[3 * i + k] - position[3 * a + k]));
        for (let k = 0; k < 2 && name === "x.glb"; k++) // without normals glTF is flat
            close([across.reduce((sum, edge, axis) => sum + edge[k] * normal[3 * a + axis], 0)], [0], 1e-5, "the normal of a triangle");
    }
});

/** Colours that show texture coordinates. */
const RAMP = `<materialx version="1.39"><ramp4 name="r" type="color3"><input name="valuetl" type="color3" value="1, 0, 0"/><input name="valuetr" type="color3" value="0, 1, 0"/>
    <input name="valuebl" type="color3" value="0, 0, 1"/><input name="valuebr" type="color3" value="1, 1, 1"/></ramp4><standard_surface name="S" type="surfaceshader">
    <input name="base_color" type="color3" nodename="r"/><input name="specular_anisotropy" type="float" value="0.7"/><input name="metalness" type="float" value="0.5"/></standard_surface>
    <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>`;

test("a dropped mesh is that of mxgen render --mesh", () => withStudio(async page => {
    const ramp = path.join(work, "ramp.mtlx");
    fs.writeFileSync(ramp, RAMP);
    await page.evaluate(drop([["bad.obj", "", "v 0 0 0"]]));
    await page.until("/cannot use the mesh 'bad.obj': it has no triangles/.test(document.getElementById('messages').textContent)");
    assert.equal(await page.evaluate("document.getElementById('shape').value"), "plane");
    await compile(page, type(page, RAMP));
    for (const [name, content, message] of [["torus.obj", ascii(objOf("vt vn")), /^No errors/], ["bare.obj", ascii(objOf("")), /the mesh 'bare.obj' has no texture coordinates; they were made/], ["torus.glb", glbOf(), /^No errors/]]) {
        const file = path.join(work, name);
        fs.writeFileSync(file, content);
        await compile(page, drop([[name, "", [...content]]]));
        assert.equal(await page.evaluate("document.getElementById('shape').value"), name);
        assert.match(await page.evaluate("document.getElementById('messages').textContent"), message);
        if (!hasRender())
            continue;
        const [, mine] = await save(page, 512, false);
        await compare(page, mine, render(ramp, "-m", file), name === "bare.obj" ? 1 : 0.5, name); // normals that Assimp makes weigh triangles otherwise
    }
    if (!hasRender())
        return;
    await compile(page, type(page, fs.readFileSync(example("displaced.mtlx"), "utf8")));
    const [, mine] = await save(page, 512, false);
    await compare(page, mine, render(example("displaced.mtlx"), "-m", path.join(work, "torus.glb")), 1.5, "displaced");
}));

// ---- Comparison ----

/** The mean colours of parts of the canvas left and right of its middle. */
const sides = page => page.evaluate(`(() => {
    const canvas = document.getElementById("canvas"), copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
    copy.drawImage(canvas, 0, 0);
    return [-30, 10].map(x => {
        const { data } = copy.getImageData(canvas.width / 2 + x, canvas.height / 2 - 20, 20, 20);
        return [0, 1, 2].map(c => data.reduce((sum, value, i) => i % 4 === c ? sum + value : sum, 0) / 400);
    });
})()`);
const isRed = ([r, , b]) => r > 100 && b < 90, isBlue = ([r, , b]) => b > 100 && r < 90;

test("a pinned picture stays left of the edge, with its values", () => withStudio(async page => {
    const onPage = id => `document.getElementById("${id}")`, key = name => change(page, `${onPage("edge")}.dispatchEvent(new KeyboardEvent("keydown", { key: "${name}", cancelable: true }))`);
    await compile(page, type(page, RED));
    assert.equal(await page.evaluate(`${onPage("edge")}.hidden`), true);
    await change(page, `${onPage("pin")}.click()`);
    const box = "document.querySelector('[data-path=\"SR/base_color\"] input[type=color]')";
    await change(page, `${box}.value = "#0000ff", ${box}.dispatchEvent(new Event("input", { bubbles: true }))`); // the same shader
    const [left, right] = await sides(page);
    assert(isRed(left) && isBlue(right), `${left} | ${right}`);
    await compile(page, type(page, lamp([0, 0, 0.9]))); // another shader
    assert.deepEqual((await sides(page)).map(isRed), [true, false]);
    await key("End");
    assert.equal(await page.evaluate(`${onPage("edge")}.getAttribute("aria-valuenow")`), "100");
    assert.deepEqual((await sides(page)).map(isRed), [true, true]);
    await key("Home");
    assert.deepEqual((await sides(page)).map(isBlue), [true, true]);
    await page.evaluate(`window.lost = ${onPage("canvas")}.getContext("webgl2").getExtension("WEBGL_lose_context"), lost.loseContext()`);
    await page.until(`${onPage("canvas")}.getContext("webgl2").isContextLost()`);
    await page.evaluate("lost.restoreContext()");
    await page.until(`!${onPage("canvas")}.getContext("webgl2").isContextLost()`);
    await key("End");
    assert.deepEqual((await sides(page)).map(isRed), [true, true]);
    await change(page, `${onPage("pin")}.click()`);
    assert.deepEqual((await sides(page)).map(isBlue), [true, true]);
    page.complaints = page.complaints.filter(text => !/context/i.test(text));
}));

/** Layers of a diffuse base, which one slab can only blend. */
const LAYERS = `<materialx version="1.39"><oren_nayar_diffuse_bsdf name="d" type="BSDF"><input name="color" type="color3" value="0.8, 0.1, 0.1"/></oren_nayar_diffuse_bsdf>
    <sheen_bsdf name="s" type="BSDF"><input name="color" type="color3" value="0.2, 0.3, 1"/></sheen_bsdf><layer name="l" type="BSDF"><input name="top" type="BSDF" nodename="s"/>
    <input name="base" type="BSDF" nodename="d"/></layer><dielectric_bsdf name="c" type="BSDF"/><layer name="k" type="BSDF"><input name="top" type="BSDF" nodename="c"/>
    <input name="base" type="BSDF" nodename="l"/></layer><surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="k"/></surface>
    <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>`;

test("two budgets of one material", () => withStudio(async page => {
    await compile(page, type(page, LAYERS));
    await change(page, "document.getElementById('pin').click()");
    const [left, right] = await sides(page);
    close(left, right, 12, "the same on both sides");
    await compile(page, pick("slabs", "1"));
    const [pinned, one] = await sides(page);
    close(pinned, left, 1, "the pinned picture");
    assert(one[2] < right[2] - 10, `one slab has less sheen: ${one} instead of ${right}`);
    await compile(page, pick("slabs", ""));
    close((await sides(page))[1], right, 1, "back");
    await compile(page, pick("quality", "draft"));
    assert.match(await page.evaluate("document.getElementById('messages').textContent"), /^No errors/);
}));

try {
    await run("web-studio");
} finally {
    await browser.close();
    fs.rmSync(work, { recursive: true });
}
