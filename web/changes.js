// SPDX-License-Identifier: Apache-2.0
// Edits of a document's text: one attribute, or one new input, and nothing else. A change { start, end, text } replaces what stands from
// `start` to `end`, in UTF-16 code units.

/** The offset of a place; columns count characters, not code units. */
export function offsetOf(text, line, column) {
    let start = 0;
    for (let i = 1; i < line; i++) {
        const end = text.indexOf("\n", start);
        if (end < 0)
            return text.length;
        start = end + 1;
    }
    const rest = text.slice(start, start + 2 * column);
    return start + [...rest].slice(0, column - 1).join("").length;
}

/** A start tag: its `end` is after ">", `isEmpty` tells that it ends with "/>", and attributes have the places of values, without quotes. */
function readTag(text, start) {
    const head = /<([^\s/>=<]+)/y, attribute = /\s*([^\s/>=<]+)\s*=\s*(?:"([^"]*)"|'([^']*)')/y, foot = /\s*(\/?)>/y;
    head.lastIndex = start;
    const name = head.exec(text)?.[1];
    if (!name)
        return null;
    const attributes = new Map();
    attribute.lastIndex = foot.lastIndex = head.lastIndex;
    for (let found; (found = attribute.exec(text)); foot.lastIndex = attribute.lastIndex) {
        const end = attribute.lastIndex - 1;
        attributes.set(found[1], { start: end - (found[2] ?? found[3]).length, end });
    }
    const end = foot.exec(text);
    return end && { name, start, end: foot.lastIndex, isEmpty: end[1] === "/", attributes };
}

/** The elements directly below a tag, and where its end tag begins; null: nothing closes it. */
function readChildren(text, parent) {
    const children = [], next = /<!--[^]*?-->|<!\[CDATA\[[^]*?\]\]>|<\?[^]*?\?>|<\/|</g;
    next.lastIndex = parent.end;
    let depth = 0;
    for (let found; (found = next.exec(text));) {
        if (found[0] === "</") {
            if (depth-- === 0)
                return { children, end: found.index };
        } else if (found[0] === "<") {
            const tag = readTag(text, found.index);
            if (!tag)
                return null;
            if (depth === 0)
                children.push(tag);
            depth += tag.isEmpty ? 0 : 1;
            next.lastIndex = tag.end;
        }
    }
    return null;
}

const valueOf = (text, tag, attribute) => {
    const span = tag.attributes.get(attribute);
    return span && text.slice(span.start, span.end);
};

const indentOf = (text, offset) => /^[ \t]*/.exec(text.slice(text.lastIndexOf("\n", offset - 1) + 1, offset))[0];

/** The change that adds an input to a node, in the layout of what stands around it. */
function addInput(text, node, children, end, input) {
    const newline = text.includes("\r\n") ? "\r\n" : "\n", indent = indentOf(text, node.start);
    if (node.isEmpty) {
        const slash = text.lastIndexOf("/", node.end), start = slash - /\s*$/.exec(text.slice(node.start, slash))[0].length;
        return { start, end: node.end, text: `>${newline}${indent}  ${input}${newline}${indent}</${node.name}>` };
    }
    const last = children.at(-1);
    const at = last ? endOf(text, last) : node.end, below = last ? indentOf(text, last.start) : `${indent}  `;
    return { start: at, end: at, text: `${newline}${below}${input}${/\n[ \t]*$/.test(text.slice(at, end)) ? "" : newline + indent}` };
}

function endOf(text, tag) {
    const inside = tag.isEmpty ? null : readChildren(text, tag);
    return inside ? text.indexOf(">", inside.end) + 1 : tag.end;
}

/**
 * The change that gives an input of a node a value. `line` and `column` are the node's place, from 1; columns count characters.
 * null: the node is not at its place, or the text is broken there.
 */
export function changeOfInput(text, { line, column, node: name, input, type }, value) {
    const node = readTag(text, offsetOf(text, line, column));
    if (!node || valueOf(text, node, "name") !== name)
        return null;
    const inside = node.isEmpty ? { children: [], end: node.end } : readChildren(text, node);
    if (!inside)
        return null;
    const tag = inside.children.find(child => child.name === "input" && valueOf(text, child, "name") === input);
    if (!tag)
        return addInput(text, node, inside.children, inside.end, `<input name="${input}" type="${type}" value="${value}" />`);
    const span = tag.attributes.get("value");
    if (span)
        return { ...span, text: value };
    const last = Math.max(...[...tag.attributes.values()].map(({ end }) => end)) + 1;
    return { start: last, end: last, text: ` value="${value}"` };
}
