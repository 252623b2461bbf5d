// SPDX-License-Identifier: Apache-2.0
// The graph of a material as a picture: laid out from left to right by dagre, moved by drags and the wheel.

import dagre from "@dagrejs/dagre";

import type { Graph } from "./worker";

const SVG = "http://www.w3.org/2000/svg";
const WIDTH = 168, HEAD = 40, ROW = 18, MAX_NODES = 400, MARGIN = 16;
const SMALLEST = 1.5, READABLE = 1.15; // units per pixel: of a whole graph that shows, and of a part of a larger one

function make(name: string, attributes: Record<string, string | number>, ...children: (Node | string)[]): SVGElement {
    const made = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes))
        made.setAttribute(key, String(value));
    made.append(...children);
    return made;
}

const short = (text: string, length: number) => text.length > length ? `${text.slice(0, length - 1)}…` : text;

type Node_ = Graph["nodes"][number];

function lay({ nodes, links }: Graph) {
    const graph = new dagre.graphlib.Graph({ multigraph: true });
    graph.setGraph({ rankdir: "LR", nodesep: 18, ranksep: 56, marginx: MARGIN, marginy: MARGIN });
    graph.setDefaultEdgeLabel(() => ({}));
    for (const { path, inputs } of nodes)
        graph.setNode(path, { width: WIDTH, height: HEAD + ROW * inputs.length });
    for (const { from, to, input } of links)
        graph.setEdge(from, to, {}, input);
    dagre.layout(graph);
    return graph;
}

export class GraphView {
    readonly #root: HTMLElement;
    readonly #choose: (path: string) => void;
    #svg: SVGElement | null = null;
    #cards = new Map<string, SVGElement>();
    #size = { width: 1, height: 1 };
    #box = { x: 0, y: 0, width: 1, height: 1 };
    #key = "";
    #laid: dagre.graphlib.Graph | null = null;
    #marked: string | null = null;

