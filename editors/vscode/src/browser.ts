// SPDX-License-Identifier: Apache-2.0
// The entry in browsers, which start no programs: the language server is WebAssembly in a worker.

import * as vscode from "vscode";
import { LanguageClient, RevealOutputChannelOn } from "vscode-languageclient/browser";

import { start } from "./extension";
import { readLibraries, settingPaths } from "./files";
import { Language, type Stoppable } from "./language";
import { LIST_FOLDER, READ_FILE, type ServerStart } from "./messages";

/** The server knows files of the disk alone: an address of another scheme is the path "/scheme+authority/path". */
export function toServer(uri: vscode.Uri): vscode.Uri {
    return uri.scheme === "file" || uri.scheme === "untitled" ? uri : vscode.Uri.from({ scheme: "file", path: `/${uri.scheme}+${uri.authority}${uri.path}` });
}

export function fromServer(uri: vscode.Uri): vscode.Uri {
    const [, scheme, authority, path] = /^\/([a-z][a-z0-9.-]*)\+([^/]*)(\/.*)$/.exec(uri.path) ?? [];
    return scheme && uri.scheme === "file" ? vscode.Uri.from({ scheme, authority, path }) : uri;
}

const atPath = (path: string) => fromServer(vscode.Uri.from({ scheme: "file", path }));

async function read({ path }: { path: string }): Promise<Uint8Array | null> {
    try {
        return new Uint8Array(await vscode.workspace.fs.readFile(atPath(path)));
    } catch {
        return null;
    }
}

async function list({ path }: { path: string }): Promise<string[] | null> {
    try {
        return (await vscode.workspace.fs.readDirectory(atPath(path))).map(([name, type]) => type & vscode.FileType.Directory ? `${name}/` : name);
    } catch {
        return null;
    }
}

async function startServer(extension: vscode.Uri): Promise<Stoppable> {
    const [script, wasm] = await Promise.all(["worker.js", "mxgen.wasm"].map(
        async name => new Uint8Array(await vscode.workspace.fs.readFile(vscode.Uri.joinPath(extension, "dist", name)))));
    const address = URL.createObjectURL(new Blob([script], { type: "text/javascript" })), worker = new Worker(address);
    const message: ServerStart = { wasm, libraries: await readLibraries(), includeRoots: settingPaths("includeRoots").map(uri => toServer(uri).path) };
    worker.postMessage(message);
    const client = new LanguageClient("mxgen", "MaterialX (mxgen)", {
        documentSelector: [{ language: "materialx" }],
        revealOutputChannelOn: RevealOutputChannelOn.Never,
        uriConverters: { code2Protocol: uri => toServer(uri).toString(), protocol2Code: text => fromServer(vscode.Uri.parse(text)) },
    }, worker);
    client.onRequest(READ_FILE, read);
    client.onRequest(LIST_FOLDER, list);
    await client.start();
    return {
        dispose: () => client.dispose().finally(() => {
            worker.terminate();
            URL.revokeObjectURL(address);
        }),
    };
}

let language: Language | null = null;

export async function activate(context: vscode.ExtensionContext): Promise<void> {
    start(context);
    language = new Language(context, ["libraries", "includeRoots"], () => startServer(context.extensionUri));
    await language.restart();
}

export const deactivate = () => language?.stop();
