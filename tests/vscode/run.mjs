// SPDX-License-Identifier: Apache-2.0
// The extension in a real VS Code: what its users do. Arguments: a folder with the npm package, or a built extension; the
// root of the project, Chromium, the program. With KEEP the screenshots stay.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";

import { run, test } from "../js/harness.mjs";
import { Browser } from "../web/browser.mjs";
import { Server } from "./editor.mjs";

const [library, root, chromium, program] = process.argv.slice(2).map(name => path.resolve(name)), code = path.join(root, "tests/vscode/node_modules/code-server/lib/vscode");
for (const [isThere, what] of [[fs.existsSync(path.join(root, "editors/vscode/node_modules")), "what the extension is built with"],
    [fs.existsSync(path.join(code, "node_modules")), "the server of VS Code, npm's code-server"], [parseInt(process.versions.node) >= 20, "Node 20, which that server needs"]])
    if (!isThere) {
        console.log(`skip: ${what} is not installed; script/test --suite reach installs packages of npm`);
        process.exit(77);
    }
const work = fs.mkdtempSync(path.join(os.tmpdir(), "mxgen-vscode-")), folder = path.join(work, "materials"), file = path.join(folder, "marble.mtlx");
const original = fs.readFileSync(path.join(root, "examples/marble.mtlx"), "utf8"), size = { width: 1400, height: 900 };
const settings = { "mxgen.path": program, "workbench.startupEditor": "none", "files.autoSave": "afterDelay", "files.autoSaveDelay": 100, "editor.minimap.enabled": false,
    "workbench.tips.enabled": false };

const isBuilt = library.endsWith(".vsix"), extension = isBuilt ? library : path.join(work, "mxgen.vsix");
if (!isBuilt)
    execFileSync(process.execPath, [path.join(root, "editors/vscode/build.mjs"), library, path.join(work, "extension"), extension], { stdio: ["ignore", "ignore", "pipe"] });
fs.mkdirSync(folder);
fs.writeFileSync(file, original);
const browser = new Browser(chromium), server = new Server(code, extension, work);

/** A window with the preview of the document, and its whole picture. */
async function openPreview(changes) {
    server.settings = { ...settings, ...changes };
    const editor = await server.open(browser, folder, "marble.mtlx", size);
    await editor.press("document.querySelector('.editor-actions .codicon-open-preview')");
    await editor.untilView("document.body.dataset.state === 'done'");
    return editor;
}

const shot = (editor, name) => editor.screenshot(path.join(work, `${name}.png`));
const shows = name => `document.getElementById('element').options[0].text === 'At the cursor: ${name}' && document.body.dataset.whole === 'true'`;
const nodeLibrary = path.join(work, "library");
const TWO_WARNINGS = "(text => /Warnings: 2/.test(text) && !/Errors/.test(text))(document.getElementById('status.problems').outerHTML)"; // nothing uses the two nodes
let editor, extended; // the text with nodes of a library and of an included file

/** Puts the cursor into a line, until the preview shows an element: the text may move while it is clicked. */
async function moveTo(line, name) {
    for (let i = 0; i < 20; i++) {
        await editor.pressLine(line);
        for (let k = 0; k < 20; k++, await new Promise(resolve => setTimeout(resolve, 100)))
            if (await editor.view(shows(name)))
                return;
    }
    throw new Error(`the preview does not show ${name}`);
}

const saved = async (editor, isRight) => {
    for (let i = 0; i < 100 && !isRight(fs.readFileSync(file, "utf8")); i++)
        await new Promise(resolve => setTimeout(resolve, 50));
    return fs.readFileSync(file, "utf8");
};

/** The mean colour of a part of the picture around its centre, from 0 to 255. */
const MEAN = `(() => {
    const canvas = document.getElementById("canvas"), copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
    copy.drawImage(canvas, 0, 0);
    const size = 40, { data } = copy.getImageData((canvas.width - size) / 2, (canvas.height - size) / 2, size, size);
    return [0, 1, 2].map(c => data.reduce((sum, x, i) => i % 4 === c ? sum + x : sum, 0) / (size * size));
})()`;

test("the preview shows the material", async () => {
    editor = await openPreview({ "workbench.colorTheme": "Default Dark Modern" });
    await editor.untilView(shows("Marble"));
    assert((await editor.view(MEAN)).every(x => x > 60));
    assert.equal(await editor.view("document.getElementById('status').textContent"), "Marble · 2 closures");
    await editor.until("document.querySelector('.colorpicker-color-decoration')"); // by the language server
    await shot(editor, "dark");
});

