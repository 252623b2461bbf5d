// SPDX-License-Identifier: Apache-2.0
// mxgen/three in Chromium. Arguments: webgl, webgpu or fallback, the folder of the package, Chromium, the root of the project, the program, esbuild.

import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";

import { run, test } from "../js/harness.mjs";
import { Browser, WEBGPU } from "../web/browser.mjs";
import { bundle, difference, pixel, render, serve, writeSky } from "./server.mjs";

const [backend, folder, chromium, root, program, esbuild] = process.argv.slice(2);
const { kit, example, options, pictures, expected } = {
    webgl: { kit: "webgl.js", example: "three.html", options: [], pictures: /./ },
    webgpu: { kit: "webgpu.js", example: "three_webgpu.html", options: WEBGPU, pictures: /./ },
    fallback: { kit: "webgpu.js", example: "three_webgpu.html", options: [], pictures: /gold|textured/, expected: /No available adapters|WebGPU is not available/ },
}[backend];
const complaintsOf = page => page.complaints.filter(text => !expected?.test(text));
const work = fs.mkdtempSync(path.join(os.tmpdir(), "mxgen-three-"));

const DOCUMENTS = {
    "documents/main.mtlx": `<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href="parts/shader.mtlx"/>
        <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial></materialx>`,
    "documents/parts/shader.mtlx": `<materialx version="1.39"><standard_surface name="SR" type="surfaceshader">
        <input name="base_color" type="color3" value="0, 0, 1"/><input name="specular" type="float" value="0"/></standard_surface></materialx>`,
    "documents/broken.mtlx": "<materialx version='1.39'><standard_surface name='S' type='surfaceshader'><input name='base' type='float' nodename='none'/></standard_surface></materialx>",
};
const shining = (name, image) => `${image}<standard_surface name="SR_${name}" type="surfaceshader"><input name="base" type="float" value="0"/>
    <input name="specular" type="float" value="0"/><input name="emission" type="float" value="1"/><input name="emission_color" type="color3" nodename="${name}_image"/>
    </standard_surface><surfacematerial name="${name}" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR_${name}"/></surfacematerial>`;
DOCUMENTS["documents/images.mtlx"] = `<materialx version="1.39">
    <geominfo name="all" geom="/"><geomprop name="udimset" type="stringarray" value="1001, 1002, 1011, 1012"/></geominfo>
    ${shining("tiled", `<image name="tiled_image" type="color3"><input name="file" type="filename" value="tile.&lt;UDIM&gt;.png"/>
        <input name="default" type="color3" value="1, 0, 1"/></image>`)}
    ${shining("repeated", `<image name="repeated_image" type="color3"><input name="file" type="filename" value="pair.hdr"/>
        <input name="filtertype" type="string" value="closest"/></image>`)}</materialx>`;

let page;
const draw = (name, argument) => page.evaluate(`draws.${name}(${JSON.stringify(argument)})`);

// Measured: 0.8, 0.5, 1.4, 0.1, 1.5, 1.6, 3.1, 4.8, 5.3. The rest is that of three's map of the environment, which is filtered for round
// highlights, and for a view along the normal: broad and anisotropic highlights differ most.
for (const [name, limit] of Object.entries({ gold: 1.2, marble: 0.8, textured: 2, custom_expression: 0.3, frosted: 2, slabs: 2, haze: 4, shaderx: 6, old_copper: 6.5 }).filter(([name]) => pictures.test(name)))
    test(`${name} looks as in mxgen render`, async () => {
        const ours = path.join(work, `${name}.three.png`), theirs = path.join(work, `${name}.png`);
        fs.writeFileSync(ours, Buffer.from(await draw("example", `${name}.mtlx`)));
        render(program, path.join(work, "examples", `${name}.mtlx`), path.join(work, "sky.hdr"), theirs);
        const { mean, alone } = await difference(page, ours, theirs);
        console.log(`${name}: ${mean.toFixed(2)} of 255`);
        assert(alone < 0.02 && mean < limit, `${mean} of 255, ${alone} alone`);
    });

// ---- What three applies ----

