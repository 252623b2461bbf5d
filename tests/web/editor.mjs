// SPDX-License-Identifier: Apache-2.0
// The editor of the page in Chromium, with keys and a mouse. Arguments: the folder of the page, Chromium, the root of the project.

import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";

import { run, test } from "../js/harness.mjs";
import { Browser } from "./browser.mjs";
import { drop, pick, RED, textOf, withPage, withServer } from "./page.mjs";

const [folder, chromium, root] = process.argv.slice(2);
const onDisk = pathToFileURL(path.join(folder, "index.html")).href;
const example = name => fs.readFileSync(path.join(root, "examples", name), "utf8");
const browser = new Browser(chromium);

// ---- What a user of the editor does and sees ----

const EDITOR = "document.getElementById('text')", INSIDE = `${EDITOR}.shadowRoot`;
const has = selector => `${INSIDE}.querySelector(${JSON.stringify(selector)})`;

const withEditor = (work, size = { width: 1300, height: 700 }) => withPage(browser, onDisk, async page => {
    await page.until("document.body.dataset.editor && document.body.dataset.compiled");
    await work(page);
}, size);

/** The text as if it were opened. */
const open = (page, text) => page.evaluate(`${EDITOR}.value = ${JSON.stringify(text)}`);

/** Puts the cursor before a part of the text. */
const goTo = (page, part, by = 0) => page.evaluate(`(text => text.select(text.value.indexOf(${JSON.stringify(part)}) + ${by}, text.value.indexOf(${JSON.stringify(part)}) + ${by}))(${EDITOR})`);

/** The middle of an element of the editor on the screen. */
const placeOf = (page, selector) => page.evaluate(`(box => [box.x + box.width / 2, box.y + box.height / 2])(${has(selector)}.getBoundingClientRect())`);

/** The middle of letters of the text on the screen, where they stand last. */
const letters = (page, part) => page.evaluate(`(() => {
    const walker = document.createTreeWalker(${has(".cm-content")}, NodeFilter.SHOW_TEXT);
    let place = null;
    for (let node; (node = walker.nextNode());) {
        const at = node.data.lastIndexOf(${JSON.stringify(part)}), range = document.createRange();
        if (at < 0)
            continue;
        range.setStart(node, at);
        range.setEnd(node, at + ${part.length});
        const box = range.getBoundingClientRect();
        place = [box.x + box.width / 2, box.y + box.height / 2];
    }
    return place;
})()`);

// ---- Tests ----

test("a fault is marked where it stands, and its fix mends it", () => withEditor(async page => {
    const text = await textOf(page);
    await goTo(page, "metalness");
    await page.insert("x");
    await page.until(has(".cm-lintRange"));
    assert.equal(await page.evaluate(`${has(".cm-lintRange")}.textContent.includes("xmetalness")`), true);
    await page.point(await placeOf(page, ".cm-lintRange"));
    await page.until(has(".cm-diagnosticAction"));
    assert.match(await page.evaluate(`${has(".cm-tooltip .cm-diagnostic")}.textContent`), /xmetalness.*metalness/s);
    await page.evaluate(`${has(".cm-diagnosticAction")}.click()`);
    await page.until(`!${has(".cm-lintRange")}`);
    assert.equal(await textOf(page), text);
    await page.until("document.getElementById('messages').textContent === 'No errors, no warnings.'");
}));

test("a fix beside a message", () => withEditor(async page => {
    await open(page, RED.replace("base_color", "base_colour"));
    await page.until("document.querySelector('#messages .fix')");
    await page.evaluate("document.querySelector('#messages .message').click()"); // goes there
    assert.match(await page.evaluate(`${has(".cm-activeLine")}.textContent`), /base_colour/);
    await page.evaluate("document.querySelector('#messages .fix').click()");
    await page.until("document.getElementById('messages').textContent === 'No errors, no warnings.'");
    assert.equal(await textOf(page), RED);
}));

test("an input is completed, and another value of an attribute", () => withEditor(async page => {
    await open(page, RED);
    await goTo(page, "  </standard_surface>");
    await page.insert("    <metaln");
    await page.until(`${has(".cm-tooltip-autocomplete li[aria-selected]")}?.textContent.includes("metalness")`);
    await new Promise(resolve => setTimeout(resolve, 100)); // the list takes no key at once
    await page.key("Enter");
    await page.until(`${EDITOR}.value.includes('<input name="metalness" type="float" value="0"/>')`);
    await page.insert("0.5"); // the value is selected
    assert.equal(await textOf(page), RED.replace("  </standard", '    <input name="metalness" type="float" value="0.5"/>  </standard'));
    await page.until("document.getElementById('messages').textContent === 'No errors, no warnings.'");
}));

