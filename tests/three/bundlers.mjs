// SPDX-License-Identifier: Apache-2.0
// Vite and webpack bundle mxgen/three and mxgen/three/webgpu, and the pages find mxgen.wasm. Arguments: the folder of the package, Chromium, the
// root of the project. esbuild bundles the page of run.mjs.

import assert from "node:assert/strict";
import fs from "node:fs";
import { createRequire } from "node:module";
import os from "node:os";
import path from "node:path";

import { run, test } from "../js/harness.mjs";
import { Browser } from "../web/browser.mjs";
import { serve } from "./server.mjs";

const [folder, chromium, root] = process.argv.slice(2), packages = path.join(root, "tests/npm"), require = createRequire(path.join(packages, "package.json"));
if (!["three", "vite", "webpack"].every(name => fs.existsSync(path.join(packages, "node_modules", name)))) {
    console.log("skip: three, Vite or webpack is not installed (npm ci --prefix tests/npm)");
    process.exit(77);
}
const work = fs.mkdtempSync(path.join(os.tmpdir(), "mxgen-bundlers-"));

const PROGRAM = `
import { MeshStandardMaterial } from "three";
import { MeshStandardNodeMaterial } from "three/webgpu";
import { MaterialXLoader } from "mxgen/three";
import { MaterialXLoader as NodeLoader } from "mxgen/three/webgpu";

async function load([Loader, Standard]) {
    const { materials: { Gold } } = await new Loader().loadAsync("gold.mtlx");
    return [Gold.shader.info.target, Gold instanceof Standard, Gold.setInput("SR_gold/base_color", [1, 0, 0])].join(" ");
}
const found = await Promise.all([[MaterialXLoader, MeshStandardMaterial], [NodeLoader, MeshStandardNodeMaterial]].map(load)).catch(error => [error.message]);
document.body.dataset.found = found.join("; ");
`;
const FOUND = "essl true true; wgsl true true";

/** A new app with the packages. Returns its folder, and that of what is built. */
function app(name, page) {
    const files = path.join(work, name), modules = path.join(files, "node_modules"), built = path.join(files, "dist");
    for (const made of [modules, built])
        fs.mkdirSync(made, { recursive: true });
    fs.cpSync(folder, path.join(modules, "mxgen"), { recursive: true });
    fs.symlinkSync(path.join(packages, "node_modules/three"), path.join(modules, "three"));
    fs.writeFileSync(path.join(files, "package.json"), '{ "type": "module" }');
    fs.writeFileSync(path.join(files, "main.js"), PROGRAM);
    fs.writeFileSync(path.join(files, page), '<!DOCTYPE html><link rel="icon" href="data:,"><body><script type="module" src="main.js"></script>');
    return { files, built };
}

const BUNDLERS = {
    async vite() {
        const { build } = await import(path.join(packages, "node_modules/vite/dist/node/index.js")), { files, built } = app("vite", "index.html");
        await build({ root: files, configFile: false, logLevel: "error", build: { target: "esnext", chunkSizeWarningLimit: 1e4 } });
        return built;
    },
    async webpack() {
        const webpack = require("webpack"), { files, built } = app("webpack", "dist/index.html");
        const stats = await new Promise((resolve, reject) => webpack({ mode: "production", context: files, entry: "./main.js", output: { path: built }, performance: false },
                                                                     (error, stats) => error ? reject(error) : resolve(stats)));
        assert(!stats.hasErrors() && !stats.hasWarnings(), stats.toString({ preset: "errors-warnings" }));
        return built;
    },
};

/** The answer of Vite's server in a page of the program, with settings for its optimizer. */
async function served(name, optimizeDeps) {
    const { createServer } = await import(path.join(packages, "node_modules/vite/dist/node/index.js")), { files } = app(name, "index.html");
    fs.mkdirSync(path.join(files, "public"));
    fs.copyFileSync(path.join(root, "examples/gold.mtlx"), path.join(files, "public/gold.mtlx"));
    const server = await createServer({ root: files, configFile: false, logLevel: "error", optimizeDeps, server: { host: "127.0.0.1", fs: { strict: false } } });
    await server.listen();
    try {
        const page = await browser.open(server.resolvedUrls.local[0]);
        await page.until("document.body.dataset.found");
        return await page.evaluate("document.body.dataset.found");
    } finally {
        await server.close();
    }
}

const browser = new Browser(chromium);
for (const [name, bundle] of Object.entries(BUNDLERS))
    test(`${name} bundles both entries`, async () => {
        const server = await serve([await bundle(), path.join(root, "examples")]), page = await browser.open(`${server.address}/index.html`);
        try {
            await page.until("document.body.dataset.found");
            assert.equal(await page.evaluate("document.body.dataset.found"), FOUND);
            assert.deepEqual(page.complaints, []);
        } finally {
            server.close();
        }
    });

test("Vite's server", async () => assert.equal(await served("server", { exclude: ["mxgen"] }), FOUND));

test("Vite's server without its setting tells of it", async () => assert.match(await served("optimized", {}), /mxgen\.wasm: .* optimizeDeps: \{ exclude: \["mxgen"\] \}/));

try {
    await run("three-bundlers");
} finally {
    await browser.close();
    fs.rmSync(work, { recursive: true });
}
