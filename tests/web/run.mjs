// SPDX-License-Identifier: Apache-2.0
// The page in Chromium: what its users do, and its pictures beside those of `mxgen render`. Arguments: the folder of the page, Chromium, the
// root of the project, the program; optionally `pictures` and mxgen-render.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";

import { run, test } from "../js/harness.mjs";
import { Browser } from "./browser.mjs";
import { change, compile, DIFFERENCE, drop, MEAN, pick, RED, status, textOf, type, WHOLE, withPage as openPage, withServer } from "./page.mjs";

const [folder, chromium, root, program, mode] = process.argv.slice(2);
const work = fs.mkdtempSync(path.join(os.tmpdir(), "mxgen-page-"));
const onDisk = pathToFileURL(path.join(folder, "index.html")).href;
const example = name => fs.readFileSync(path.join(root, "examples", name), "utf8");

let browser;
const withPage = (address, work) => openPage(browser, address, work);

// ---- Tests ----

if (mode !== "pictures") {
    test("from a folder on disk: a picture, its inputs, and no complaints", () => withPage(onDisk, async page => {
        await page.until("document.body.dataset.picture && document.body.dataset.compiled");
        assert.equal(await textOf(page), example("gold.mtlx"));
        assert.match(await status(page), /^1 closure · \d+ ms$/);
        assert.deepEqual(await page.evaluate("[...document.querySelectorAll('#controls label')].map(label => label.dataset.path).slice(0, 2)"),
                         ["SR_gold/base", "SR_gold/base_color"]);
        assert.equal(await page.evaluate("document.getElementById('messages').textContent"), "No errors, no warnings.");
        const size = ["index.html", "page.css", "page.js", "mxgen.js"].reduce((sum, name) => sum + fs.statSync(path.join(folder, name)).size, 0);
        assert(size < 1_500_000, `the page has ${size} bytes before its editor`);
        console.log(`the page has ${size} bytes, its editor ${fs.statSync(path.join(folder, "editor.js")).size}; first picture after ${await page.evaluate("document.body.dataset.picture")} ms`);
        await page.screenshot(path.join(work, "gold.png"));
    }));

    test("a slider moves the picture and the document", () => withPage(onDisk, async page => {
        await page.until("document.body.dataset.picture");
        await compile(page, type(page, RED));
        const [red, green] = await page.evaluate(MEAN);
        assert(red > 100 && green < 90, `${red} ${green}`);
        const box = "document.querySelector('[data-path=\"SR/base_color\"] input[type=color]')";
        await page.evaluate(`${box}.value = "#00ff00", ${box}.dispatchEvent(new Event("input", { bubbles: true }))`);
        await page.until(WHOLE);
        const [after, green2] = await page.evaluate(MEAN);
        assert(green2 > 100 && after < 90, `${after} ${green2}`);
        assert.match(await textOf(page), /value="1, 0, 0"/); // the document follows when the slider rests
        await page.evaluate(`${box}.dispatchEvent(new Event("change", { bubbles: true }))`);
        await page.until("document.getElementById('text').value.includes('value=\"0, 1, 0\"')");
        const slider = "document.querySelector('[data-path=\"SR/metalness\"] input[type=range]')";
        await page.until(slider);
        await page.evaluate(`${slider}.value = "1", ${slider}.dispatchEvent(new Event("input", { bubbles: true })), ${slider}.dispatchEvent(new Event("change", { bubbles: true }))`);
        await page.until(`/name="metalness" type="float" value="1"/.test(document.getElementById("text").value)`); // a new input
    }));

    test("a broken document and its repair", () => withPage(onDisk, async page => {
        await page.until("document.body.dataset.picture");
        await compile(page, type(page, RED));
        await page.evaluate(type(page, RED.replace("1, 0, 0", "red")));
        await page.until("document.querySelector('#messages .error')");
        assert.equal(await status(page), "1 error");
        assert.match(await page.evaluate("document.getElementById('notice').innerText"), /^Line 4: [^]*\nThe picture is of the last text without errors\.$/);
        const [red, green] = await page.evaluate(MEAN);
        assert(red > 100 && green < 90); // the picture stays
        await page.screenshot(path.join(work, "broken.png"));
        await page.evaluate(type(page, "<materialx"));
        await page.until("/truncated/.test(document.getElementById('messages').textContent)");
        await compile(page, type(page, RED));
        await page.until("!document.querySelector('#messages .error') && document.getElementById('notice').hidden");
    }));

    test("shader, targets, closures, elements, shapes", () => withPage(onDisk, async page => {
        await page.until("document.body.dataset.picture");
        await page.evaluate("document.querySelector('[data-tab=source]').click()");
        await page.until("document.getElementById('source').textContent.startsWith('#version 300 es')");
        await page.evaluate(pick("target", "osl"));
        await page.until("/^(surface|shader) Gold/m.test(document.getElementById('source').textContent)");
        await page.evaluate("document.querySelector('[data-tab=closures]').click()");
        await page.until("/conductor|generalized_schlick|metal/.test(document.getElementById('closures').textContent)");
        await page.screenshot(path.join(work, "closures.png"));
        const two = RED.replace("</materialx>", `<standard_surface name="S2" type="surfaceshader"><input name="base_color" type="color3" value="0, 0, 1"/>
            <input name="specular" type="float" value="0"/></standard_surface><surfacematerial name="Blue" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S2"/></surfacematerial></materialx>`);
        await compile(page, type(page, two));
        await page.until("document.getElementById('element').options.length === 2");
        await page.evaluate(pick("element", "Blue"));
        await page.until("document.querySelector('[data-path=\"S2/base_color\"]')");
        for (const shape of ["sphere", "cube", "cloth", "plane", "ball"]) {
            await change(page, pick("shape", shape));
            assert((await page.evaluate(MEAN))[2] > 60, shape);
        }
        await page.evaluate("document.getElementById('canvas').dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft' }))");
    }));

    test("a link holds the document", () => withPage(onDisk, async page => {
        await page.until("document.body.dataset.picture");
        const strange = RED.replace("<materialx", "<!-- é 漢 \u{1f3a8} -->\n<materialx");
        await compile(page, type(page, strange));
        await page.evaluate("document.getElementById('share').click()");
        await page.until("location.hash.startsWith('#document=')");
        const link = await page.evaluate("location.href");
        await withPage(link, async other => {
            await other.until("document.body.dataset.picture");
            assert.equal(await textOf(other), strange);
            await other.evaluate("location.hash = '#document=!!!'"); // a damaged link
            await other.until("/damaged/.test(document.getElementById('status').textContent)");
            assert.equal(await textOf(other), strange);
        });
        await withPage(`${onDisk}#document=abc`, async other => {
            await other.until("document.body.dataset.picture");
            assert.equal(await textOf(other), example("gold.mtlx"));
        });
    }));

    test("dropped files: a document, what it includes, its textures", () => withPage(onDisk, async page => {
        await page.until("document.body.dataset.picture");
        const main = `<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href="part.mtlx"/>
            <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial></materialx>`;
        const part = `<materialx version="1.39"><image name="i" type="color3"><input name="file" type="filename" value="textures/dot.png"/></image>
            <standard_surface name="SR" type="surfaceshader"><input name="base_color" type="color3" nodename="i"/><input name="specular" type="float" value="0"/>
            </standard_surface></materialx>`;
        await compile(page, drop([["main.mtlx", "", main]]));
        await page.until("document.querySelector('#messages .error')"); // the include is missing
        // Includes come beside the document: the first .mtlx is the document.
        await compile(page, drop([["main.mtlx", "", main], ["part.mtlx", "", part]]));
        await page.until("/textures\\/dot.png/.test(document.getElementById('notice').textContent)");
        const blue = await page.evaluate(`(async () => {
            const canvas = new OffscreenCanvas(4, 4), context = canvas.getContext("2d");
            context.fillStyle = "blue";
            context.fillRect(0, 0, 4, 4);
            return [...new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer())];
        })()`);
        await compile(page, drop([["dot.png", "image/png", blue]]));
        assert.match(await status(page), /closure/);
        assert.equal(await page.evaluate("document.getElementById('notice').hidden"), true);
        const [red, , b] = await page.evaluate(MEAN);
        assert(b > 100 && red < 90, `${red} ${b}`);
        await page.evaluate(drop([["bad.png", "image/png", "no picture"]]));
        await page.until("/cannot read bad.png/.test(document.getElementById('status').textContent)");
    }));

    test("a document of 50 MB, and one of 50,000 nodes", () => withPage(onDisk, async page => {
        await page.until("document.body.dataset.picture");
        await page.evaluate(`(() => {
            const data = new DataTransfer();
            data.items.add(new File(["<materialx version='1.39'>", "<!-- a comment -->".repeat(50e6 / 18), "</materialx>"], "big.mtlx"));
            document.querySelector("main").dispatchEvent(new DragEvent("drop", { bubbles: true, cancelable: true, dataTransfer: data }));
        })()`);
        await page.until("/has 50 MB; the page shows documents of up to 4 MB/.test(document.getElementById('status').textContent)");
        assert.equal(await textOf(page), example("gold.mtlx"));
        // The page answers while the worker works.
        const many = `<materialx version="1.39">${Array.from({ length: 50_000 }, (_, i) => `<constant name="c${i}" type="float"/>\n`).join("")}</materialx>`;
        await page.evaluate(`delete document.body.dataset.compiled, ${type(page, many)}`);
        assert.equal(await page.evaluate("1 + 1"), 2);
        await page.until("document.body.dataset.compiled");
        assert.match(await status(page), /no material|closure|error/);
    }));

    test("the device loses its context", () => withPage(onDisk, async page => {
        await page.until("document.body.dataset.picture");
        await compile(page, type(page, RED));
        await page.evaluate("window.lost = document.getElementById('canvas').getContext('webgl2').getExtension('WEBGL_lose_context'), lost.loseContext()");
        await page.until("document.getElementById('canvas').getContext('webgl2').isContextLost()");
        await page.evaluate("lost.restoreContext()");
        await page.until("!document.getElementById('canvas').getContext('webgl2').isContextLost()");
        await change(page, pick("shape", "sphere"));
        const [red, green] = await page.evaluate(MEAN);
        assert(red > 100 && green < 90, `${red} ${green}`);
        page.complaints = page.complaints.filter(text => !/context/i.test(text));
    }));

    test("from a server with a strict content security policy", () => withServer(folder, address => withPage(address, async page => {
        await page.until("document.body.dataset.picture && document.body.dataset.editor");
        assert.match(await status(page), /closure/);
    })));
}