test("what is under the pointer, and where it is defined", () => withEditor(async page => {
    await open(page, RED);
    await page.point(await letters(page, "base_color"));
    await page.until(has(".documentation"));
    assert.match(await page.evaluate(`${has(".documentation")}.innerText`), /^base_color: color3 = 0\.8, 0\.8, 0\.8/);
    assert.equal(await page.evaluate(`${has(".documentation code")}.textContent`), "base_color");
    await goTo(page, 'nodename="SR"', 11);
    await page.key("F12");
    await page.until(`${has(".cm-activeLine")}.textContent.includes("<standard_surface")`);
    await goTo(page, "<?xml");
    await page.point([5, 300]);
    await page.until(`!${has(".cm-tooltip")}`); // which may stand over the letters
    await page.point(await letters(page, "SR"), { clicks: true, modifiers: 2 });
    await page.until(`${has(".cm-activeLine")}.textContent.includes("<standard_surface")`);
}, { width: 1900, height: 700 })); // all letters are in view

test("a name changes wherever it stands", () => withEditor(async page => {
    await open(page, RED);
    await goTo(page, 'name="SR"', 7);
    await page.key("F2");
    await page.until(`${has(".cm-dialog input")} && ${INSIDE}.activeElement === ${has(".cm-dialog input")}`);
    await page.key("a", 2);
    await page.insert("Paint");
    await page.key("Enter");
    await page.until(`${EDITOR}.value.includes('nodename="Paint"')`);
    assert.equal(await textOf(page), RED.replaceAll('"SR"', '"Paint"'));
}));

test("places of a name are marked, and visited one after the other", () => withEditor(async page => {
    await open(page, RED);
    await goTo(page, 'name="SR"', 7);
    await page.until(`${INSIDE}.querySelectorAll(".place").length === 2`);
    assert.deepEqual(await page.evaluate(`[...${INSIDE}.querySelectorAll(".place")].map(place => place.textContent)`), ["SR", "SR"]);
    for (const line of ['nodename="SR"', "<standard_surface", 'nodename="SR"']) {
        await page.key("F12", 8);
        await page.until(`${has(".cm-activeLine")}.textContent.includes(${JSON.stringify(line)})`);
    }
    await goTo(page, "<?xml");
    await page.until(`!${has(".place")}`);
}));

test("hints say which definition a node has, and in which space a colour is", () => withEditor(async page => {
    await open(page, `<materialx version="1.39" colorspace="acescg">
  <nodegraph name="NG"><multiply name="m" type="color3"><input name="in1" type="color3" value="0.1, 0.2, 0.3"/><input name="in2" type="float" value="2"/></multiply>
    <output name="out" type="color3" nodename="m"/></nodegraph></materialx>`);
    await page.until(has(".hint"));
    assert.deepEqual(await page.evaluate(`[...${INSIDE}.querySelectorAll(".hint")].map(hint => hint.textContent)`), ["ND_multiply_color3FA", "acescg"]);
    assert.equal(await page.evaluate(`${EDITOR}.value.includes("ND_multiply")`), false);
}));

test("the text is laid out, and back", () => withEditor(async page => {
    const wild = RED.replaceAll("\n    <input", "\n<input");
    await open(page, wild);
    await page.evaluate("document.getElementById('format').click()");
    await page.until(`${EDITOR}.value !== ${JSON.stringify(wild)}`);
    assert.match(await textOf(page), /\n    <input name="base_color"/);
    await page.evaluate("document.getElementById('undo').click()");
    assert.equal(await textOf(page), wild);
}));

test("undo goes over controls, examples and keys alike", () => withEditor(async page => {
    const gold = await textOf(page), slider = "document.querySelector('[data-path=\"SR_gold/specular_roughness\"] input[type=range]')";
    const move = value => page.evaluate(`${slider}.focus(), ${slider}.value = "${value}", ${slider}.dispatchEvent(new Event("input", { bubbles: true })), ${slider}.dispatchEvent(new Event("change", { bubbles: true }))`);
    await move(0.3);
    const rough = gold.replace('"specular_roughness" type="float" value="0.1"', '"specular_roughness" type="float" value="0.3"');
    assert.notEqual(rough, gold);
    assert.equal(await textOf(page), rough); // one attribute, and nothing else
    await page.until(`document.activeElement === ${slider} && !document.querySelector('[data-path="SR_gold/specular_roughness"] .reset').hidden`);
    await page.evaluate(pick("example", "Marble"));
    assert.equal(await textOf(page), example("marble.mtlx"));
    await goTo(page, "<materialx");
    await page.insert("<!-- mine -->");
    await page.key("z", 2);
    assert.equal(await textOf(page), example("marble.mtlx"));
    await page.evaluate("document.getElementById('shape').focus()"); // outside of the text
    await page.key("z", 2);
    assert.equal(await textOf(page), rough);
    await page.until(slider);
    await page.evaluate(`${slider}.focus()`);
    await page.key("z", 2);
    assert.equal(await textOf(page), gold);
    await page.until(`${slider}.value === "0.1"`); // the controls follow
    await page.key("z", 10);
    assert.equal(await textOf(page), rough);
    await page.evaluate("document.querySelector('[data-path=\"SR_gold/specular_roughness\"] .reset')?.click()");
    await page.until(`${EDITOR}.value === ${JSON.stringify(gold)}`);
}));

