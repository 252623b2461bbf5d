// SPDX-License-Identifier: Apache-2.0
// The extension without an editor: its types, its package, and the edits of its controls. Arguments: a folder with the npm package, the root of
// the project.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import { createRequire } from "node:module";
import os from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";

import { run, test } from "../js/harness.mjs";

const [library, root] = process.argv.slice(2).map(name => path.resolve(name)), folder = path.join(root, "editors/vscode");
if (!fs.existsSync(path.join(folder, "node_modules"))) {
    console.log("skip: what the extension is built with is not installed: npm ci --prefix editors/vscode --ignore-scripts");
    process.exit(77);
}
const work = fs.mkdtempSync(path.join(os.tmpdir(), "mxgen-extension-")), packages = createRequire(path.join(folder, "package.json"));
const { load } = await import(pathToFileURL(path.join(library, "node.js")).href), context = (await load()).createContext();

const { changeOfInput, offsetOf } = await import(pathToFileURL(path.join(root, "web/changes.js")).href);

/** The text with another value of an input; the place of the node is that which the library tells. */
function changed(text, node, input, type, value) {
    const document = context.parse(text, { name: "text.mtlx" }), element = document.find(node);
    const change = changeOfInput(text, { ...element.place, node: element.name, input, type }, value);
    document.destroy();
    return change && text.slice(0, change.start) + change.text + text.slice(change.end);
}

const node = inside => `<?xml version="1.0"?>\n<materialx version="1.39">\n  <!-- é 漢 \u{1f3a8} --><add name="a" type="float"${inside}\n</materialx>\n`;

test("the types are right", () => {
    execFileSync(process.execPath, [packages.resolve("typescript/bin/tsc"), "-p", folder], { stdio: "pipe" });
});

test("an edit changes one attribute", () => {
    for (const value of ['"1"', "'1'", '""'])
        assert.equal(changed(node(`>\n    <!-- <input name="in1" value="9"/> -->\n    <input name="in1" type="float" value=${value} uimax="2"/></add>`), "a", "in1", "float", "0.5"),
            node(`>\n    <!-- <input name="in1" value="9"/> -->\n    <input name="in1" type="float" value=${value[0]}0.5${value[0]} uimax="2"/></add>`));
    assert.equal(changed(node('><input name="in1" type="float"/></add>'), "a", "in1", "float", "0.5"), node('><input name="in1" type="float" value="0.5"/></add>'));
});

test("an input that the text does not have stands below the others", () => {
    const added = '<input name="in2" type="float" value="2" />';
    assert.equal(changed(node("/>"), "a", "in2", "float", "2"), node(`>\n    ${added}\n  </add>`));
    assert.equal(changed(node(" />"), "a", "in2", "float", "2"), node(`>\n    ${added}\n  </add>`));
    assert.equal(changed(node("></add>"), "a", "in2", "float", "2"), node(`>\n    ${added}\n  </add>`));
    assert.equal(changed(node('>\n\t\t<input name="in1" type="float"></input>\n  </add>'), "a", "in2", "float", "2"),
        node(`>\n\t\t<input name="in1" type="float"></input>\n\t\t${added}\n  </add>`));
});

test("a node that is not at its place stays as it is", () => {
    const text = node("/>"), place = { line: 3, column: 3, input: "in1", type: "float" };
    assert.equal(changeOfInput(text, { ...place, node: "a" }, "1"), null); // a comment
    assert.equal(changeOfInput(text, { ...place, column: offsetOf(text, 3, 1), node: "a" }, "1"), null);
    assert.equal(changeOfInput(node("><input"), { ...place, column: 18, node: "a" }, "1"), null); // nothing closes it
});

test("every input of every example can be edited, and nothing else changes", () => {
    let count = 0;
    for (const name of fs.readdirSync(path.join(root, "examples")).filter(one => /^[gmc].*\.mtlx$/.test(one))) {
        const file = path.join(root, "examples", name), text = fs.readFileSync(file, "utf8"), document = context.parse(text, { name: file });
        for (const element of document.walk()) {
            const value = element.category === "input" && element.place?.file === file ? element.get("value") : null;
            if (value === null || !element.parent.name)
                continue;
            const { line, column } = element.parent.place, change = changeOfInput(text, { line, column, node: element.parent.name, input: element.name, type: element.type }, "?");
            assert.deepEqual([change && text.slice(change.start, change.end), change?.text], [value, "?"], `${name}: ${element.path}`);
            count++;
        }
        document.destroy();
    }
    assert(count > 20, String(count));
});

test("the package has what it needs and nothing else", () => {
    execFileSync(process.execPath, [path.join(folder, "build.mjs"), library, path.join(work, "extension"), path.join(work, "mxgen.vsix")], { stdio: ["ignore", "ignore", "pipe"] });
    const files = fs.readdirSync(path.join(work, "extension"), { recursive: true }).filter(name => fs.statSync(path.join(work, "extension", name)).isFile()).sort();
    assert.deepEqual(files, ["LICENSE", "README.md", "ThirdPartyNotices.txt", "dist/browser.js", "dist/desktop.js", "dist/mxgen.wasm", "dist/view.css", "dist/view.js", "dist/worker.js",
        "language-configuration.json", "media/file-dark.svg", "media/file-light.svg", "media/icon.png", "package.json", "syntaxes/materialx.tmLanguage.json"]);
    const manifest = JSON.parse(fs.readFileSync(path.join(folder, "package.json"), "utf8"));
    assert.equal(manifest.version, JSON.parse(fs.readFileSync(path.join(library, "package.json"), "utf8")).version);
    assert.doesNotMatch(fs.readFileSync(path.join(work, "extension/dist/browser.js"), "utf8"), /require\("(?!vscode")/); // browsers have no modules of Node
    assert(fs.statSync(path.join(work, "mxgen.vsix")).size < 2e6);
});

await run("vscode-extension");
fs.rmSync(work, { recursive: true });
