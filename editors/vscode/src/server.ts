// SPDX-License-Identifier: Apache-2.0
// The language server: `mxgen lsp` over standard input and output, or the module of WebAssembly in a thread.

import { execFile } from "node:child_process";
import { promisify } from "node:util";
import { Worker } from "node:worker_threads";
import * as vscode from "vscode";
import { AbstractMessageReader, AbstractMessageWriter, type DataCallback, Disposable, LanguageClient, type Message, RevealOutputChannelOn } from "vscode-languageclient/node";

import { settingPaths } from "./files";
import type { Stoppable } from "./language";
import { clientOptions, startWorker } from "./wasm";

/** The options of the program that stand in the settings. */
export function programOptions(): string[] {
    return [...settingPaths("libraries").flatMap(({ fsPath }) => ["--library", fsPath]),
        ...settingPaths("includeRoots").flatMap(({ fsPath }) => ["--include-root", fsPath])];
}

export const programPath = () => vscode.workspace.getConfiguration("mxgen").get("path", "mxgen");

/** Starts the server. Throws if the program does not start. */
export async function startServer(): Promise<LanguageClient> {
    await promisify(execFile)(programPath(), ["--version"]); // the client would tell a failure in its own words
    const reference = settingPaths("reference").flatMap(({ fsPath }) => ["--reference", fsPath]);
    const client = new LanguageClient("mxgen", "MaterialX (mxgen)",
        { command: programPath(), args: ["lsp", ...programOptions(), ...reference] },
        {
            documentSelector: [{ language: "materialx", scheme: "file" }, { language: "materialx", scheme: "untitled" }],
            revealOutputChannelOn: RevealOutputChannelOn.Never,
            initializationOptions: { renderCommand: "mxgen.render" },
            initializationFailedHandler: () => false,
        });
    await client.start();
    return client;
}

// The globals of a worker in a browser, in a thread of Node.
const GLOBALS = `const { parentPort, workerData } = require("node:worker_threads");
    Object.assign(globalThis, { onmessage: null, postMessage: message => parentPort.postMessage(message) });
    parentPort.on("message", data => globalThis.onmessage({ data }));
    require(workerData);`;

class Reader extends AbstractMessageReader {
    constructor(private readonly worker: Worker) {
        super();
        worker.on("error", error => this.fireError(error));
    }

    listen(hear: DataCallback): Disposable {
        this.worker.on("message", hear);
        return Disposable.create(() => this.worker.off("message", hear));
    }
}

class Writer extends AbstractMessageWriter {
    constructor(private readonly worker: Worker) {
        super();
    }

    async write(message: Message): Promise<void> {
        this.worker.postMessage(message);
    }

    end(): void {}
}

/** Starts the server as WebAssembly. */
export async function startThread(extension: vscode.Uri): Promise<Stoppable> {
    const worker = new Worker(GLOBALS, { eval: true, workerData: vscode.Uri.joinPath(extension, "dist", "worker.js").fsPath });
    const client = new LanguageClient("mxgen", "MaterialX (mxgen)", async () => ({ reader: new Reader(worker), writer: new Writer(worker) }), clientOptions);
    await startWorker(extension, worker, client);
    return { dispose: () => client.dispose().finally(() => worker.terminate()) };
}
