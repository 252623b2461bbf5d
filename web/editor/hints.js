// SPDX-License-Identifier: Apache-2.0
// Hints between the letters, such as the definition of a node, and marks on all places of the name under the cursor.

import { Decoration, WidgetType } from "@codemirror/view";

import { offsetAt, positionOf, rangeOf, spanOf } from "./client.js";
import { decorations } from "./decorations.js";

class Hint extends WidgetType {
    constructor(label, about) {
        super();
        Object.assign(this, { label, about });
    }

    eq(other) {
        return other.label === this.label && other.about === this.about;
    }

    toDOM() {
        const hint = document.createElement("span");
        Object.assign(hint, { className: "hint", textContent: this.label, title: this.about ?? "" });
        return hint;
    }
}

export const hints = client => decorations(
    ({ state: { doc } }) => client.ask("inlayHint", { range: rangeOf(doc, 0, doc.length) }),
    (doc, { position, label, tooltip }) => Decoration.widget({ widget: new Hint(label, tooltip), side: 1 }).range(offsetAt(doc, position)));

const place = Decoration.mark({ class: "place" });

export const places = client => decorations(
    async ({ state: { doc, selection } }) => await client.ask("documentHighlight", { position: positionOf(doc, selection.main.head) }) ?? [],
    (doc, { range }) => {
        const { from, to } = spanOf(doc, range);
        return place.range(from, to);
    }, true);
