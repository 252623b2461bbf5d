// SPDX-License-Identifier: Apache-2.0
// Messages in the text, with their quick fixes.

import { setDiagnostics } from "@codemirror/lint";

import { changesOf, rangeOf, spanOf, URI } from "./client.js";

const CLASSES = { 1: "unnecessary", 2: "deprecated" }; // tags of the protocol

/** Changes the document as the server says; files that it includes are not the page's to write. */
export function applyEdit(view, { changes }, userEvent) {
    const edits = changes[URI];
    if (edits)
        view.dispatch({ changes: changesOf(view.state.doc, edits), userEvent, scrollIntoView: true });
    return Object.keys(changes).filter(uri => uri !== URI).map(uri => decodeURIComponent(uri.slice(uri.lastIndexOf("/") + 1)));
}

/** Messages are the same if they say the same of the same place. */
const keyOf = ({ range, code, message }) => JSON.stringify([range.start.line, range.start.character, range.end.line, range.end.character, code, message]);

function messageOf(item) {
    const made = document.createElement("div"), code = document.createElement("span");
    code.className = "code";
    code.textContent = item.code;
    made.append(item.message, " ", code);
    for (const { message } of item.relatedInformation ?? [])
        made.append(Object.assign(document.createElement("div"), { className: "note", textContent: message }));
    return made;
}

/**
 * Shows the messages of the server as they come. `onCures` hears of the fixes: where a message begins, its id, the title of the fix, and a
 * function that applies it.
 */
export function showDiagnostics(client, view, onCures) {
    client.onDiagnostics = async ({ version, diagnostics }) => {
        if (version !== client.version)
            return;
        const { doc } = view.state;
        const actions = diagnostics.length ? await client.ask("codeAction", { range: rangeOf(doc, 0, doc.length), context: { diagnostics } }).catch(() => null) ?? [] : [];
        if (version !== client.version)
            return; // the text has changed; its messages follow
        const cures = new Map(), told = [];
        for (const { title, edit, diagnostics: cured = [] } of actions)
            for (const item of cured) {
                const key = keyOf(item), apply = () => version === client.version && applyEdit(view, edit, "input.fix");
                cures.set(key, [...cures.get(key) ?? [], { name: title, apply }]);
                told.push({ from: spanOf(doc, item.range).from, id: item.code, title, apply });
            }
        view.dispatch(setDiagnostics(view.state, diagnostics.map(item => ({
            ...spanOf(doc, item.range),
            severity: item.severity === 1 ? "error" : item.severity === 2 ? "warning" : "info",
            message: item.message,
            renderMessage: () => messageOf(item),
            markClass: (item.tags ?? []).map(tag => CLASSES[tag]).join(" ") || undefined,
            actions: cures.get(keyOf(item)),
        }))));
        onCures(told);
    };
}
