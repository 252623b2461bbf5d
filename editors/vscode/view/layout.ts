// SPDX-License-Identifier: Apache-2.0
// The elements of the preview.

type Child = Node | string;

function make<Name extends keyof HTMLElementTagNameMap>(name: Name, attributes: Record<string, string> = {}, ...children: Child[]): HTMLElementTagNameMap[Name] {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes))
        made.setAttribute(key, value);
    made.append(...children);
    return made;
}

export function layOut(body: HTMLElement) {
    const element = make("select", { id: "element", "aria-label": "What the picture shows" });
    const pin = make("button", { id: "pin", type: "button", title: "Keep showing this element while the cursor moves" }, "Pin");
    const shape = make("select", { id: "shape", "aria-label": "Shape" });
    const canvas = make("canvas", { id: "canvas", tabindex: "0", role: "img", "aria-label": "The material on a shape; drag or use the arrow keys to turn it" });
    const notice = make("div", { id: "notice", role: "status", hidden: "" }), status = make("div", { id: "status" });
    const picture = make("section", { id: "picture", "aria-label": "Picture" }, canvas, notice, status);
    const splitter = make("div", { id: "splitter", role: "separator", tabindex: "0", "aria-orientation": "horizontal", "aria-label": "Height of the picture",
        "aria-valuemin": "15", "aria-valuemax": "85" });
    const tabs = ["Inputs", "Graph", "Shader"].map(name => make("button", { type: "button", role: "tab", "data-tab": name.toLowerCase(), "aria-controls": name.toLowerCase() }, name));
    const target = make("select", { id: "target", "aria-label": "Target" });
    const openShader = make("button", { id: "open-shader", type: "button", title: "Open the shader as a document beside the text" }, "Open");
    const filter = make("input", { id: "filter", type: "search", placeholder: "Filter inputs", "aria-label": "Filter inputs" });
    const shaderTools = make("div", { class: "tools" }, target, openShader), inputTools = make("div", { class: "tools" }, filter);
    const controls = make("div", { id: "inputs", role: "tabpanel", "aria-label": "Inputs" });
    const graph = make("div", { id: "graph", role: "tabpanel", "aria-label": "Graph", hidden: "" });
    const source = make("div", { id: "shader", role: "tabpanel", tabindex: "0", "aria-label": "Shader", hidden: "" });
    body.append(make("header", {}, element, pin, shape), picture, splitter,
        make("nav", {}, make("div", { role: "tablist", "aria-label": "Details" }, ...tabs), inputTools, shaderTools), controls, graph, source);
    return { element, pin, shape, canvas, notice, status, picture, splitter, tabs, target, openShader, filter, shaderTools, inputTools, controls, graph, source };
}
