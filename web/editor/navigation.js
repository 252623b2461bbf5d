// SPDX-License-Identifier: Apache-2.0
// Hover, go to definition and to references, rename, formatting.

import { EditorView, hoverTooltip, keymap, showDialog } from "@codemirror/view";

import { changesOf, positionOf, spanOf, URI } from "./client.js";
import { applyEdit } from "./diagnostics.js";
import { rendered } from "./markdown.js";

const fileOf = uri => decodeURIComponent(uri.slice(uri.lastIndexOf("/") + 1));

export function hover(client) {
    return hoverTooltip(async (view, pos) => {
        const { doc } = view.state, answer = await client.ask("hover", { position: positionOf(doc, pos) }).catch(() => null);
        if (!answer || doc !== view.state.doc)
            return null;
        const { from, to } = answer.range ? spanOf(doc, answer.range) : { from: pos, to: pos };
        return { pos: from, end: to, above: true, create: () => ({ dom: rendered(answer.contents.value) }) };
    }, { hideOnChange: true });
}

function goTo(view, { from, to }) {
    view.dispatch({ selection: { anchor: from, head: to }, effects: EditorView.scrollIntoView(from, { y: "center" }), userEvent: "select" });
    view.focus();
}

/** Moves the cursor to what a name means. `tell` takes sentences for the user. */
async function goToDefinition(client, view, pos, tell) {
    const { doc } = view.state, answer = await client.ask("definition", { position: positionOf(doc, pos) }).catch(() => null);
    const [target] = [answer ?? []].flat();
    if (doc !== view.state.doc)
        return;
    if (!target)
        tell("Nothing in the document defines what is here.");
    else if (target.uri !== URI)
        tell(`That is in ${fileOf(target.uri)}.`);
    else
        goTo(view, spanOf(doc, target.range));
}

/** Moves the cursor to the next place of the document where the name under it stands, and from the last one to the first. */
async function goToNextReference(client, view, tell) {
    const { doc, selection } = view.state, { head } = selection.main;
    const answer = await client.ask("references", { position: positionOf(doc, head), context: { includeDeclaration: true } }).catch(() => null);
    if (doc !== view.state.doc)
        return;
    const spans = (answer ?? []).filter(({ uri }) => uri === URI).map(({ range }) => spanOf(doc, range)).sort((a, b) => a.from - b.from);
    if (!spans.length)
        tell("Here is no name that the document refers to.");
    else
        goTo(view, spans.find(({ from }) => from > head) ?? spans[0]);
}

async function rename(client, view, tell) {
    const { doc, selection } = view.state, position = positionOf(doc, selection.main.head);
    const place = await client.ask("prepareRename", { position }).catch(() => null);
    if (!place)
        return tell("Here is no name that the document can change.");
    const { from, to } = spanOf(doc, place.range ?? place);
    const { result } = showDialog(view, { label: "New name", input: { value: place.placeholder ?? doc.sliceString(from, to), name: "name" }, submitLabel: "Rename",
        focus: "input", top: true });
    const form = await result, newName = form?.elements.namedItem("name").value;
    view.focus();
    if (!newName || doc !== view.state.doc)
        return null;
    try {
        const others = applyEdit(view, await client.ask("rename", { position, newName }), "input.rename");
        return others.length ? tell(`The page does not change ${others.join(", ")}.`) : null;
    } catch (error) {
        return tell(error.message);
    }
}

/** Changes the lines that are laid out otherwise. */
export async function format(client, view) {
    const { doc } = view.state, edits = await client.ask("formatting", { options: { tabSize: 2, insertSpaces: true } });
    if (edits?.length && doc === view.state.doc)
        view.dispatch({ changes: changesOf(doc, edits), userEvent: "input.format" });
}

export function navigation(client, tell) {
    const run = work => view => {
        work(view);
        return true;
    };
    return [
        keymap.of([
            { key: "F12", run: run(view => goToDefinition(client, view, view.state.selection.main.head, tell)) },
            { key: "Shift-F12", run: run(view => goToNextReference(client, view, tell)) },
            { key: "F2", run: run(view => rename(client, view, tell)) },
            { key: "Shift-Alt-f", run: run(view => format(client, view).catch(error => tell(error.message))) },
        ]),
        EditorView.domEventHandlers({
            mousedown(event, view) {
                const pos = (event.ctrlKey || event.metaKey) && event.button === 0 ? view.posAtCoords({ x: event.clientX, y: event.clientY }) : null;
                if (pos === null)
                    return false;
                event.preventDefault();
                goToDefinition(client, view, pos, tell);
                return true;
            },
        }),
    ];
}
