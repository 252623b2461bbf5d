// SPDX-License-Identifier: Apache-2.0
// The preview: a picture of the node at the cursor, or of one that stays; its inputs, its graph, its shader.

import { Compiler } from "@web/compiler.js";
import { filterInputs, showInputs, valueText } from "@web/inputs.js";
import { SHAPE_NAMES } from "@web/scene.js";
import { View, ViewError } from "@web/view.js";
import type { Diagnostic, Variable } from "mxgen";
import workerSource from "worker.bundle.js";

import type { LibraryFile } from "../src/files";
import type { FromView, Place, Position, ToView } from "../src/messages";
import { GraphView } from "./graph";
import { layOut } from "./layout";
import { SourceView } from "./source";
import type { Compilation, Graph, Source } from "./worker";

declare function acquireVsCodeApi(): { postMessage(message: FromView): void; getState(): unknown; setState(state: State): void };

/** The state that the preview remembers. */
interface State {
    name: string;
    pinned: string | null;
    shape: string;
    target: string;
    tab: string;
    split: number;
}

const host = acquireVsCodeApi(), page = layOut(document.body);
const state: State = { name: "", pinned: null, shape: document.body.dataset.shape!, target: "essl", tab: "inputs", split: 50, ...host.getState() as object };
const compiler = new Compiler(workerSource);
const graph = new GraphView(page.graph, path => reveal(nodes.get(path) ?? null)), source = new SourceView(page.source, reveal);
let view: View | null = null;
let shown: { text: string; cursor: Position } | null = null; // the newest document
let last: Compilation | null = null; // of which the picture is
let node: string | null = null; // at the cursor
let number = 0; // of the newest compilation
let isReady = false; // the compiler is there
let isBusy = false; // a compilation runs; one of the newest text follows
let nodes = new Map<string, Place>();
const asked = new Set<string>(); // files
const textures = new Map<string, boolean>(); // by their names in the document: whether there is a picture
let fault = ""; // of the picture
let libraryFault = "";

const post = (message: FromView) => host.postMessage(message);
const remember = (change: Partial<State>) => host.setState(Object.assign(state, change));

function reveal(place: Place | null): void {
    if (place)
        post({ type: "reveal", place });
}

// ---- The document ----

function setDocument({ name, text, cursor }: { name: string; text: string; cursor: Position }): void {
    if (name !== state.name) {
        remember({ name, pinned: null });
        asked.clear();
        textures.clear();
        last = null;
    }
    shown = { text, cursor };
    void compile();
}

async function setLibraries(added: LibraryFile[]): Promise<void> {
    libraryFault = "";
    await compiler.remember("libraries", { name: "", added }).catch(error => { libraryFault = `mxgen.libraries: ${error.message.split("\n")[0]}`; });
    await compile();
}

async function compile(): Promise<void> {
    number++;
    document.body.dataset.state = "working";
    if (!isReady || isBusy || !shown)
        return;
    isBusy = true;
    let done = 0;
    while (done !== number)
        await compileOnce(done = number);
    isBusy = false;
    document.body.dataset.state = "done";
}

async function compileOnce(mine: number): Promise<void> {
    const { name, pinned } = state, { text, cursor } = shown!;
    try {
        const answer = await compiler.ask<Compilation>("compile", { name, text, cursor, element: pinned });
        if (mine !== number)
            return; // a newer text is on its way
        for (const file of answer.missing.filter(one => !asked.has(one))) {
            asked.add(file);
            post({ type: "read", name: file });
        }
        take(answer);
        await Promise.all([showGraph(mine), showSource(mine)]);
    } catch (error) {
        tell([String((error as Error).message)], "error");
    }
}

function take(answer: Compilation): void {
    ({ node } = answer);
    showElements(answer);
    if (answer.shader && answer.element !== null) {
        last = answer;
        view?.setShader(answer.shader);
        askTextures(answer);
        showControls(answer);
        page.status.textContent = statusOf(answer);
    }
    showNotice(answer);
}

function statusOf({ element, shader }: Compilation): string {
    const count = (number: number, word: string) => `${number} ${word}${number === 1 ? "" : "s"}`;
    const { info, variables } = shader!, numTextures = variables.filter(({ block, file }) => block === "textures" && file).length;
    return [element, info.numClosures && count(info.numClosures, "closure"), numTextures && count(numTextures, "texture")].filter(Boolean).join(" · ");
}

