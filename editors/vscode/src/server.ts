// SPDX-License-Identifier: Apache-2.0
// The language server: `mxgen lsp` over standard input and output.

import { execFile } from "node:child_process";
import { promisify } from "node:util";
import * as vscode from "vscode";
import { LanguageClient, RevealOutputChannelOn } from "vscode-languageclient/node";

import { settingPaths } from "./files";

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
