// SPDX-License-Identifier: Apache-2.0
// Panels: tabs, which of them a width of the page shows beside each other, and the bars that resize them.

import { element } from "./dom.js";

const WIDTHS = [["wide", "(min-width: 1200px)"], ["medium", "(min-width: 700px)"], ["narrow", "all"]];
const OWN = { wide: ["document", "inputs"], medium: ["document"], narrow: [] }; // panels with a place of their own, without a tab
const STEP = 2; // percent of a key

const $ = id => document.getElementById(id);
const tabs = () => [...document.querySelectorAll("[role=tab]")];

export class Layout {
    #chosen = "messages";
    #width = "";
    onShow = () => {}; // hears which tab is shown

    constructor() {
        for (const tab of tabs())
            this.#listen(tab);
        for (const [, query] of WIDTHS)
            matchMedia(query).addEventListener("change", () => this.#arrange());
        for (const bar of document.querySelectorAll("[role=separator]"))
            resizeBy(bar);
        this.#arrange();
    }

    #listen(tab) {
        tab.addEventListener("click", () => this.show(tab.dataset.tab));
        tab.addEventListener("keydown", event => this.#step(event, tab));
    }

    /** Adds an empty panel with a tab behind the others. */
    add(name, title) {
        const tab = element("button", { type: "button", id: `tab-${name}`, textContent: title }), panel = element("div", { id: name, className: "panel", tabIndex: 0 });
        tab.dataset.tab = name;
        for (const [made, attributes] of [[tab, { "role": "tab", "aria-controls": name }], [panel, { "role": "tabpanel", "aria-labelledby": tab.id }]])
            for (const [attribute, value] of Object.entries(attributes))
                made.setAttribute(attribute, value);
        tabs().at(-1).after(tab);
        [...document.querySelectorAll(".panel")].at(-1).after(panel);
        this.#listen(tab);
        this.show(this.#chosen);
        return panel;
    }

    get chosen() {
        return this.#chosen;
    }

    #arrange() {
        const [width] = WIDTHS.find(([, query]) => matchMedia(query).matches);
        if (width === this.#width)
            return;
        const wasOwn = OWN[this.#width]?.includes(this.#chosen);
        this.#width = document.body.dataset.width = width;
        for (const tab of tabs())
            tab.hidden = OWN[width].includes(tab.dataset.tab);
        this.show(OWN[width].includes(this.#chosen) || wasOwn ? "messages" : this.#chosen);
    }

    /** Arrow keys go from tab to tab. */
    #step(event, tab) {
        const shown = tabs().filter(one => !one.hidden), by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
        if (!by)
            return;
        event.preventDefault();
        const next = shown.at((shown.indexOf(tab) + by) % shown.length);
        next.focus();
        this.show(next.dataset.tab);
    }

    /** A panel with a place of its own is shown anyway. */
    show(name) {
        if (OWN[this.#width].includes(name))
            return;
        this.#chosen = name;
        for (const tab of tabs()) {
            const panel = tab.dataset.tab, isChosen = panel === name;
            tab.setAttribute("aria-selected", String(isChosen));
            tab.tabIndex = isChosen ? 0 : -1;
            if (isChosen)
                tab.scrollIntoView({ block: "nearest", inline: "nearest" });
            $(panel).hidden = !isChosen && !OWN[this.#width].includes(panel);
        }
        $("tools").hidden = name !== "source";
        this.onShow(name);
    }
}

/** A bar sets a variable of the grid, in percent of the page: by the pointer, or by arrow keys. */
function resizeBy(bar) {
    const { variable, from } = bar.dataset, isVertical = bar.getAttribute("aria-orientation") === "vertical";
    const set = percent => {
        const value = Math.max(15, Math.min(75, percent));
        $("panels").style.setProperty(variable, `${value.toFixed(1)}%`);
        bar.setAttribute("aria-valuenow", String(Math.round(value)));
    };
    bar.addEventListener("pointerdown", event => {
        event.preventDefault();
        bar.setPointerCapture(event.pointerId);
    });
    bar.addEventListener("pointermove", event => {
        if (!bar.hasPointerCapture(event.pointerId))
            return;
        const { left, top, width, height } = $("panels").getBoundingClientRect();
        const share = isVertical ? (event.clientX - left) / width : (event.clientY - top) / height;
        set(100 * (from === "end" ? 1 - share : share));
    });
    bar.addEventListener("keydown", event => {
        const by = { ArrowLeft: -STEP, ArrowUp: -STEP, ArrowRight: STEP, ArrowDown: STEP }[event.key];
        if (!by)
            return;
        event.preventDefault();
        set(Number(bar.getAttribute("aria-valuenow")) + (from === "end" ? -by : by));
    });
}