test("a control leaves includes, comments and layout alone", () => withEditor(async page => {
    const text = RED.replace("<materialx version=\"1.39\">", "<materialx   version='1.39'   xmlns:xi=\"http://www.w3.org/2001/XInclude\">\n  <xi:include href='part.mtlx'/> <!-- & -->");
    const part = '<materialx version="1.39"><constant name="c" type="float"><input name="value" type="float" value="0.5"/></constant></materialx>';
    await page.evaluate(drop([["main.mtlx", "", text], ["part.mtlx", "", part]]));
    const box = "document.querySelector('[data-path=\"SR/base_color\"] input[type=number]')";
    await page.until(`${box} && !document.querySelector('#messages .error')`);
    await page.evaluate(`${box}.value = "0.25", ${box}.dispatchEvent(new Event("input", { bubbles: true })), ${box}.dispatchEvent(new Event("change", { bubbles: true }))`);
    assert.equal(await textOf(page), text.replace("1, 0, 0", "0.25, 0, 0"));
    await page.until(`!${has(".cm-lintRange-error")}`); // the server has the file, too
}));

test("boxes of colours", () => withEditor(async page => {
    await open(page, RED);
    await page.until(`${has("input.colour")}?.value === "#ff0000"`);
    await page.evaluate(`${has("input.colour")}.value = "#00ff00", ${has("input.colour")}.dispatchEvent(new Event("change"))`);
    await page.until(`${EDITOR}.value.includes('value="0, 1, 0"')`);
    assert.equal(await textOf(page), RED.replace("1, 0, 0", "0, 1, 0"));
}));

test("the server starts anew when its worker ended", () => withPage(browser, "about:blank", async page => {
    await page.send("Page.addScriptToEvaluateOnNewDocument", { source: "var workers = []; Worker = class extends Worker { constructor(...all) { super(...all); workers.push(this); } }" });
    await page.send("Page.navigate", { url: onDisk });
    await page.until("document.body.dataset.editor && workers.length === 2");
    await page.evaluate("workers[1].dispatchEvent(new ErrorEvent('error', { message: 'an end' }))");
    await open(page, RED.replace("base_color", "base_colour"));
    await page.until(`workers.length === 3 && ${has(".cm-lintRange")}`);
    await open(page, RED);
    await page.until(`!${has(".cm-lintRange")}`);
}));

test("every width, light and dark: no rule of accessibility is broken", async () => {
    const axe = path.join(root, "tests/npm/node_modules/axe-core/axe.min.js");
    if (!fs.existsSync(axe))
        return console.log("skip: axe-core is not installed (npm ci --prefix tests/npm): accessibility was not checked");
    for (const [width, height] of [[390, 844], [900, 700], [1400, 900]])
        for (const scheme of ["light", "dark"])
            await withEditor(async page => {
                await page.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: scheme }] });
                await open(page, RED.replace("base_color", "base_colour"));
                await page.until("document.querySelector('#messages .fix') && document.body.dataset.studio");
                await page.evaluate(fs.readFileSync(axe, "utf8"));
                await page.evaluate("document.getElementById('pin').click()");
                for (const tab of ["messages", "view"]) {
                    await page.evaluate(`document.getElementById("tab-${tab}").click()`);
                    const found = await page.evaluate("axe.run({ preload: false }).then(({ violations }) => violations.flatMap(({ id, nodes }) => nodes.map(({ target, failureSummary }) => `${id} ${target}: ${failureSummary}`)))");
                    assert.deepEqual(found, [], `${width} ${scheme} ${tab}`);
                }
                const wide = await page.evaluate("document.documentElement.scrollWidth");
                assert(wide <= width, `the page is ${wide} pixels wide, the window ${width}`);
            }, { width, height });
});

test("from a server with a strict content security policy", () => withServer(folder, address => withPage(browser, address, async page => {
    await page.until(`document.body.dataset.editor && ${has(".cm-content")}.textContent.includes("SR_gold")`);
    assert.equal(await page.evaluate(`getComputedStyle(${has(".cm-scroller")}).display`), "flex"); // its style sheets count
})));

test("without the editor's file the text stays", async () => {
    const copy = fs.mkdtempSync(path.join(folder, "../page-"));
    try {
        for (const name of ["index.html", "page.css", "page.js", "mxgen.js"])
            fs.copyFileSync(path.join(folder, name), path.join(copy, name));
        const page = await browser.open(pathToFileURL(path.join(copy, "index.html")).href);
        await page.until("/cannot load editor.js/.test(document.getElementById('status').textContent)");
        assert.equal(await textOf(page), example("gold.mtlx"));
        await page.close();
    } finally {
        fs.rmSync(copy, { recursive: true });
    }
});

try {
    await run("web-editor");
} finally {
    await browser.close();
}
