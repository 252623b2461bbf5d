// SPDX-License-Identifier: Apache-2.0
// Boxes of colours before the values of colours, with the browser's picker.

import { StateEffect, StateField } from "@codemirror/state";
import { Decoration, EditorView, ViewPlugin, WidgetType } from "@codemirror/view";

import { changesOf, rangeOf, spanOf } from "./client.js";

const PAUSE = 300; // milliseconds after a change

const toHex = ({ red, green, blue }) => "#" + [red, green, blue].map(x => Math.round(255 * x).toString(16).padStart(2, "0")).join("");

class Box extends WidgetType {
    constructor(client, colour, length) {
        super();
        Object.assign(this, { client, colour, length });
    }

    eq(other) {
        return toHex(other.colour) === toHex(this.colour) && other.length === this.length;
    }

    toDOM(view) {
        const box = document.createElement("input");
        Object.assign(box, { type: "color", value: toHex(this.colour), className: "colour", title: "Pick a colour", tabIndex: -1 });
        box.setAttribute("aria-label", "Colour of the value");
        box.addEventListener("change", () => this.#pick(view, box));
        return box;
    }

    /** The server writes the colour in the space of the value. */
    async #pick(view, box) {
        const { doc } = view.state, from = view.posAtDOM(box);
        const [red, green, blue] = [1, 3, 5].map(at => parseInt(box.value.slice(at, at + 2), 16) / 255);
        const answers = await this.client.ask("colorPresentation", { color: { ...this.colour, red, green, blue }, range: rangeOf(doc, from, from + this.length) }).catch(() => null);
        if (answers?.length && doc === view.state.doc)
            view.dispatch({ changes: changesOf(doc, [answers[0].textEdit]), userEvent: "input.colour" });
    }

    ignoreEvent() {
        return true;
    }
}

const setBoxes = StateEffect.define();
const boxes = StateField.define({
    create: () => Decoration.none,
    update(value, transaction) {
        const found = transaction.effects.find(effect => effect.is(setBoxes));
        return found ? found.value : value.map(transaction.changes);
    },
    provide: field => EditorView.decorations.from(field),
});

export function colours(client) {
    return [boxes, ViewPlugin.define(view => {
        let timer = 0;
        const show = async () => {
            const { doc } = view.state, found = await client.ask("documentColor").catch(() => null);
            if (!found || doc !== view.state.doc)
                return;
            const made = found.map(({ range, color }) => {
                const { from, to } = spanOf(doc, range);
                return Decoration.widget({ widget: new Box(client, color, to - from), side: -1 }).range(from);
            });
            view.dispatch({ effects: setBoxes.of(Decoration.set(made, true)) });
        };
        const ask = pause => {
            clearTimeout(timer);
            timer = setTimeout(show, pause);
        };
        ask(0);
        return { update: update => update.docChanged && ask(PAUSE), destroy: () => clearTimeout(timer) };
    })];
}
