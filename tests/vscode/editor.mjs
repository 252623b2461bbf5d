// SPDX-License-Identifier: Apache-2.0
// A real VS Code with the extension: the server of npm's code-server, and its workbench in headless Chromium.

import { execFileSync, spawn } from "node:child_process";
import fs from "node:fs";
import path from "node:path";

const TIMEOUT = 60_000; // milliseconds

async function until(what, find) {
    const end = Date.now() + TIMEOUT;
    for (;;) {
        const found = await find();
        if (found)
            return found;
        if (Date.now() > end)
            throw new Error(`waited in vain for ${what}`);
        await new Promise(resolve => setTimeout(resolve, 100));
    }
}

/** The server, with folders of its own. It runs without its native modules: they watch files and end the host with its parent. */
export class Server {
    #process;
    #folder;
    #output = "";
    #isTrusted = false; // the folder, by the window before

    constructor(code, extension, folder) {
        const main = path.join(code, "out/server-main.js");
        const options = ["--accept-server-license-terms", "--server-data-dir", path.join(folder, "data"), "--extensions-dir", path.join(folder, "extensions")];
        this.#folder = folder;
        execFileSync(process.execPath, [main, ...options, "--install-extension", extension], { stdio: "pipe" });
        this.#process = spawn(process.execPath, [main, ...options, "--without-connection-token", "--host", "127.0.0.1", "--port", "0", "--telemetry-level", "off"],
            { stdio: ["ignore", "pipe", "ignore"] });
        this.#process.stdout.on("data", data => { this.#output += data; });
    }

    /** The settings of windows that open later. */
    set settings(settings) {
        fs.mkdirSync(path.join(this.#folder, "data/data/Machine"), { recursive: true });
        fs.writeFileSync(path.join(this.#folder, "data/data/Machine/settings.json"), JSON.stringify(settings));
    }

    /** A window with a folder, which it trusts, and a file of it; the folder is always the same. */
    async open(browser, folder, file, size) {
        const [, port] = await until("the server", () => /listening on (\d+)/.exec(this.#output));
        const payload = JSON.stringify([["openFile", `vscode-remote://localhost:${port}${path.join(folder, file)}`]]);
        const editor = new Editor(await browser.open(`http://localhost:${port}/?folder=${encodeURIComponent(folder)}&payload=${encodeURIComponent(payload)}`, size));
        await editor.until("document.querySelector('.monaco-editor .view-line')");
        if (!this.#isTrusted) {
            await editor.press("[...document.querySelectorAll('.monaco-button')].find(one => one.textContent.startsWith('Yes'))");
            await editor.until("!document.querySelector('.monaco-dialog-box')");
        }
        this.#isTrusted = true;
        return editor;
    }

    close() {
        this.#process.kill();
    }
}

// In the window: the page of the preview.
const VIEW = "document.querySelector('iframe.webview')?.contentDocument?.getElementById('active-frame')?.contentDocument";

export class Editor {
    constructor(page) {
        this.page = page;
    }

    evaluate(expression) {
        return this.page.evaluate(expression);
    }

    until(expression) {
        this.page.complaints = []; // VS Code has many
        return this.page.until(expression).catch(error => { throw new Error(error.message.slice(0, 1000)); });
    }

    /** The value of an expression in the preview, where `document` is its document. */
    view(expression) {
        return this.evaluate(`(document => (${expression}))(${VIEW})`);
    }

    untilView(expression) {
        return this.until(`(document => document && (${expression}))(${VIEW})`);
    }

    async click(x, y) {
        for (const type of ["mouseMoved", "mousePressed", "mouseReleased"])
            await this.page.send("Input.dispatchMouseEvent", { type, x, y, button: type === "mouseMoved" ? "none" : "left", clickCount: 1 });
    }

    /** Clicks on the element of an expression. */
    async press(expression) {
        await this.until(expression);
        const { x, y } = await this.evaluate(`(({ x, y, width, height }) => ({ x: x + width / 2, y: y + height / 2 }))((${expression}).getBoundingClientRect())`);
        await this.click(x, y);
    }

    /** Puts the cursor into a line of the text that shows, at its end. */
    async pressLine(text) {
        const line = `[...document.querySelectorAll(".view-line")].find(one => one.textContent.replaceAll("\\u00a0", " ").includes(${JSON.stringify(text)}))?.firstChild`;
        await this.until(line);
        const { x, y, height } = await this.evaluate(`(({ x, y, height }) => ({ x, y, height }))((${line}).getBoundingClientRect())`);
        await this.click(x + 2, y + height / 2);
    }

    async type(text) {
        await this.page.send("Input.insertText", { text });
    }

    async key(key, code, number, modifiers = 0) {
        for (const type of ["rawKeyDown", "keyUp"])
            await this.page.send("Input.dispatchKeyEvent", { type, key, code, windowsVirtualKeyCode: number, modifiers });
    }

    screenshot(file) {
        return this.page.screenshot(file);
    }

    close() {
        return this.page.close();
    }
}
