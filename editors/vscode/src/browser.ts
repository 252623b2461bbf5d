// SPDX-License-Identifier: Apache-2.0
// The entry in browsers, which start no programs.

import type { ExtensionContext } from "vscode";

import { startBuiltin } from "./builtin";
import { start } from "./extension";

export function activate(context: ExtensionContext): void {
    context.subscriptions.push(startBuiltin(start(context)));
}