test("a slider writes one attribute, and undo takes it back", async () => {
    const slider = "document.querySelector('[data-path=\"NG_marble/scale\"] input[type=range]')";
    await editor.view(`(slider => { slider.value = 12; slider.dispatchEvent(new Event("input", { bubbles: true })); slider.dispatchEvent(new Event("change", { bubbles: true })); })(${slider})`);
    const text = await saved(editor, one => one !== original), value = /name="scale" type="float" value="([^"]*)"/.exec(text)[1];
    assert(Math.abs(Number(value) - 12) < 0.1, value);
    assert.equal(text.replace(`name="scale" type="float" value="${value}"`, 'name="scale" type="float" value="5"'), original);
    // An input that the document does not have
    const coat = "document.querySelector('[data-path=\"SR_marble/metalness\"] input[type=range]')";
    await editor.view(`(slider => { slider.value = 1; slider.dispatchEvent(new Event("change", { bubbles: true })); })(${coat})`);
    const added = await saved(editor, one => one.includes("metalness"));
    assert.equal(added.replace(/\n *<input name="metalness" type="float" value="1" \/>/, ""), text);
    await editor.pressLine("The veins are");
    for (let i = 0; i < 2; i++)
        await editor.key("z", "KeyZ", 90, 2);
    assert.equal(await saved(editor, one => one === original), original);
});

test("the picture follows the cursor", async () => {
    await editor.pressLine("<fractal3d");
    await editor.untilView(shows("NG_marble/noise"));
    assert.deepEqual(await editor.view("[...document.querySelectorAll('#inputs label[data-path]')].map(label => label.dataset.path).slice(0, 1)"), ["NG_marble/noise/amplitude"]);
    await shot(editor, "node");
    await editor.view("document.getElementById('pin').click()");
    await editor.pressLine("<sin");
    await editor.untilView("document.getElementById('element').value === 'NG_marble/noise'");
    await editor.view("document.getElementById('pin').click()");
    await editor.untilView(shows("NG_marble/wave"));
});

test("the graph follows the cursor, and leads to the text", async () => {
    await editor.view("document.querySelector('[data-tab=graph]').click()");
    await editor.untilView("document.querySelector('.card.current .name')?.textContent === 'wave'");
    assert.equal(await editor.view("document.querySelectorAll('.card').length"), original.match(/<(?!\?|!|\/|input|materialx|output)\w+ /g).length);
    await shot(editor, "graph");
    await editor.view("[...document.querySelectorAll('.card')].find(card => card.querySelector('.name').textContent === 'bent').dispatchEvent(new MouseEvent('click'))");
    const line = original.slice(0, original.indexOf('name="bent"')).split("\n").length;
    await editor.until(`document.querySelector('.statusbar').textContent.includes('Ln ${line},')`);
    await editor.untilView(shows("NG_marble/bent"));
});

test("lines of the shader lead to nodes, and nodes to lines", async () => {
    await editor.view("document.querySelector('[data-tab=shader]').click()");
    await editor.view("(select => { select.value = 'Marble'; select.dispatchEvent(new Event('change')); })(document.getElementById('element'))");
    await editor.view("(select => { select.value = 'hlsl'; select.dispatchEvent(new Event('change')); })(document.getElementById('target'))");
    await editor.untilView("document.getElementById('shader').textContent.includes('cbuffer')");
    await editor.pressLine('name="scaled"');
    await editor.untilView("document.querySelector('#shader .current')?.title === 'NG_marble/scaled, line 11'");
    await shot(editor, "shader");
    await editor.view("[...document.querySelectorAll('#shader .linked')].find(line => line.title.startsWith('SR_marble,')).click()");
    const line = original.slice(0, original.indexOf('name="SR_marble"')).split("\n").length;
    await editor.until(`document.querySelector('.statusbar').textContent.includes('Ln ${line},')`);
    await editor.view("document.getElementById('open-shader').click()");
    await editor.until("[...document.querySelectorAll('.tab')].some(tab => tab.textContent.includes('Marble.ps.hlsl'))");
    await shot(editor, "document");
});

