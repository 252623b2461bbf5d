// SPDX-License-Identifier: Apache-2.0
// Completion: what the language server offers, as the editor lists it.

import { pickedCompletion, snippet } from "@codemirror/autocomplete";

import { positionOf, spanOf } from "./client.js";
import { rendered } from "./markdown.js";

const LOOK_BACK = 2000; // letters in which a tag begins

/** A snippet of the protocol as one of the editor, in which only braces are special. */
export function templateOf(text) {
    return text.replace(/\\([$}\\])|\$(\d+)|\$\{(\d+)(?::((?:\\.|[^}\\])*))?\}|([{}])/g, (_, escaped, bare, number, initial, brace) => {
        if (escaped !== undefined || brace !== undefined)
            return /[{}]/.test(escaped ?? brace) ? `\\${escaped ?? brace}` : escaped;
        const field = bare ?? number;
        return field === "0" ? "${}" : `\${${field}:${(initial ?? "").replace(/\\(.)/g, "$1").replace(/[{}]/g, "\\$&")}}`;
    });
}

function optionOf({ label, filterText, sortText, detail, documentation, preselect, insertTextFormat, textEdit }) {
    const text = documentation?.value ?? documentation, insert = textEdit.newText;
    return {
        label: filterText ?? label,
        displayLabel: label,
        sortText,
        detail,
        boost: preselect ? 50 : 0,
        info: text ? () => rendered(text) : undefined,
        apply: insertTextFormat === 2
            ? snippet(templateOf(insert))
            : (view, completion, from, to) => view.dispatch({ changes: { from, to, insert }, selection: { anchor: from + insert.length },
                userEvent: "input.complete", annotations: pickedCompletion.of(completion), scrollIntoView: true }),
    };
}

/** True where the letters before the cursor ask for a list: in a tag, or behind the sign that begins one. */
function isAsked(state, pos) {
    const before = state.sliceDoc(Math.max(0, pos - LOOK_BACK), pos);
    return /[\w:<"'/ ]$/.test(before) && before.lastIndexOf("<") > before.lastIndexOf(">");
}

/** The source of the editor's completions. */
export function completionSource(client) {
    return async context => {
        const { state, pos, explicit } = context;
        if (!explicit && !isAsked(state, pos))
            return null;
        const list = await client.ask("completion", { position: positionOf(state.doc, pos) }).catch(() => null);
        if (context.aborted || !list?.items.length)
            return null;
        const { from, to } = spanOf(state.doc, list.items[0].textEdit.range);
        return { from, to: Math.max(to, pos), options: list.items.map(optionOf), validFor: list.isIncomplete ? undefined : /^[\w:.-]*$/ };
    };
}
