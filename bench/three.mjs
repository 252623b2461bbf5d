// SPDX-License-Identifier: Apache-2.0
// mxgen/three beside three's own MaterialXLoader, with the documents of a folder: which load, and how far their pictures on a sphere are from
// those of `mxgen render`. Such a folder is the checkout of the samples of github.com/bhouston/materialx-fidelity.
//     node bench/three.mjs build FOLDER [--verbose]

import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";

import { bundle, difference, render, serve, writeSky } from "../tests/three/server.mjs";
import { Browser } from "../tests/web/browser.mjs";

const [build, samples, verbose] = process.argv.slice(2), root = path.dirname(path.dirname(fileURLToPath(import.meta.url)));
if (!samples || !fs.existsSync(samples)) {
    console.log("skip: no folder of documents (node bench/three.mjs BUILD FOLDER)");
    process.exit(77);
}
const program = path.resolve(build, "mxgen"), folder = path.resolve(build, "js/mxgen"), work = fs.mkdtempSync(path.join(os.tmpdir(), "mxgen-three-"));
const KINDS = { "mxgen/three": true, "MaterialXLoader": false };

/** Documents with a material of a surface, and the name of the first. */
const isDocument = file => file.endsWith(".mtlx") && fs.statSync(path.join(samples, file)).isFile();
const documents = fs.readdirSync(samples, { recursive: true }).filter(isDocument).sort().map(file => {
    const [, name] = /<surfacematerial[^>]*\sname="([^"]*)"/.exec(fs.readFileSync(path.join(samples, file), "latin1")) ?? [];
    return { file, name };
}).filter(({ name }) => name);

const results = Object.fromEntries(Object.keys(KINDS).map(kind => [kind, { loaded: 0, errors: [], alone: [] }]));
bundle(work, { page: path.join(root, "bench/three_page.js"), root, folder, esbuild: "esbuild" });
writeSky(path.join(work, "sky.hdr"));
const server = await serve([work, path.resolve(samples)]), reference = path.join(work, "reference.png");
let browser = null, page = null, drawn = 0;

async function open() {
    await browser?.close();
    browser = new Browser("chromium");
    page = await browser.open(`${server.address}/page.html`);
    await page.until("window.drawingIsReady");
}

/** The fault of a document, or null; the picture is written. A page that does not answer is replaced. */
async function draw(kind, { file, name }, picture) {
    page.complaints = [];
    const drawing = page.evaluate(`drawDocument(${KINDS[kind]}, ${JSON.stringify(file.split(path.sep).map(encodeURIComponent).join("/"))}, ${JSON.stringify(name)})`);
    const late = new Promise((resolve, reject) => setTimeout(reject, 60_000, new Error("no picture within a minute")).unref());
    try {
        fs.writeFileSync(picture, Buffer.from(await Promise.race([drawing, late])));
        const [complaint] = page.complaints.filter(text => /shader error|program/i.test(text)); // a program that the driver refuses
        return complaint ?? null;
    } catch (error) {
        if (/within a minute|Chromium/.test(error.message))
            await open();
        return error.message;
    }
}

await open();
for (const [index, document] of documents.entries()) {
    if (index % 40 === 39)
        await open(); // memory of the device
    const errors = {};
    let reason = null;
    try {
        render(program, path.join(samples, document.file), path.join(work, "sky.hdr"), reference, ["-e", document.name]);
    } catch (error) {
        reason = String(error.stderr ?? error.message).trim().split("\n").at(-1);
    }
    for (const [kind, result] of Object.entries(results)) {
        const picture = path.join(work, "picture.png"), fault = await draw(kind, document, picture);
        result.loaded += fault === null;
        if (fault === null && reason === null)
            errors[kind] = (await difference(page, picture, reference)).mean;
        if (verbose)
            console.log(`${document.file} ${kind}: ${(fault ?? errors[kind]?.toFixed(2) ?? reason).slice(0, 300).replaceAll("\n", " ")}`);
    }
    drawn += reason === null;
    const both = Object.values(errors).every(Number.isFinite) && Object.keys(errors).length === Object.keys(KINDS).length;
    for (const [kind, error] of Object.entries(errors))
        if (Number.isFinite(error))
            results[kind][both ? "errors" : "alone"].push(error);
}
await browser.close();
server.close();
fs.rmSync(work, { recursive: true });

const mean = values => values.length ? (values.reduce((sum, x) => sum + x, 0) / values.length).toFixed(2) : "-";
const median = values => values.length ? [...values].sort((a, b) => a - b)[values.length >> 1].toFixed(2) : "-";
console.log(`${documents.length} documents with a material, of which mxgen render draws ${drawn}; errors of 255 where both draw`);
console.log("| | loads and draws | mean error | median error |\n| --- | --- | --- | --- |");
for (const [kind, { loaded, errors }] of Object.entries(results))
    console.log(`| ${kind} | ${loaded} | ${mean(errors)} (${errors.length}) | ${median(errors)} |`);