    /** `choose` hears of the node that somebody clicks. */
    constructor(root: HTMLElement, choose: (path: string) => void) {
        this.#root = root;
        this.#choose = choose;
        root.addEventListener("wheel", event => this.#zoom(event), { passive: false });
        root.addEventListener("pointermove", event => {
            if (event.buttons & 1 && this.#svg) {
                const scale = this.#scale();
                this.#move(this.#box.x - event.movementX * scale, this.#box.y - event.movementY * scale);
            }
        });
        new ResizeObserver(() => this.#fit()).observe(root);
    }

    show(graph: Graph): void {
        const key = JSON.stringify(graph.nodes.map(({ path, category, inputs }) => [path, category, inputs])) + JSON.stringify(graph.links);
        if (key === this.#key)
            return;
        this.#key = key;
        this.#cards.clear();
        this.#svg = null;
        if (!graph.nodes.length || graph.nodes.length > MAX_NODES) {
            const text = graph.nodes.length ? `The graph has ${graph.nodes.length} nodes; the view shows graphs of up to ${MAX_NODES}.` : "The document has nothing to show.";
            this.#root.replaceChildren(Object.assign(document.createElement("p"), { textContent: text }));
            return;
        }
        const laid = this.#laid = lay(graph), { width = 1, height = 1 } = laid.graph();
        this.#size = { width, height };
        const links = make("g", { class: "links" }), cards = make("g", {});
        for (const { from, to, input } of graph.links)
            links.append(this.#link(laid, graph, from, to, input));
        for (const node of graph.nodes) {
            const card = this.#card(node, laid.node(node.path));
            this.#cards.set(node.path, card);
            cards.append(card);
        }
        this.#svg = make("svg", { role: "img", "aria-label": `The graph: ${graph.nodes.length} nodes` }, links, cards);
        this.#root.replaceChildren(this.#svg);
        this.#fit();
    }

    #card(node: Node_, { x, y, height }: { x: number; y: number; height: number }): SVGElement {
        const left = x - WIDTH / 2, top = y - height / 2, name = node.path.split("/").at(-1)!;
        const card = make("g", { class: "card", "data-type": node.type, tabindex: 0, role: "button", transform: `translate(${left} ${top})` },
            make("title", {}, `${node.path}\n${node.category}, ${node.type}`),
            make("rect", { width: WIDTH, height, rx: 5 }),
            make("circle", { class: "port", cx: WIDTH, cy: HEAD / 2, r: 4 }),
            make("text", { class: "name", x: 12, y: 17 }, short(name, 22)),
            make("text", { class: "category", x: 12, y: 32 }, short(node.category, 24)));
        node.inputs.forEach((input, row) => {
            const at = HEAD + ROW * row + ROW / 2 - 3;
            card.append(make("circle", { class: "socket", cx: 0, cy: at, r: 3.5 }), make("text", { class: "input", x: 12, y: at + 4 }, short(input, 24)));
        });
        card.addEventListener("click", () => this.#choose(node.path));
        card.addEventListener("keydown", event => {
            if (event.key === "Enter" || event.key === " ")
                this.#choose(node.path);
        });
        return card;
    }

    #link(laid: dagre.graphlib.Graph, graph: Graph, from: string, to: string, input: string): SVGElement {
        const a = laid.node(from), b = laid.node(to), row = graph.nodes.find(({ path }) => path === to)!.inputs.indexOf(input);
        const x0 = a.x + WIDTH / 2, y0 = a.y - a.height / 2 + HEAD / 2, x1 = b.x - WIDTH / 2, y1 = b.y - b.height / 2 + HEAD + ROW * row + ROW / 2 - 3;
        const bend = Math.max(24, (x1 - x0) / 2);
        return make("path", { d: `M${x0} ${y0} C${x0 + bend} ${y0} ${x1 - bend} ${y1} ${x1} ${y1}`, "data-from": from, "data-to": to,
            "data-type": graph.nodes.find(({ path }) => path === from)!.type });
    }

    /** Marks a node and its connections, and brings it into view. */
    mark(path: string | null): void {
        this.#marked = path;
        for (const [name, card] of this.#cards)
            card.classList.toggle("current", name === path);
        for (const link of this.#root.querySelectorAll<SVGElement>(".links path"))
            link.classList.toggle("current", path !== null && [link.dataset.from, link.dataset.to].includes(path));
        if (path !== null && !this.#isVisible(path))
            this.#centre(path);
    }

    // ---- What part of the graph shows ----

    #scale(): number {
        return Math.max(this.#box.width / Math.max(1, this.#root.clientWidth), this.#box.height / Math.max(1, this.#root.clientHeight));
    }

    #move(x: number, y: number): void {
        Object.assign(this.#box, { x, y });
        this.#svg?.setAttribute("viewBox", `${this.#box.x} ${this.#box.y} ${this.#box.width} ${this.#box.height}`);
    }

    #isVisible(path: string): boolean {
        const node = this.#cards.has(path) && this.#laid?.node(path), { x, y, width, height } = this.#box;
        return !node || (node.x - WIDTH / 2 >= x && node.x + WIDTH / 2 <= x + width && node.y - node.height / 2 >= y && node.y + node.height / 2 <= y + height);
    }

    #centre(path: string): void {
        const { x, y } = this.#laid!.node(path);
        this.#move(x - this.#box.width / 2, y - this.#box.height / 2);
    }

    /** Shows the whole graph, or of a large one the part around the node that is marked, or the end. */
    #fit(): void {
        const { clientWidth, clientHeight } = this.#root, { width, height } = this.#size;
        const whole = Math.max(1, width / Math.max(1, clientWidth), height / Math.max(1, clientHeight)), scale = whole > SMALLEST ? READABLE : whole;
        Object.assign(this.#box, { width: clientWidth * scale, height: clientHeight * scale });
        if (whole <= SMALLEST)
            this.#move((width - this.#box.width) / 2, (height - this.#box.height) / 2);
        else if (this.#marked !== null && this.#cards.has(this.#marked))
            this.#centre(this.#marked);
        else
            this.#move(width - this.#box.width, (height - this.#box.height) / 2);
    }

    #zoom(event: WheelEvent): void {
        event.preventDefault();
        const factor = Math.exp(event.deltaY / 500), frame = this.#root.getBoundingClientRect(), scale = this.#scale();
        const width = Math.min(20_000, Math.max(120, this.#box.width * factor)), applied = width / this.#box.width;
        const x = this.#box.x + (event.clientX - frame.left) * scale * (1 - applied), y = this.#box.y + (event.clientY - frame.top) * scale * (1 - applied);
        Object.assign(this.#box, { width, height: this.#box.height * applied });
        this.#move(x, y);
    }
}
