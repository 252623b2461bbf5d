// SPDX-License-Identifier: Apache-2.0
// Boxes of colours before the values of colours, with the browser's picker.

import { Decoration, WidgetType } from "@codemirror/view";

import { changesOf, rangeOf, spanOf } from "./client.js";
import { decorations } from "./decorations.js";

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

export const colours = client => decorations(() => client.ask("documentColor"), (doc, { range, color }) => {
    const { from, to } = spanOf(doc, range);
    return Decoration.widget({ widget: new Box(client, color, to - from), side: -1 }).range(from);
});
