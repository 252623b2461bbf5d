// SPDX-License-Identifier: Apache-2.0
// What the server knows about places of the text, shown there.

import { StateEffect, StateField } from "@codemirror/state";
import { Decoration, EditorView, ViewPlugin } from "@codemirror/view";

const PAUSE = 300; // milliseconds after a change

/**
 * `request(view)` asks the server, and `make(doc, item)` makes a decoration of each item of its answer. They move with the text until the next answer comes,
 * after a pause in which nothing changes: no text and, where `follows` is true, no selection.
 */
export function decorations(request, make, follows = false) {
    const setAll = StateEffect.define();
    const field = StateField.define({
        create: () => Decoration.none,
        update(value, transaction) {
            const found = transaction.effects.find(effect => effect.is(setAll));
            return found ? found.value : value.map(transaction.changes);
        },
        provide: shown => EditorView.decorations.from(shown),
    });
    const plugin = ViewPlugin.define(view => {
        let timer = 0;
        const show = async () => {
            const { state } = view, found = await request(view).catch(() => null);
            const isOld = state.doc !== view.state.doc || (follows && !state.selection.eq(view.state.selection));
            if (found && !isOld)
                view.dispatch({ effects: setAll.of(Decoration.set(found.map(item => make(state.doc, item)), true)) });
        };
        const ask = pause => {
            clearTimeout(timer);
            timer = setTimeout(show, pause);
        };
        ask(0);
        return { update: update => (update.docChanged || (follows && update.selectionSet)) && ask(PAUSE), destroy: () => clearTimeout(timer) };
    });
    return [field, plugin];
}