function showElements({ renderables, node: here, element }: Compilation): void {
    const follows = new Option(`At the cursor${state.pinned === null && element ? `: ${element}` : ""}`, "");
    const paths = new Set(renderables.map(({ path }) => path));
    for (const path of [here, state.pinned])
        if (path)
            paths.add(path);
    page.element.replaceChildren(follows, ...[...paths].map(path => new Option(path, path)));
    page.element.value = state.pinned ?? "";
    page.pin.setAttribute("aria-pressed", String(state.pinned !== null));
}

// ---- Notices ----

function tell(lines: string[], kind: "error" | "warning"): void {
    page.notice.hidden = !lines.length;
    page.notice.className = kind;
    page.notice.replaceChildren(...lines.map(text => Object.assign(document.createElement("p"), { textContent: text })));
}

function missingTextures(): string[] {
    const wanted = last?.shader?.variables.filter(({ block, file }) => block === "textures" && file).map(({ file }) => file) ?? [];
    return [...new Set(wanted)].filter(file => textures.get(file) === false);
}

function showNotice({ shader, diagnostics, renderables }: Pick<Compilation, "shader" | "diagnostics" | "renderables">): void {
    const errors = diagnostics.filter(({ severity }: Diagnostic) => severity === "error"), missing = missingTextures();
    if (fault || libraryFault)
        tell([fault, libraryFault].filter(Boolean), "error");
    else if (errors.length)
        tell([`${errors[0].line ? `Line ${errors[0].line}: ` : ""}${errors[0].message}`, ...(errors.length > 1 ? [`and ${errors.length - 1} more`] : []),
            ...(shader || !last ? [] : ["The picture is of the last text without errors."])], "error");
    else if (!shader)
        tell([renderables.length ? "This element has no picture." : "The document has no material and no output of a graph yet."], "warning");
    else
        tell(missing.length ? [`${missing.length === 1 ? "A texture is" : `${missing.length} textures are`} missing or not a picture that browsers read: ${missing.join(", ")}`] : [], "warning");
}

// ---- Textures ----

function askTextures({ shader, places }: Compilation): void {
    for (const { block, file, path } of shader!.variables)
        if (block === "textures" && file && !asked.has(`texture ${file}`)) {
            asked.add(`texture ${file}`);
            post({ type: "readTexture", name: state.name, from: places[path.slice(0, path.lastIndexOf("/"))]?.file ?? state.name, file });
        }
}

async function setTexture({ name, file, content }: { name: string; file: string; content: Uint8Array<ArrayBuffer> | null }): Promise<void> {
    if (name !== state.name)
        return;
    const options: ImageBitmapOptions = { imageOrientation: "flipY", premultiplyAlpha: "none", colorSpaceConversion: "none" };
    const image = content && await createImageBitmap(new Blob([content]), options).catch(() => null);
    textures.set(file, image !== null);
    if (image)
        view?.setTexture(file, image);
    else if (last)
        showNotice(last);
}

// ---- Inputs ----

/** Fills the panel, with the inputs of the element first. */
function showControls({ element, shader, places }: Compilation): void {
    const isOwn = ({ path }: Variable) => Number(path.startsWith(`${element}/`)), variables = [...shader!.variables].sort((a, b) => isOwn(b) - isOwn(a));
    showInputs(page.controls, variables, (variable, values, isFinal) => setInput(places, variable, values, isFinal));
    filterControls();
}

const filterControls = () => filterInputs(page.controls, page.filter.value);

function setInput(places: Compilation["places"], variable: Variable, values: number[], isFinal: boolean): void {
    variable.values = values;
    if (view) {
        view.hasMoved = true;
        view.draw();
    }
    const slash = variable.path.lastIndexOf("/"), path = variable.path.slice(0, slash), place = places[path];
    if (isFinal && place)
        post({ type: "setInput", value: valueText(variable, values),
            place: { ...place, node: path.slice(path.lastIndexOf("/") + 1), input: variable.path.slice(slash + 1), type: variable.documentType } });
}

// ---- Graph and shader ----

async function showGraph(mine: number): Promise<void> {
    if (state.tab !== "graph" || !last?.element)
        return;
    const answer = await compiler.ask<Graph>("graph", { name: state.name, text: shown!.text, element: node ?? last.element });
    if (mine !== number)
        return;
    nodes = new Map(answer.nodes.flatMap(({ path, place }) => place ? [[path, place] as const] : []));
    graph.show(answer);
    graph.mark(node);
}

async function showSource(mine: number): Promise<void> {
    if (state.tab !== "shader" || !last?.element)
        return;
    const answer = await compiler.ask<Source>("inspect", { name: state.name, text: shown!.text, element: last.element, target: state.target });
    if (mine !== number)
        return;
    source.show(answer);
    source.mark(node);
}

