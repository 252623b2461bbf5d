// SPDX-License-Identifier: Apache-2.0
// The text of a shader. Its lines are linked to the nodes that produced them.

import type { Place } from "../src/messages";
import type { Source } from "./worker";

const WORDS = "attribute break bool case class const continue cbuffer default discard do else export false float float2 float3 float4 float3x3 float4x4 fn for if import in inout int "
    + "let layout mat2 mat3 mat4 matrix out precision return sampler2D static struct switch texture2d true uint uniform using var vec2 vec3 vec4 vector void while color normal point shader surface material";
const KEYWORDS = new Set(WORDS.split(" "));
const TOKEN = /(\/\/.*)|(^\s*#.*|"[^"]*")|\b(\d[\w.]*)\b|\b([A-Za-z_]\w*)\b/g;

function piece(className: string, text: string): HTMLElement {
    return Object.assign(document.createElement("span"), { className, textContent: text });
}

/** A line with comments, directives, numbers and keywords marked. */
function coloured(line: string): (Node | string)[] {
    const parts: (Node | string)[] = [];
    let end = 0;
    for (const { 0: text, 1: comment, 2: other, 3: number, index } of line.matchAll(TOKEN)) {
        const name = comment ? "comment" : other ? "directive" : number ? "number" : KEYWORDS.has(text) ? "keyword" : "";
        if (!name)
            continue;
        parts.push(line.slice(end, index), piece(name, text));
        end = index + text.length;
    }
    return [...parts, line.slice(end)];
}

export class SourceView {
    readonly #root: HTMLElement;
    #source: Source | null = null;
    #lines: HTMLElement[] = [];
    #marked: string | null = null;

    /** `reveal` hears of the node of a line that somebody clicks. */
    constructor(root: HTMLElement, reveal: (place: Place) => void) {
        this.#root = root;
        const follow = (target: EventTarget | null) => {
            const index = this.#lines.indexOf((target as HTMLElement).closest(".line")!), node = this.#source?.nodes[this.#source.lines[index] ?? -1];
            if (node && getSelection()?.isCollapsed !== false)
                reveal(node.place);
        };
        root.addEventListener("click", ({ target }) => follow(target));
        root.addEventListener("keydown", ({ target, key }) => key === "Enter" && follow(target));
    }

    show(source: Source): void {
        if (source.text === this.#source?.text && source.nodes.length === this.#source.nodes.length) {
            this.#source = source;
            return;
        }
        this.#source = source;
        this.#root.classList.toggle("fault", source.fault);
        this.#lines = source.text.replace(/\n$/, "").split("\n").map((text, index) => {
            const node = source.nodes[source.lines[index] ?? -1], line = document.createElement("div");
            line.className = node ? "line linked" : "line";
            line.append(...(source.fault ? [text] : coloured(text)), "\n");
            if (node)
                Object.assign(line, { title: `${node.path}, line ${node.place.line}`, tabIndex: -1 });
            return line;
        });
        this.#root.replaceChildren(...this.#lines);
        this.#root.scrollTop = 0;
        this.mark(this.#marked);
    }

    /** Marks the lines of a node, and scrolls to the first one. */
    mark(path: string | null): void {
        this.#marked = path;
        const isOf = (index: number) => {
            const node = this.#source?.nodes[this.#source.lines[index] ?? -1];
            return node !== undefined && path !== null && (node.path === path || node.path.startsWith(`${path}/`));
        };
        this.#lines.forEach((line, index) => line.classList.toggle("current", isOf(index)));
        const first = this.#lines.find((_, index) => isOf(index));
        if (first && this.#root.clientHeight) {
            const top = first.offsetTop - this.#root.offsetTop;
            if (top < this.#root.scrollTop || top > this.#root.scrollTop + this.#root.clientHeight - 40)
                this.#root.scrollTop = top - this.#root.clientHeight / 4;
        }
    }
}