for (const kind of ["directional", "point", "spot", "ambient", "hemisphere", "probe", "environment", "transparent"])
    test(`${kind}: a matte surface is lit as three's own`, async () => {
        const { ours, theirs, difference } = await draw("standard", kind);
        assert(ours[0] > 40 && difference < 0.01, `${ours} ${theirs} ${difference}`);
    });

test("light without coverage is added", async () => assert.deepEqual(await draw("glow"), [255, 255, 0, 0]));

test("light moves with its light", async () => {
    const [leftLeft, leftRight, rightLeft, rightRight] = (await draw("lightMoves")).map(([red]) => red);
    assert(leftLeft > 100 && leftRight < 20 && rightLeft < 20 && rightRight > 100, `${[leftLeft, leftRight, rightLeft, rightRight]}`);
});

test("a shadow darkens what receives it", async () => {
    const [inside, outside, unreceived] = (await draw("shadow")).map(([red]) => red);
    assert(inside < 5 && outside > 100 && unreceived > 100, `${[inside, outside, unreceived]}`);
});

test("fog covers what is opaque, and as much of what is not", async () => {
    const [opaque, [red, green, blue, alpha]] = await draw("fog");
    assert.deepEqual(opaque, [0, 64, 0, 255]);
    assert(red === 0 && blue === 0 && Math.abs(green - 64) < 3 && Math.abs(alpha - 128) < 3, `${[red, green, blue, alpha]}`);
});

test("tone mapping applies", async () => {
    const [plain, linear, agx] = await draw("toneMapping");
    assert(linear[0] < plain[0] - 40 && agx.join() !== linear.join(), `${plain} ${linear} ${agx}`);
});

test("instances, batches, morphs and bones move the mesh", async () => {
    for (const [name, [there, here]] of Object.entries(await draw("moves")))
        assert.deepEqual([name, there, here], [name, 255, 0]);
});

test("an edit of a uniform keeps the program, another edit makes one", async () => {
    const [first, edited, set, faded, noisy, fault, last] = await draw("edit");
    assert(first.color[0] > first.color[2] && edited.color[2] > edited.color[0] + 50 && set.color[1] > set.color[2] + 50, `${first.color} ${edited.color} ${set.color}`);
    for (const step of [edited, set, faded])
        assert.equal(step.program, first.program);
    assert(faded.transparent && faded.color[3] > 120 && faded.color[3] < 135, `${faded.color}`);
    assert.notEqual(noisy.program, first.program);
    assert.match(fault, /Error$/);
    assert.deepEqual(last, noisy); // a document without the element changes nothing
});

test("materials share programs, not values", async () => {
    const { colors: [one, other, clone], programs } = await draw("share");
    assert.equal(new Set(programs).size, 1);
    assert(one[0] > one[1] && other[2] > other[1] + 50 && clone[1] > clone[2] + 50, `${one} ${other} ${clone}`);
});

test("documents read attributes and spaces of the geometry", async () => {
    const place = [0.242, 0.117], expected = {
        color: [1, 0.5, 0], noColor: [1, 1, 1], uv1: [0.25, 0.75, 0], wear: [0.2, 0.4, 0.6], noWear: [0.5, 0.6, 0.7], normalWorld: [0, 0, 1],
        uvProperty: [0.637, 0.564, 0], stOfUsd: [0.25, 0.75, 0], twoTypes: [0.04, 0.08, 0.12],
        positionWorld: [...place, 0.5], positionObject: [...place, 0], instanced: [...place, 0.5], transformed: [0.1, 0.2, 0.8], transformedInstance: [0.1, 0.2, 0.8],
        tangentWorld: [1, 0, 0], bitangentWorld: [0, 1, 0], tangentAttribute: [0, 1, 0], bitangentAttribute: [1, 0, 0],
    };
    if (backend !== "webgl")
        expected.noCount = [1, 1, 1];
    const found = await draw("streams");
    assert.deepEqual(Object.keys(found).sort(), Object.keys(expected).sort());
    for (const [name, values] of Object.entries(expected))
        assert(values.every((x, i) => Math.abs(x - found[name][i]) < 0.01), `${name}: ${found[name]}`);
});