function showTab(tab: string): void {
    remember({ tab });
    for (const button of page.tabs) {
        const isChosen = button.dataset.tab === tab;
        button.setAttribute("aria-selected", String(isChosen));
        button.tabIndex = isChosen ? 0 : -1;
        document.getElementById(button.dataset.tab!)!.hidden = !isChosen;
    }
    page.shaderTools.hidden = tab !== "shader";
    page.inputTools.hidden = tab !== "inputs";
    void Promise.all([showGraph(number), showSource(number)]);
}

// ---- The cursor ----

async function follow(cursor: Position): Promise<void> {
    shown!.cursor = cursor;
    if (!isReady)
        return;
    const { text } = shown!, found = await compiler.ask<string | null>("locate", { name: state.name, text, cursor });
    if (shown?.text !== text || shown.cursor !== cursor || found === node)
        return;
    node = found;
    graph.mark(node);
    source.mark(node);
    await compile();
}

// ---- The preview ----

function openView(): void {
    try {
        view = new View(page.canvas);
        view.shape = state.shape;
        view.onChange = () => { document.body.dataset.whole = "false"; };
        view.onPicture = isWhole => {
            page.canvas.classList.add("drawn");
            document.body.dataset.whole = String(isWhole);
        };
        view.onError = text => { fault = `The driver refuses the shader, a bug in mxgen: ${text}`; };
    } catch (error) {
        if (!(error instanceof ViewError))
            throw error;
        fault = error.message;
    }
}

function setSplit(split: number): void {
    remember({ split: Math.max(15, Math.min(85, split)) });
    document.body.style.setProperty("--split", `${state.split}%`);
    page.splitter.setAttribute("aria-valuenow", String(Math.round(state.split)));
}

function listen(): void {
    page.element.addEventListener("change", () => {
        remember({ pinned: page.element.value || null });
        void compile();
    });
    page.pin.addEventListener("click", () => {
        remember({ pinned: state.pinned === null ? last?.element ?? null : null });
        void compile();
    });
    page.shape.addEventListener("change", () => {
        remember({ shape: page.shape.value });
        if (view)
            view.shape = state.shape;
    });
    page.target.addEventListener("change", () => {
        remember({ target: page.target.value });
        void showSource(number);
    });
    page.openShader.addEventListener("click", () => last?.element && post({ type: "openShader", name: state.name, element: last.element, target: state.target }));
    page.filter.addEventListener("input", filterControls);
    for (const button of page.tabs) {
        button.addEventListener("click", () => showTab(button.dataset.tab!));
        button.addEventListener("keydown", ({ key }) => {
            const step = { ArrowLeft: -1, ArrowRight: 1 }[key] ?? 0, next = page.tabs[page.tabs.indexOf(button) + step];
            if (step && next) {
                next.focus();
                showTab(next.dataset.tab!);
            }
        });
    }
    page.splitter.addEventListener("pointerdown", event => page.splitter.setPointerCapture(event.pointerId));
    page.splitter.addEventListener("pointermove", event => {
        if (event.buttons & 1)
            setSplit((event.clientY - page.picture.getBoundingClientRect().top) / (innerHeight - page.picture.getBoundingClientRect().top) * 100);
    });
    page.splitter.addEventListener("keydown", ({ key }) => setSplit(state.split + ({ ArrowUp: -3, ArrowDown: 3 }[key] ?? 0)));
    addEventListener("message", ({ data }: MessageEvent<ToView>) => {
        if (data.type === "document")
            setDocument(data);
        else if (data.type === "cursor" && shown)
            void follow(data.cursor);
        else if (data.type === "texture")
            void setTexture(data);
        else if (data.type === "libraries")
            void setLibraries(data.files);
        else if (data.type === "file")
            void compiler.remember("addFile", { name: data.name, content: data.content ?? new Uint8Array() }).then(compile);
    });
}

async function begin(): Promise<void> {
    page.shape.replaceChildren(...SHAPE_NAMES.map(name => new Option(name, name, false, name === state.shape)));
    listen();
    setSplit(state.split);
    openView();
    showTab(state.tab);
    const module = await WebAssembly.compileStreaming(fetch(document.body.dataset.wasm!));
    const targets = await compiler.remember("begin", { module }) as string[];
    page.target.replaceChildren(...targets.map(name => new Option(name, name, false, name === state.target)));
    isReady = true;
    post({ type: "ready" });
}

begin().catch(error => tell([`The preview does not start: ${error.message}`], "error"));
