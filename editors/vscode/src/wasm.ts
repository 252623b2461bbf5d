// SPDX-License-Identifier: Apache-2.0
// The language server as WebAssembly (worker.ts), from the side of the extension: its files come from VS Code.

import * as vscode from "vscode";
import type { BaseLanguageClient, LanguageClientOptions } from "vscode-languageclient";

import { readLibraries, settingPaths } from "./files";
import { LIST_FOLDER, READ_FILE, type ServerStart } from "./messages";

/** The server knows files of the disk alone: an address of another scheme is the path "/scheme+authority/path". */
export function toServer(uri: vscode.Uri): vscode.Uri {
    return uri.scheme === "file" || uri.scheme === "untitled" ? uri : vscode.Uri.from({ scheme: "file", path: `/${uri.scheme}+${uri.authority}${uri.path}` });
}

export function fromServer(uri: vscode.Uri): vscode.Uri {
    const [, scheme, authority, path] = /^\/([a-z][a-z0-9.-]*)\+([^/]*)(\/.*)$/.exec(uri.path) ?? [];
    return scheme && uri.scheme === "file" ? vscode.Uri.from({ scheme, authority, path }) : uri;
}

/** The result of `find` for the address of a path; null if it fails. */
async function at<Found>(path: string, find: (uri: vscode.Uri) => Promise<Found>): Promise<Found | null> {
    try {
        return await find(fromServer(vscode.Uri.from({ scheme: "file", path })));
    } catch {
        return null;
    }
}

const { fs } = vscode.workspace;
const read = (uri: vscode.Uri) => Promise.resolve(fs.readFile(uri)).then(bytes => new Uint8Array(bytes));
const list = async (uri: vscode.Uri) => (await fs.readDirectory(uri)).map(([name, type]) => type & vscode.FileType.Directory ? `${name}/` : name);

/** Starts a client whose server is in a worker that did not get a message yet. */
export async function startWorker(extension: vscode.Uri, worker: { postMessage(message: ServerStart): void }, client: BaseLanguageClient): Promise<void> {
    worker.postMessage({ wasm: await read(vscode.Uri.joinPath(extension, "dist", "mxgen.wasm")), libraries: await readLibraries(),
        includeRoots: settingPaths("includeRoots").map(uri => toServer(uri).path) });
    client.onRequest(READ_FILE, ({ path }) => at(path, read));
    client.onRequest(LIST_FOLDER, ({ path }) => at(path, list));
    await client.start();
}

export const clientOptions: LanguageClientOptions = {
    documentSelector: [{ language: "materialx" }],
    revealOutputChannelOn: 4, // never; a constant of both editions of the package
    uriConverters: { code2Protocol: uri => toServer(uri).toString(), protocol2Code: text => fromServer(vscode.Uri.parse(text)) },
};
