// SPDX-License-Identifier: Apache-2.0
// The life of the language server: it starts anew when what it reads at its start changes.

import * as vscode from "vscode";

import { register } from "./extension";

/** The server of documents. Its end may take time. */
export interface Stoppable {
    dispose(): unknown;
}

export class Language implements vscode.Disposable {
    #server: Stoppable | null = null;
    #turn: Promise<void> = Promise.resolve();

    /** `settings` are names behind "mxgen.". */
    constructor(context: vscode.ExtensionContext, settings: string[], private readonly start: () => Promise<Stoppable>) {
        const restart = () => this.restart();
        context.subscriptions.push(this,
            register("mxgen.restart", restart),
            vscode.workspace.onDidGrantWorkspaceTrust(restart),
            vscode.workspace.onDidChangeConfiguration(event => {
                if (settings.some(key => event.affectsConfiguration(`mxgen.${key}`)))
                    void restart();
            }));
    }

    /** Starts anew, after the starts before. */
    restart(): Promise<void> {
        return this.#turn = this.#turn.catch(() => {}).then(async () => {
            await this.stop().catch(() => {}); // a server that does not answer ends, too
            this.#server = await this.start();
        });
    }

    async stop(): Promise<void> {
        const server = this.#server;
        this.#server = null;
        await server?.dispose();
    }

    dispose(): void {
        void this.stop();
    }
}
