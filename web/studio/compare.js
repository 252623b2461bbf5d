// SPDX-License-Identifier: Apache-2.0
// Two pictures beside each other: the pinned one, A, left of an edge that moves, and the one of the document, B.

import { element } from "../dom.js";

const STEP = 0.02; // of a key

export class Compare {
    #view;
    #edge = element("div", { id: "edge", tabIndex: 0, hidden: true }, element("span", { textContent: "A" }), element("span", { textContent: "B" }));
    #button = element("button", { id: "pin", type: "button", textContent: "Pin", title: "Keep this picture, to compare it with the next ones" });
    #share = 0.5;

    /** `picture` is the element that the view fills. */
    constructor(view, picture) {
        this.#view = view;
        for (const [name, value] of Object.entries({ role: "slider", "aria-label": "Part of the pinned picture", "aria-valuemin": 0, "aria-valuemax": 100 }))
            this.#edge.setAttribute(name, value);
        this.#button.setAttribute("aria-pressed", "false");
        this.#button.addEventListener("click", () => this.#pin(this.#edge.hidden));
        this.#listen(picture);
        picture.append(this.#edge, this.#button);
        this.#move(this.#share);
    }

    #pin(isOn) {
        if (isOn && !this.#view.pin())
            return;
        if (!isOn)
            this.#view.unpin();
        this.#edge.hidden = !isOn;
        this.#button.textContent = isOn ? "Unpin" : "Pin";
        this.#button.setAttribute("aria-pressed", String(isOn));
    }

    #move(share) {
        this.#share = Math.max(0, Math.min(1, share));
        this.#view.edge = this.#share;
        this.#edge.style.setProperty("--share", `${(100 * this.#share).toFixed(1)}%`);
        this.#edge.setAttribute("aria-valuenow", String(Math.round(100 * this.#share)));
    }

    #listen(picture) {
        const edge = this.#edge;
        edge.addEventListener("pointerdown", event => edge.setPointerCapture(event.pointerId));
        edge.addEventListener("pointermove", event => {
            const { left, width } = picture.getBoundingClientRect();
            if (edge.hasPointerCapture(event.pointerId))
                this.#move((event.clientX - left) / width);
        });
        edge.addEventListener("keydown", event => {
            const to = { ArrowLeft: this.#share - STEP, ArrowDown: this.#share - STEP, ArrowRight: this.#share + STEP, ArrowUp: this.#share + STEP, Home: 0, End: 1 }[event.key];
            if (to === undefined)
                return;
            event.preventDefault();
            this.#move(to);
        });
    }
}
