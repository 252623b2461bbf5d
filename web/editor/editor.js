// SPDX-License-Identifier: Apache-2.0
// The editor, which the page loads after its picture. It stands in a shadow tree, whose style sheets no content security policy forbids.

import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab, isolateHistory, redo, redoDepth, undo, undoDepth } from "@codemirror/commands";
import { autoCloseTags, xmlLanguage } from "@codemirror/lang-xml";
import { codeFolding, foldKeymap, indentOnInput } from "@codemirror/language";
import { linter, lintGutter, lintKeymap } from "@codemirror/lint";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import { EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, keymap, lineNumbers } from "@codemirror/view";

import { Client } from "./client.js";
import { colours } from "./colours.js";
import { completionSource } from "./completion.js";
import { showDiagnostics } from "./diagnostics.js";
import { hints, places } from "./hints.js";
import { format, hover, navigation } from "./navigation.js";
import { look } from "./theme.js";

/** It has `value` and events "input" as a <textarea>, and the members of PlainText (text.js). */
class MaterialText extends HTMLElement {
    #view;
    #client;
    #group = null; // of the last change by `change`

    /** `worker` has the language server; `tell` takes sentences for the user, `onCures` the fixes of messages (diagnostics.js). */
    begin({ value, selection, worker, tell, onCures }) {
        const root = this.attachShadow({ mode: "open" });
        this.#client = new Client(worker);
        const state = EditorState.create({ doc: value, selection, extensions: [this.#basics(), this.#services(tell), look] });
        this.#client.open(state.doc);
        this.#view = new EditorView({ state, root, parent: root });
        showDiagnostics(this.#client, this.#view, onCures);
    }

    #basics() {
        return [
            lineNumbers(), highlightActiveLine(), highlightActiveLineGutter(), drawSelection(), indentOnInput(), codeFolding(), history(),
            xmlLanguage, autoCloseTags, closeBrackets(), search({ top: true }), highlightSelectionMatches(),
            keymap.of([...closeBracketsKeymap, ...defaultKeymap, ...searchKeymap, ...historyKeymap, ...foldKeymap, ...completionKeymap, ...lintKeymap, indentWithTab]),
            EditorView.contentAttributes.of({ "aria-label": "MaterialX document", "spellcheck": "false", "autocapitalize": "off" }),
        ];
    }

    #services(tell) {
        return [
            autocompletion({ override: [completionSource(this.#client)], icons: false, maxRenderedOptions: 400 }),
            linter(null), lintGutter({ hoverTime: 100 }), hover(this.#client), navigation(this.#client, tell), colours(this.#client),
            hints(this.#client), places(this.#client),
            EditorView.updateListener.of(update => {
                if (!update.docChanged)
                    return;
                this.#client.change(update.startState.doc, update.state.doc, update.changes);
                this.dispatchEvent(new Event("input"));
            }),
        ];
    }

    get value() {
        return this.#view.state.doc.toString();
    }

    set value(text) {
        this.#group = null;
        this.#view.dispatch({ changes: { from: 0, to: this.#view.state.doc.length, insert: text }, selection: { anchor: 0 }, userEvent: "input.open",
            annotations: isolateHistory.of("full"), scrollIntoView: true });
    }

    /** A change of one place; those of the same group that follow each other closely are undone together. */
    change({ start, end, text }, group) {
        const isolated = group === this.#group ? [] : [isolateHistory.of("before")];
        this.#group = group;
        this.#view.dispatch({ changes: { from: start, to: end, insert: text }, userEvent: "input.type.control", annotations: isolated });
    }

    select(start, end) {
        const { length } = this.#view.state.doc, anchor = Math.min(start, length), head = Math.min(end, length);
        this.#view.dispatch({ selection: { anchor, head }, effects: EditorView.scrollIntoView(anchor, { y: "center" }) });
        this.#view.focus();
    }

    undo() {
        this.#group = null;
        undo(this.#view);
    }

    redo() {
        this.#group = null;
        redo(this.#view);
    }

    get canUndo() {
        return undoDepth(this.#view.state) > 0;
    }

    get canRedo() {
        return redoDepth(this.#view.state) > 0;
    }

    format() {
        return format(this.#client, this.#view);
    }

    filesChanged() {
        this.#client.filesChanged();
    }
}

customElements.define("material-text", MaterialText);
globalThis.mxgenEditor(MaterialText);
