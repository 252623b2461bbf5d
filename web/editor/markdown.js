// SPDX-License-Identifier: Apache-2.0
// The Markdown of the language server, as elements: paragraphs, lists, code, bold letters, links. No text becomes HTML.

function inline(text) {
    const parts = [], pattern = /`([^`]+)`|\*\*([^*]+)\*\*|\[([^\]]+)\]\(<?(https?:[^)>]+)>?\)|\\([\\`*_{}[\]()#+\-.!<>&|])/g;
    let last = 0;
    for (const found of text.matchAll(pattern)) {
        const [all, code, bold, label, address, escaped] = found;
        parts.push(text.slice(last, found.index));
        last = found.index + all.length;
        if (escaped !== undefined)
            parts.push(escaped);
        else if (label !== undefined)
            parts.push(Object.assign(document.createElement("a"), { textContent: label, href: address, target: "_blank", rel: "noreferrer" }));
        else
            parts.push(Object.assign(document.createElement(code === undefined ? "strong" : "code"), { textContent: code ?? bold }));
    }
    return [...parts, text.slice(last)].filter(part => part !== "");
}

function element(name, ...children) {
    const made = document.createElement(name);
    made.append(...children);
    return made;
}

/** An element with the text. */
export function rendered(markdown) {
    const made = element("div");
    made.className = "documentation";
    for (const block of markdown.split(/\n{2,}/)) {
        if (/^[*-] /.test(block))
            made.append(element("ul", ...block.split(/\n(?=[*-] )/).map(item => element("li", ...inline(item.slice(2))))));
        else if (block.trim())
            made.append(element("p", ...inline(block)));
    }
    return made;
}
