// SPDX-License-Identifier: Apache-2.0
// Tests of the page share this: how they do what its users do, and see what they see.

import assert from "node:assert/strict";
import fs from "node:fs";
import http from "node:http";
import path from "node:path";

export const RED = `<?xml version="1.0"?>
<materialx version="1.39">
  <standard_surface name="SR" type="surfaceshader">
    <input name="base_color" type="color3" value="1, 0, 0" />
    <input name="specular" type="float" value="0" />
  </standard_surface>
  <surfacematerial name="Red" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SR" />
  </surfacematerial>
</materialx>
`;

export const status = page => page.evaluate("document.getElementById('status').textContent");
export const textOf = page => page.evaluate("document.getElementById('text').value");

export const WHOLE = "document.body.dataset.whole === 'true'";

/** Does something that changes the picture at once, and waits for the whole picture. */
export async function change(page, expression) {
    await page.evaluate(expression);
    await page.until(WHOLE);
}

/** Does something that compiles the document, and waits for the whole picture. */
export async function compile(page, expression) {
    await page.evaluate(`delete document.body.dataset.compiled, ${expression}`);
    await page.until(`document.body.dataset.compiled && ${WHOLE}`);
}

export const type = (page, text) => `document.getElementById("text").value = ${JSON.stringify(text)}, document.getElementById("text").dispatchEvent(new Event("input"))`;
export const pick = (id, value) => `document.getElementById(${JSON.stringify(id)}).value = ${JSON.stringify(value)}, document.getElementById(${JSON.stringify(id)}).dispatchEvent(new Event("change"))`;

/** The mean colour of a part of the canvas around its centre, from 0 to 255. */
export const MEAN = `(() => {
    const canvas = document.getElementById("canvas"), copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
    copy.drawImage(canvas, 0, 0);
    const size = 20, { data } = copy.getImageData((canvas.width - size) / 2, (canvas.height - size) / 2 - 20, size, size);
    return [0, 1, 2].map(c => data.reduce((sum, x, i) => i % 4 === c ? sum + x : sum, 0) / (size * size));
})()`;

/** Mean absolute difference of two PNG files, from 0 to 255, by the browser. */
export const DIFFERENCE = (a, b) => `(async () => {
    const pixels = async text => {
        const image = await createImageBitmap(new Blob([Uint8Array.from(atob(text), letter => letter.charCodeAt(0))], { type: "image/png" }), { colorSpaceConversion: "none" });
        const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
        context.drawImage(image, 0, 0);
        return context.getImageData(0, 0, image.width, image.height);
    };
    const [one, other] = await Promise.all([pixels(${JSON.stringify(a)}), pixels(${JSON.stringify(b)})]);
    if (one.width !== other.width || one.height !== other.height)
        return [255, one.width, one.height];
    return [one.data.reduce((sum, x, i) => sum + Math.abs(x - other.data[i]), 0) / (one.width * one.height * 3)];
})()`;

/** Opens the page in a browser; it must not complain. */
export async function withPage(browser, address, work, size = { width: 960, height: 420 }) {
    const page = await browser.open(address, size);
    try {
        await work(page);
        assert.deepEqual(page.complaints, []);
    } finally {
        await page.close();
    }
}

/** Drops files: [name, type, text or bytes as an array]. */
export const drop = files => `(() => {
    const data = new DataTransfer();
    for (const [name, type, content] of ${JSON.stringify(files)})
        data.items.add(new File([typeof content === "string" ? content : new Uint8Array(content)], name, { type }));
    document.querySelector("main").dispatchEvent(new DragEvent("drop", { bubbles: true, cancelable: true, dataTransfer: data }));
})()`;

/** Serves a folder with a strict content security policy while `work` has its address. */
export async function withServer(folder, work) {
    const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css" };
    const server = http.createServer(({ url }, response) => {
        const name = path.basename(new URL(url, "http://x").pathname) || "index.html";
        if (!fs.readdirSync(folder).includes(name))
            return response.writeHead(404).end();
        response.writeHead(200, { "Content-Type": types[path.extname(name)],
            "Content-Security-Policy": "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src data:; worker-src blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'" });
        return response.end(fs.readFileSync(path.join(folder, name)));
    });
    await new Promise(resolve => server.listen(0, "127.0.0.1", resolve));
    try {
        await work(`http://127.0.0.1:${server.address().port}/`);
    } finally {
        server.close();
    }
}