test("tiles are an array, and other loaders read other formats", async () => {
    const found = await draw("images");
    assert.deepEqual(found, { tiled: ["100", "010", "001", "110", "101"], repeated: ["010", "100", "010", "100", "100"],
                              texel: [true, 0.5, 0.25, 0.25, 1] });
});

test("the loader", async () => {
    const found = await draw("loader");
    assert.deepEqual(found.names, ["M"]);
    assert(found.color[2] > found.color[0] + 50);
    assert.match(found.missing, /404/);
    assert.match(found.broken, /^DocumentError: .*broken\.mtlx:1:\d+: error: .*none/s);
    assert.match(found.noCompiler, /setCompiler/);
    assert.match(found.option, /^ArgumentError: .*role/);
    assert(found.side);
    page.complaints = page.complaints.filter(text => !/404/.test(text));
});

test("an orthographic camera looks in one direction", async () => {
    const [left, right, perspective] = await draw("orthographic");
    assert.deepEqual(left.slice(0, 3), right.slice(0, 3));
    assert(right[0] < 5 && perspective[0] > 60, `${right} ${perspective}`);
});

test("a map of the environment of a material", async () => {
    const [own, scene] = await draw("envMap");
    assert(own[0] > 20);
    assert.deepEqual(own, scene);
});

if (backend !== "webgl") {
    test("nodes of three", async () => {
        const { none, outputNode, maskNode, lightsNode, positionNode } = await draw("nodes");
        assert(none[0] > none[2] + 50 && outputNode[2] > 200 && lightsNode[0] < 5, `${none} ${outputNode} ${lightsNode}`);
        assert.deepEqual([none[3], maskNode[3], lightsNode[3], positionNode[3]], [255, 0, 255, 0]);
    });

    test("lights of add-ons shine as three's own", async () => {
        const { plain, ...others } = await draw("lightings");
        assert(plain[0] > 40, `${plain}`);
        assert.deepEqual(others, { clustered: plain, dynamic: plain });
    });

    test("WebGLRenderer tells which material it needs", async () => assert.match(await draw("misuse"), /for WebGLRenderer there is MaterialXMaterial/));

    test("three draws by WebGPU, or without it by WebGL 2", async () => assert.equal(await draw("isWebGpu"), backend === "webgpu"));
}

test("the example, without a bundler", async () => {
    const page = await browser.open(`${server.address}/examples/${example}`, { width: 400, height: 300 });
    await page.until("document.body.dataset.drawn");
    const middle = async () => {
        await page.screenshot(path.join(work, "example.png"));
        return pixel(page, path.join(work, "example.png"), 200, 150);
    };
    const gold = await middle();
    await page.evaluate("document.getElementById('color').value = '#0000ff', document.getElementById('color').dispatchEvent(new Event('input'))");
    const blue = await middle();
    assert.deepEqual(complaintsOf(page), []);
    assert(gold[0] > gold[2] + 30 && blue[2] > blue[0] + 30, `${gold} ${blue}`);
    await page.close();
});

bundle(work, { page: path.join(root, "tests/three/page.js"), root, folder, esbuild, aliases: { kit: path.join(root, "tests/three", kit) } });
writeSky(path.join(work, "sky.hdr"));
const browser = new Browser(chromium, options), server = await serve([work, root], DOCUMENTS);
try {
    page = await browser.open(`${server.address}/page.html`);
    await page.until("window.draws");
    fs.cpSync(path.join(root, "examples"), path.join(work, "examples"), { recursive: true });
    for (const [name, bytes] of Object.entries(await draw("textures"))) {
        fs.mkdirSync(path.dirname(path.join(work, name)), { recursive: true });
        fs.writeFileSync(path.join(work, name), Buffer.from(bytes));
    }
    // A red texel and a green one, of 128/256 times 2 to the power of 1
    fs.writeFileSync(path.join(work, "documents/pair.hdr"), Buffer.concat([Buffer.from("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"),
                                                                          Buffer.from([128, 0, 0, 129, 0, 128, 0, 129])]));
    test("the console has no complaints", () => assert.deepEqual(complaintsOf(page), []));
    await run(`three ${backend}`);
} finally {
    await browser.close();
    server.close();
}
if (!process.env.KEEP)
    fs.rmSync(work, { recursive: true });
else
    console.log(work);
