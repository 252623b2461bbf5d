// SPDX-License-Identifier: Apache-2.0
// The language server as WebAssembly, in a worker. Beside the messages of the protocol it sends the requests READ_FILE and LIST_FOLDER.

import type { FolderContent, LanguageServer } from "mxgen";
import { instantiate } from "mxgen";

import { loadLibraries, resolve } from "./library";
import { LIST_FOLDER, READ_FILE, type ServerStart } from "./messages";

const waiting = new Map<unknown, (result: any) => void>();
let server: Promise<LanguageServer> | null = null;

function ask<Answer>(method: string, path: string): Promise<Answer> {
    return new Promise(done => {
        const id = `${method} ${path}`; // nobody asks twice at a time
        waiting.set(id, done);
        postMessage({ jsonrpc: "2.0", id, method, params: { path } });
    });
}

async function start({ wasm, libraries, includeRoots }: ServerStart): Promise<LanguageServer> {
    const mxgen = await instantiate(wasm), files = new Map(libraries);
    const context = mxgen.createContext({ resolver: (from, ref) => {
        const name = resolve(from, ref), data = name !== null && files.get(name);
        return data ? { name, data } : null;
    } });
    return mxgen.createLanguageServer({
        includeRoots, library: loadLibraries(context, files.keys()) ?? context.library,
        send: message => postMessage(message),
        readFile: path => ask<Uint8Array | null>(READ_FILE, path),
        listFolder: path => ask<FolderContent>(LIST_FOLDER, path),
    });
}

onmessage = async ({ data }) => {
    if (!server) {
        server = start(data);
        server.catch(error => setTimeout(() => { throw error; })); // the client hears of it
        return;
    }
    const done = data.method === undefined && waiting.get(data.id);
    if (done) {
        waiting.delete(data.id);
        done(data.result ?? null);
    } else {
        await (await server).handle(data);
    }
};
