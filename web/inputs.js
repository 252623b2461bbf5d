// SPDX-License-Identifier: Apache-2.0
// Sliders, colours and switches for the public uniforms of a shader, made from its reflection.

import { element } from "./dom.js";

const first = (...texts) => {
    const text = texts.find(candidate => candidate !== "" && Number.isFinite(Number(candidate.split(",")[0])));
    return text === undefined ? null : Number(text.split(",")[0]);
};

/** The least and the greatest value of a slider. */
function rangeOf(variable) {
    const value = variable.values[0] ?? 0;
    const least = first(variable.uisoftmin, variable.uimin) ?? Math.min(0, 2 * value);
    const greatest = first(variable.uisoftmax, variable.uimax) ?? Math.max(1, 2 * value);
    return [least, greatest];
}

const encode = x => x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
const decode = x => x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
const same = x => x;
/** To sRGB, in which browsers pick colours, and back; the values of other spaces than srgb_texture count as linear. */
const spaceOf = ({ colorspace }) => colorspace === "srgb_texture" ? [same, same] : [encode, decode];
const toHex = (values, toSrgb) => "#" + values.slice(0, 3).map(x => Math.round(255 * toSrgb(Math.max(0, Math.min(1, x)))).toString(16).padStart(2, "0")).join("");
const short = x => String(Number(x.toPrecision(6)));
const shown = x => String(Number(x.toPrecision(4)));
const isEqual = (one, other) => one.every((value, index) => short(value) === short(other[index]));

/** The text of a value in a document. */
export function valueText({ documentType }, values) {
    return documentType === "boolean" ? String(values[0] !== 0) : values.map(short).join(", ");
}

/** The names of the numbers of a value. */
const PARTS = { color: ["red", "green", "blue", "alpha"], vector: ["x", "y", "z", "w"] };

/** A control: what shows the values of a variable, and takes others. */
class Control {
    #variable;
    #set;
    #original;
    #parts = []; // [input, function that shows values in it]
    #reset = null;
    label;

    /** `set(values, isFinal)` tells new values: while a slider moves, and when it rests. `original` are values to go back to, or null. */
    constructor(variable, set, original) {
        const name = variable.uiname || variable.path.split("/").at(-1);
        this.#variable = variable;
        this.#set = set;
        this.#original = original;
        this.label = element("label", { title: [variable.path, variable.doc].filter(Boolean).join("\n") }, element("span", { textContent: name }));
        this.label.dataset.path = variable.path;
        this.#fill(name);
        for (const [, show] of this.#parts)
            show(variable.values);
        if (original)
            this.#addReset(name);
    }

    #fill(name) {
        const { documentType, values } = this.#variable;
        if (documentType === "boolean") {
            this.label.append(this.#checkbox(name));
        } else if (values.length === 1) {
            this.label.append(this.#slider(name), this.#numberBox(0, name));
        } else {
            const names = PARTS[documentType.replace(/\d$/, "")] ?? [];
            if (/^color/.test(documentType))
                this.label.append(this.#picker(name));
            this.label.append(element("div", { className: "numbers" }, ...values.map((_, index) => this.#numberBox(index, `${name}: ${names[index] ?? index + 1}`))));
        }
    }

    #add(input, name, read, show) {
        input.setAttribute("aria-label", name);
        for (const [event, isFinal] of [["input", false], ["change", true]])
            input.addEventListener(event, () => this.#give(read(), isFinal, input));
        this.#parts.push([input, show]);
        return input;
    }

    /** Takes values, and shows them where they do not come from. */
    #give(values, isFinal, from) {
        for (const [input, show] of this.#parts)
            if (input !== from)
                show(values);
        if (this.#reset)
            this.#reset.hidden = isEqual(values, this.#original);
        this.#set(values, isFinal);
    }

    #checkbox(name) {
        const box = element("input", { type: "checkbox" });
        return this.#add(box, name, () => [box.checked ? 1 : 0], ([value]) => { box.checked = value !== 0; });
    }

    #slider(name) {
        const [min, max] = rangeOf(this.#variable), step = this.#variable.documentType === "integer" ? 1 : (max - min) / 1000;
        const slider = element("input", { type: "range", min, max, step });
        return this.#add(slider, name, () => [Number(slider.value)], ([value]) => { slider.value = value; });
    }

    /** It shows few digits; a number that nobody types keeps them all. */
    #numberBox(index, name) {
        const box = element("input", { type: "number", step: "any" });
        return this.#add(box, name, () => this.#variable.values.map((value, i) => i === index ? Number(box.value) : value), values => { box.value = shown(values[index]); });
    }

    #picker(name) {
        const [toSrgb, fromSrgb] = spaceOf(this.#variable), color = element("input", { type: "color" });
        const read = () => [...[1, 3, 5].map(at => fromSrgb(parseInt(color.value.slice(at, at + 2), 16) / 255)), ...this.#variable.values.slice(3)];
        return this.#add(color, name, read, values => { color.value = toHex(values, toSrgb); });
    }

    #addReset(name) {
        this.#reset = element("button", { type: "button", className: "reset", title: "Back to the value that was opened", textContent: "↺", hidden: isEqual(this.#variable.values, this.#original) });
        this.#reset.setAttribute("aria-label", `Reset ${name}`);
        this.#reset.addEventListener("click", () => this.#give([...this.#original], true, null));
        this.label.append(this.#reset);
    }
}

const labelsOf = panel => [...panel.querySelectorAll("label[data-path]")];

/**
 * Fills `panel` with the controls of a shader; what has the focus keeps it. `set(variable, values, isFinal)` hears of changes. `originals`
 * are values by paths that controls can go back to.
 */
export function showInputs(panel, variables, set, originals = new Map()) {
    const groups = new Map(), before = document.activeElement?.closest("label[data-path]"), scroll = panel.scrollTop;
    const index = before ? [...before.querySelectorAll("input")].indexOf(document.activeElement) : -1;
    for (const variable of variables) {
        if (variable.block !== "publicUniforms" || !variable.values.length || variable.arrayLength)
            continue;
        const group = variable.path.slice(0, variable.path.lastIndexOf("/")) + (variable.uifolder ? ` · ${variable.uifolder}` : "");
        if (!groups.has(group))
            groups.set(group, element("fieldset", {}, element("legend", { textContent: group })));
        groups.get(group).append(new Control(variable, (values, isFinal) => set(variable, values, isFinal), originals.get(variable.path) ?? null).label);
    }
    panel.replaceChildren(...groups.values());
    if (!groups.size)
        panel.append(element("p", { textContent: "The shader has no inputs." }));
    panel.scrollTop = scroll;
    if (before)
        labelsOf(panel).find(label => label.dataset.path === before.dataset.path)?.querySelectorAll("input")[index]?.focus();
}

/** Shows the controls whose names have all the words. */
export function filterInputs(panel, text) {
    const words = text.toLowerCase().split(/\s+/);
    for (const group of panel.querySelectorAll("fieldset")) {
        const labels = labelsOf(group);
        for (const label of labels) {
            const name = `${label.dataset.path} ${label.firstChild.textContent}`.toLowerCase();
            label.hidden = !words.every(word => name.includes(word));
        }
        group.hidden = labels.every(label => label.hidden);
    }
}
