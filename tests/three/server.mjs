// SPDX-License-Identifier: Apache-2.0
// A server of pages with three, and comparisons of pictures.

import { execFileSync } from "node:child_process";
import fs from "node:fs";
import http from "node:http";
import path from "node:path";

import { makeSky } from "../../web/scene.js";

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm", ".png": "image/png" };

/** Puts a page with its bundle and the packages into a folder. */
export function bundle(work, { page, root, folder, esbuild, aliases = {} }) {
    const modules = path.join(work, "node_modules");
    fs.mkdirSync(modules);
    fs.symlinkSync(folder, path.join(modules, "mxgen"));
    fs.symlinkSync(path.join(root, "tests/npm/node_modules/three"), path.join(modules, "three"));
    fs.writeFileSync(path.join(work, "page.html"), "<!DOCTYPE html><link rel='icon' href='data:,'><body><script type='module' src='page.js'></script>");
    execFileSync(esbuild, [page, "--bundle", "--format=esm", "--target=es2022", "--log-level=warning", `--outfile=${path.join(work, "page.js")}`,
                           ...Object.entries(aliases).map(([name, file]) => `--alias:${name}=${file}`)],
                 { env: { ...process.env, NODE_PATH: modules }, stdio: ["ignore", "inherit", "inherit"] });
    fs.copyFileSync(path.join(folder, "mxgen.wasm"), path.join(work, "mxgen.wasm"));
}

/** Serves files of folders, the first that has one, and texts by their names. */
export async function serve(folders, texts = {}) {
    const server = http.createServer(({ url }, response) => {
        const name = decodeURIComponent(new URL(url, "http://x").pathname).slice(1);
        const file = folders.map(folder => path.join(folder, name)).find(file => fs.existsSync(file) && fs.statSync(file).isFile());
        const content = texts[name] ?? (file && fs.readFileSync(file));
        response.writeHead(content === undefined ? 404 : 200, { "Content-Type": TYPES[path.extname(name)] ?? "text/plain" }).end(content);
    });
    await new Promise(resolve => server.listen(0, "127.0.0.1", resolve));
    return { address: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}

/** The sky as a file of the Radiance format, whose pixels have three mantissas and a common exponent. */
export function writeSky(file) {
    const { width, height, pixels } = makeSky().radiance[0], bytes = Buffer.alloc(4 * width * height);
    for (let i = 0; i < bytes.length; i += 4) {
        const rgb = pixels.subarray(i, i + 3), exponent = Math.floor(Math.log2(Math.max(...rgb))) + 1;
        bytes.set([...Array.from(rgb, x => x / 2 ** exponent * 256), exponent + 128], i);
    }
    fs.writeFileSync(file, Buffer.concat([Buffer.from(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`), bytes]));
}

// In a page: the bytes of PNG files.
const PIXELS = files => `Promise.all(${JSON.stringify(files.map(file => fs.readFileSync(file).toString("base64")))}.map(async text => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(text), letter => letter.charCodeAt(0))], { type: "image/png" }), { colorSpaceConversion: "none" });
    const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, image.width, image.height);
}))`;

/** Mean absolute difference of two PNG files over black in the pixels that one of them covers, from 0 to 255, and the part of those that one alone covers. */
export const difference = (page, ...files) => page.evaluate(`(async () => {
    const [one, other] = (await ${PIXELS(files)}).map(({ data }) => data);
    let sum = 0, count = 0, alone = 0;
    for (let i = 0; i < one.length; i += 4) {
        alone += (one[i + 3] > 0) !== (other[i + 3] > 0);
        if (!one[i + 3] && !other[i + 3])
            continue;
        count++;
        for (let c = 0; c < 3; c++)
            sum += Math.abs(one[i + c] * one[i + 3] - other[i + c] * other[i + 3]) / (3 * 255);
    }
    return { mean: sum / count, alone: alone / count };
})()`);

/** Red, green, blue and alpha of a PNG file at a place. */
export const pixel = (page, file, x, y) => page.evaluate(`(async () => {
    const [{ width, data }] = await ${PIXELS([file])};
    return Array.from(data.subarray(4 * (width * ${y} + ${x}), 4 * (width * ${y} + ${x}) + 4));
})()`);

/** Draws a material of a document with `mxgen render`, as studio.js does. Throws what the program says. */
export function render(program, document, sky, picture, options = []) {
    execFileSync(program, ["render", document, "-m", "sphere", "-s", "256", "--camera", "25,16,5,30", "--background", "none", "--environment", sky, ...options, "-o", picture],
                 { stdio: "pipe" });
}
