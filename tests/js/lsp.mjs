#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
// `mxgen lsp` by the npm package in the folder MXGEN_PACKAGE: the same arguments, and messages behind the same headers. MXGEN_MESSAGES is the
// page to which codes link.

import fs from "node:fs/promises";
import path from "node:path";
import { pathToFileURL } from "node:url";

const { load } = await import(pathToFileURL(path.join(process.env.MXGEN_PACKAGE, "node.js")));
const includeRoots = process.argv.slice(2).filter((_, index, words) => words[index - 1] === "--include-root");

async function listFolder(folder) {
    const names = await fs.readdir(folder).catch(() => null);
    return names && Promise.all(names.map(async name => await fs.stat(path.join(folder, name)).then(info => info.isDirectory(), () => false) ? `${name}/` : name));
}

const server = (await load()).createLanguageServer({
    includeRoots, listFolder, messagesUrl: process.env.MXGEN_MESSAGES,
    readFile: name => fs.readFile(name).catch(() => null),
    send: message => {
        const body = Buffer.from(JSON.stringify(message));
        process.stdout.write(`Content-Length: ${body.length}\r\n\r\n`);
        process.stdout.write(body);
    },
});

let input = Buffer.alloc(0), isShutDown = false;
process.stdin.on("data", data => {
    input = Buffer.concat([input, data]);
    for (let end; (end = input.indexOf("\r\n\r\n")) >= 0;) {
        const size = Number(/Content-Length: (\d+)/i.exec(input.toString("latin1", 0, end))[1]), body = input.subarray(end + 4, end + 4 + size).toString();
        if (input.length < end + 4 + size)
            return;
        input = input.subarray(end + 4 + size);
        const { method } = /^\{"/.test(body) ? JSON.parse(body) : {};
        isShutDown ||= method === "shutdown";
        const done = server.handle(body);
        if (method === "exit")
            void done.then(() => process.exit(isShutDown ? 0 : 1));
    }
});
