// SPDX-License-Identifier: Apache-2.0
// The files that documents name. What the editor has open stands for the file on the disk.

import * as vscode from "vscode";

import { resolve } from "./library";

/** The settings of a folder that are paths, absolute; relative ones begin at the first folder of the workspace. */
export function settingPaths(key: string): vscode.Uri[] {
    const base = vscode.workspace.workspaceFolders?.[0]?.uri;
    const paths = vscode.workspace.getConfiguration("mxgen").get<string[] | string>(key, []);
    return [paths].flat().filter(path => path).flatMap(path => {
        if (/^(\/|[A-Za-z]:[\\/])/.test(path))
            return [base?.with({ path: vscode.Uri.file(path).path }) ?? vscode.Uri.file(path)];
        return base ? [vscode.Uri.joinPath(base, path)] : [];
    });
}

/** The address of `ref` beside the file `from`, as the editor writes it; null: it has none. */
export function join(from: string, ref: string): string | null {
    const address = resolve(from, ref);
    return address && vscode.Uri.parse(address).toString();
}

const LIBRARY_FILE = /\.(mtlx|glsl|inline|h)$/, MAX_LIBRARY_FILES = 2000;

/** A file of a library: its address and its bytes. */
export type LibraryFile = [name: string, content: Uint8Array<ArrayBuffer>];

async function readBelow(uri: vscode.Uri, found: LibraryFile[]): Promise<void> {
    const { type } = await vscode.workspace.fs.stat(uri);
    if (!(type & vscode.FileType.Directory)) {
        found.push([uri.toString(), new Uint8Array(await vscode.workspace.fs.readFile(uri))]);
        return;
    }
    for (const [name, kind] of (await vscode.workspace.fs.readDirectory(uri)).sort())
        if (found.length < MAX_LIBRARY_FILES && (kind & vscode.FileType.Directory || LIBRARY_FILE.test(name)))
            await readBelow(vscode.Uri.joinPath(uri, name), found);
}

/** The files of the libraries in the settings; those that are not there are left out. */
export async function readLibraries(): Promise<LibraryFile[]> {
    const found: LibraryFile[] = [];
    for (const uri of settingPaths("libraries"))
        await readBelow(uri, found).catch(() => {});
    return found;
}

function isBelow(uri: vscode.Uri, folder: vscode.Uri): boolean {
    return uri.scheme === folder.scheme && uri.authority === folder.authority && uri.path.startsWith(folder.path.replace(/\/?$/, "/"));
}

/** Whether a document may read a file: it is below the document's folder, a folder of the workspace, or one of the settings. */
function mayRead(document: vscode.Uri, file: vscode.Uri): boolean {
    const folders = (vscode.workspace.workspaceFolders ?? []).map(({ uri }) => uri);
    return [vscode.Uri.joinPath(document, ".."), ...folders, ...settingPaths("includeRoots")].some(folder => isBelow(file, folder));
}

/** The bytes of a file; null: there is none that the document may read. */
export async function readFile(document: vscode.Uri, name: string): Promise<Uint8Array<ArrayBuffer> | null> {
    const uri = vscode.Uri.parse(name);
    if (!mayRead(document, uri))
        return null;
    const open = vscode.workspace.textDocuments.find(one => one.uri.toString() === uri.toString());
    if (open)
        return new TextEncoder().encode(open.getText());
    try {
        return new Uint8Array(await vscode.workspace.fs.readFile(uri));
    } catch {
        return null;
    }
}
