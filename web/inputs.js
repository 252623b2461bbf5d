// SPDX-License-Identifier: Apache-2.0
// Sliders, colours and switches for the public uniforms of a shader, made from its reflection.

function element(name, properties = {}, ...children) {
    const made = Object.assign(document.createElement(name), properties);
    made.append(...children);
    return made;
}

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

/** The text of a value in a document. */
export function valueText({ documentType }, values) {
    return documentType === "boolean" ? String(values[0] !== 0) : values.map(short).join(", ");
}

/** The control of a variable. `set(values, isFinal)` tells new values: while a slider moves, and when it rests. */
function controlOf(variable, set) {
    const { documentType, values } = variable, title = [variable.path, variable.doc].filter(Boolean).join("\n");
    const label = element("label", { title }, element("span", { textContent: variable.uiname || variable.path.split("/").at(-1) }));
    label.dataset.path = variable.path;
    const listen = (input, read) => {
        input.addEventListener("input", () => set(read(), false));
        input.addEventListener("change", () => set(read(), true));
        return input;
    };
    const numberBox = index => listen(element("input", { type: "number", step: "any", value: short(values[index]) }), () => boxes().map(box => Number(box.value)));
    const boxes = () => [...label.querySelectorAll("input[type=number]")];
    if (documentType === "boolean") {
        label.append(listen(element("input", { type: "checkbox", checked: values[0] !== 0 }), () => [label.lastChild.checked ? 1 : 0]));
    } else if (values.length === 1) {
        const [min, max] = rangeOf(variable), integer = documentType === "integer";
        const slider = element("input", { type: "range", min, max, step: integer ? 1 : (max - min) / 1000 });
        slider.value = values[0];
        label.append(listen(slider, () => {
            boxes()[0].value = short(Number(slider.value));
            return [Number(slider.value)];
        }), numberBox(0));
    } else {
        if (/^color/.test(documentType)) {
            const [toSrgb, fromSrgb] = spaceOf(variable), color = element("input", { type: "color", value: toHex(values, toSrgb) });
            label.append(listen(color, () => {
                const picked = [1, 3, 5].map(at => fromSrgb(parseInt(color.value.slice(at, at + 2), 16) / 255));
                picked.forEach((x, i) => { boxes()[i].value = short(x); });
                return boxes().map(box => Number(box.value));
            }));
        }
        label.append(element("div", { className: "numbers" }, ...values.map((_, index) => numberBox(index))));
    }
    return label;
}

/** Fills `panel` with the controls of a shader. `set(variable, values, isFinal)` hears of changes. */
export function showInputs(panel, variables, set) {
    const groups = new Map();
    for (const variable of variables) {
        if (variable.block !== "publicUniforms" || !variable.values.length || variable.arrayLength)
            continue;
        const group = variable.path.slice(0, variable.path.lastIndexOf("/")) + (variable.uifolder ? ` · ${variable.uifolder}` : "");
        if (!groups.has(group))
            groups.set(group, element("fieldset", {}, element("legend", { textContent: group })));
        groups.get(group).append(controlOf(variable, (values, isFinal) => set(variable, values, isFinal)));
    }
    panel.replaceChildren(...groups.values());
    if (!groups.size)
        panel.append(element("p", { textContent: "The shader has no inputs." }));
}
