// SPDX-License-Identifier: Apache-2.0
// Chromium without a display, driven over a pipe by the DevTools protocol.

import { spawn } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";

const TIMEOUT = 120_000; // milliseconds: of one wait, on a busy machine

/** Options for WebGPU in software. */
export const WEBGPU = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan", "--use-vulkan=swiftshader"];

export class Browser {
    #process;
    #folder;
    #next = 1;
    #waiting = new Map();
    #listeners = new Map();
    #rest = Buffer.alloc(0);

    constructor(program, options = []) {
        this.#folder = fs.mkdtempSync(path.join(os.tmpdir(), "mxgen-web-"));
        this.#process = spawn(program, ["--headless", "--no-sandbox", "--remote-debugging-pipe", "--hide-scrollbars", "--force-color-profile=srgb",
            "--use-angle=swiftshader", "--enable-unsafe-swiftshader", `--user-data-dir=${this.#folder}`, ...options, "about:blank"],
            { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
        this.#process.stdio[4].on("data", data => this.#receive(data));
        this.#process.on("exit", () => {
            for (const { reject } of this.#waiting.values())
                reject(new Error("Chromium ended"));
        });
    }

    #receive(data) {
        this.#rest = Buffer.concat([this.#rest, data]);
        for (let end; (end = this.#rest.indexOf(0)) >= 0; this.#rest = this.#rest.subarray(end + 1)) {
            const { id, result, error, method, params, sessionId } = JSON.parse(this.#rest.subarray(0, end).toString());
            if (method)
                this.#listeners.get(sessionId)?.(method, params);
            else if (this.#waiting.has(id)) {
                const { resolve, reject } = this.#waiting.get(id);
                this.#waiting.delete(id);
                if (error)
                    reject(new Error(error.message));
                else
                    resolve(result);
            }
        }
    }

    send(method, params = {}, sessionId = undefined) {
        const id = this.#next++;
        return new Promise((resolve, reject) => {
            this.#waiting.set(id, { resolve, reject });
            this.#process.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
        });
    }

    async open(address, { width = 1200, height = 800 } = {}) {
        const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
        const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
        const page = new Page(this, sessionId, targetId);
        this.#listeners.set(sessionId, (method, params) => page.hear(method, params));
        for (const domain of ["Page", "Runtime", "Log"])
            await page.send(`${domain}.enable`);
        await page.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
        await page.send("Page.navigate", { url: address });
        return page;
    }

    async close() {
        const ended = new Promise(resolve => this.#process.on("exit", resolve));
        await this.send("Browser.close").catch(() => {});
        await ended;
        fs.rmSync(this.#folder, { recursive: true, force: true, maxRetries: 5 });
    }
}

export class Page {
    /** The messages of the console. */
    complaints = [];
    #browser;
    #session;
    #target;

    constructor(browser, session, target) {
        this.#browser = browser;
        this.#session = session;
        this.#target = target;
    }

    hear(method, params) {
        if (method === "Runtime.exceptionThrown")
            this.complaints.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
        if (method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(params.type))
            this.complaints.push(params.args.map(({ value, description }) => value ?? description).join(" "));
        if (method === "Log.entryAdded" && ["error", "warning"].includes(params.entry.level))
            this.complaints.push(params.entry.text);
    }

    send(method, params) {
        return this.#browser.send(method, params, this.#session);
    }

    /** The value of an expression in the page. */
    async evaluate(expression) {
        const { result, exceptionDetails } = await this.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
        if (exceptionDetails)
            throw new Error(`${expression}: ${exceptionDetails.exception?.description ?? exceptionDetails.text}`);
        return result.value;
    }

    /** Waits until an expression is true. */
    async until(expression) {
        const end = Date.now() + TIMEOUT;
        for (;;) {
            if (await this.evaluate(`document.readyState === "complete" && Boolean(${expression})`).catch(() => false))
                return;
            if (Date.now() > end)
                throw new Error(`waited in vain for: ${expression}; the page says: ${await this.evaluate("document.body.innerText.slice(0, 2000)")}; console: ${this.complaints.join("\n")}`);
            await new Promise(resolve => setTimeout(resolve, 30));
        }
    }

    /** Letters go where the focus is. */
    insert(text) {
        return this.send("Input.insertText", { text });
    }

    /** A key as DOM names it; `modifiers` are the sum of 1 (Alt), 2 (Ctrl), 4 (Meta) and 8 (Shift). */
    async key(key, modifiers = 0) {
        const code = { Enter: 13, Escape: 27, F2: 113, F8: 119, F12: 123 }[key] ?? key.toUpperCase().charCodeAt(0);
        const event = { key, code: key.length === 1 ? `Key${key.toUpperCase()}` : key, windowsVirtualKeyCode: code, modifiers, text: key === "Enter" ? "\r" : undefined };
        await this.send("Input.dispatchKeyEvent", { type: event.text ? "keyDown" : "rawKeyDown", ...event });
        await this.send("Input.dispatchKeyEvent", { type: "keyUp", ...event, text: undefined });
    }

    /** Moves the mouse to a point, from beside it, and clicks if `clicks` says so. */
    async point([x, y], { clicks = false, modifiers = 0 } = {}) {
        await this.send("Input.dispatchMouseEvent", { type: "mouseMoved", x: x - 3, y, modifiers });
        await this.send("Input.dispatchMouseEvent", { type: "mouseMoved", x, y, modifiers });
        for (const type of clicks ? ["mousePressed", "mouseReleased"] : [])
            await this.send("Input.dispatchMouseEvent", { type, x, y, button: "left", clickCount: 1, modifiers });
    }

    async screenshot(file) {
        const { data } = await this.send("Page.captureScreenshot", { format: "png" });
        fs.writeFileSync(file, Buffer.from(data, "base64"));
    }

    async close() {
        await this.#browser.send("Target.closeTarget", { targetId: this.#target });
    }
}