if (mode === "pictures")
    // The page takes as many samples of the same lights with another rasteriser; the irradiance has fewer texels.
    for (const [name, shape, limit] of [["gold", "ball", 0.5], ["marble", "sphere", 0.5], ["car_paint", "sphere", 1], ["gold", "cube", 0.5], ["gold", "cloth", 0.5], ["shaderx", "sphere", 0.5], ["displaced", "sphere", 1.5], ["fog", "plane", 0.5]])
        test(`${name} on a ${shape} looks as in mxgen render`, () => withPage(onDisk, async page => {
            await page.until("document.body.dataset.picture");
            await page.evaluate(pick("shape", shape));
            await compile(page, type(page, example(`${name}.mtlx`)));
            const mine = await page.evaluate("document.getElementById('canvas').toDataURL().split(',')[1]");
            const [width, height] = await page.evaluate("[document.getElementById('canvas').width, document.getElementById('canvas').height]");
            const file = path.join(work, `${name}.png`);
            execFileSync(program, ["render", path.join(root, "examples", `${name}.mtlx`), "-m", shape, "-s", `${width}x${height}`, "-o", file], { stdio: "pipe" });
            const [difference, ...sizes] = await page.evaluate(DIFFERENCE(mine, fs.readFileSync(file).toString("base64")));
            fs.writeFileSync(path.join(work, `${name}.page.png`), Buffer.from(mine, "base64"));
            console.log(`${name} on a ${shape}: ${difference.toFixed(2)} of 255 ${sizes.join(" ")}`);
            assert(difference < limit, `${difference} of 255 ${sizes}; ${process.env.KEEP ? work : "KEEP=1 keeps the pictures"}`);
        }));

browser = new Browser(chromium);
try {
    await run(mode === "pictures" ? "web-pictures" : "web");
} finally {
    await browser.close();
}
if (mode !== "pictures") {
    // A browser without WebGL 2
    browser = new Browser(chromium, ["--disable-3d-apis"]);
    const before = process.exitCode;
    try {
        await withPage(onDisk, async page => {
            await page.until("/^\\d+ closure/.test(document.getElementById('status').textContent)");
            assert.match(await page.evaluate("document.getElementById('no-picture').textContent"), /has no WebGL 2/);
            assert.equal(await page.evaluate("document.getElementById('no-picture').hidden"), false);
        });
        console.log("web-without-webgl: 1 passed, 0 failed, 0 skipped");
    } catch (error) {
        console.log(`failed: without WebGL 2\n${error.stack}\nweb-without-webgl: 0 passed, 1 failed, 0 skipped`);
        process.exitCode = 1;
    } finally {
        await browser.close();
    }
    process.exitCode ||= before;
}
if (!process.env.KEEP)
    fs.rmSync(work, { recursive: true });
else
    console.log(work);