test("libraries of the settings, included files and their textures", async () => {
    await editor.close();
    const added = `  <studio_tint name="tint" type="color3"/>
  <xi:include href="parts/part.mtlx" xmlns:xi="http://www.w3.org/2001/XInclude"/>
  <multiply name="bright" type="color3"><input name="in1" type="color3" nodename="picture"/><input name="in2" type="color3" value="1, 1, 1"/></multiply>
`;
    fs.mkdirSync(path.join(folder, "parts"));
    fs.copyFileSync(path.join(root, "editors/vscode/media/icon.png"), path.join(folder, "parts/ball.png"));
    fs.writeFileSync(path.join(folder, "parts/part.mtlx"), `<materialx version="1.39"><image name="picture" type="color3">
        <input name="file" type="filename" value="ball.png"/></image></materialx>`);
    fs.mkdirSync(nodeLibrary);
    fs.writeFileSync(path.join(nodeLibrary, "studio.mtlx"), `<materialx version="1.39">
        <nodedef name="ND_studio_tint" node="studio_tint"><input name="shade" type="color3" value="1, 0, 0"/><output name="out" type="color3"/></nodedef>
        <implementation name="IM_studio_tint" nodedef="ND_studio_tint" file="studio.glsl" function="studio_tint"/></materialx>`);
    fs.writeFileSync(path.join(nodeLibrary, "studio.glsl"), "void studio_tint(vec3 shade, out vec3 result)\n{\n    result = shade * 0.5;\n}\n");
    extended = original.replace("  <surfacematerial", `${added}  <surfacematerial`);
    fs.writeFileSync(file, extended);
    editor = await openPreview({ "workbench.colorTheme": "Default Light Modern", "mxgen.libraries": [nodeLibrary] });
    await editor.press("document.querySelector('.monaco-editor .view-line span span')");
    await editor.key("End", "End", 35, 2);
    await moveTo("<studio_tint", "tint");
    const [red, green] = await editor.view(MEAN);
    assert(red > 100 && green < 60, `${red} ${green}`);
    await editor.until(TWO_WARNINGS);
    await moveTo('name="bright"', "bright");
    await editor.untilView(`${MEAN}[1] > 60`); // the texture of an included file; without it there is a checker without green
    assert.equal(await editor.view("document.getElementById('notice').hidden"), true);
});

test("a broken text keeps the picture and tells the error", async () => {
    await moveTo("<surfacematerial", "Marble");
    await shot(editor, "light");
    await editor.key("End", "End", 35);
    await editor.type("<");
    await editor.untilView("!document.getElementById('notice').hidden && document.getElementById('notice').className === 'error'");
    assert.match(await editor.view("document.getElementById('notice').textContent"), /last text without errors/);
    await editor.until("document.querySelector('.squiggly-error')");
    assert((await editor.view(MEAN)).every(x => x > 60));
    await shot(editor, "broken");
    await editor.key("z", "KeyZ", 90, 2);
    await editor.untilView("document.getElementById('notice').hidden");
    await editor.close();
});

test("without the program the language server is that of the extension", async () => {
    fs.writeFileSync(file, original.replace('name="octaves" type="integer"', 'name="octaves" type="float"'));
    editor = await openPreview({ "mxgen.path": path.join(work, "none") });
    await editor.until("document.querySelector('.notification-toast')?.textContent.includes('does not start')");
    await editor.until("/Errors: 1/.test(document.getElementById('status.problems').outerHTML)");
    await editor.press("document.querySelector('.monaco-editor .view-line span span')");
    await editor.key("Home", "Home", 36, 2);
    await editor.until("document.querySelector('.colorpicker-color-decoration')");
    await editor.untilView("document.getElementById('notice').textContent.includes(\"input 'octaves'\")");
    await shot(editor, "without");
    await editor.close();
});

test("the browser edition: the language server in a worker, and the preview", async () => {
    fs.writeFileSync(file, extended);
    editor = await openPreview({ "remote.extensionKind": { "mxgen.mxgen": ["web"] }, "mxgen.libraries": [nodeLibrary] });
    await editor.until("[...document.querySelectorAll('iframe')].some(one => one.src.includes('webWorkerExtensionHostIframe'))");
    await editor.until(TWO_WARNINGS);
    await editor.press("document.querySelector('.monaco-editor .view-line span span')");
    await editor.key("Home", "Home", 36, 2);
    await editor.until("document.querySelector('.colorpicker-color-decoration')");
    await moveTo("<fractal3d", "NG_marble/noise");
    await editor.key("End", "End", 35);
    await editor.type("<");
    await editor.until("document.querySelector('.squiggly-error')");
    await editor.type("i");
    await editor.until("[...document.querySelectorAll('.suggest-widget .monaco-list-row')].some(row => row.textContent.includes('lacunarity'))");
    await shot(editor, "browser");
    await editor.close();
});

try {
    await run("vscode");
} finally {
    await browser.close();
    server.close();
}
if (process.env.KEEP)
    console.log(work);
else
    fs.rmSync(work, { recursive: true, force: true, maxRetries: 5 });
