// SPDX-License-Identifier: Apache-2.0
// The page: a document, its picture, its inputs, and what the compiler says.

import carPaint from "../examples/car_paint.mtlx";
import displaced from "../examples/displaced.mtlx";
import expression from "../examples/custom_expression.mtlx";
import fog from "../examples/fog.mtlx";
import gold from "../examples/gold.mtlx";
import marble from "../examples/marble.mtlx";
import shaderx from "../examples/shaderx.mtlx";
import { changeOfInput, offsetOf } from "./changes.js";
import { Compiler } from "./compiler.js";
import { filterInputs, showInputs, valueText } from "./inputs.js";
import { Layout } from "./layout.js";
import { addressOf, textOf } from "./link.js";
import { inflate } from "./module.js";
import { SHAPE_NAMES } from "./scene.js";
import { PlainText } from "./text.js";
import { View, ViewError } from "./view.js";
import packedWorker from "worker.bundle.js";

const EXAMPLES = { "Gold": gold, "Marble": marble, "Car paint": carPaint, "Displaced": displaced, "ShaderX nodes": shaderx, "Custom node": expression, "Fog": fog };
const DOCUMENT = "document.mtlx";
const MAX_TEXT = 4 << 20; // an editor of more is slow
const SCENERY = /\.(hdr|exr|obj|glb)$/i;
const PAUSE = 250; // milliseconds after a key before the document is compiled

const $ = id => document.getElementById(id);
const workerSource = inflate(packedWorker);
const compiler = new Compiler(workerSource), language = new Compiler(workerSource); // a document that takes long does not hold up the editor
const layout = new Layout();
let text = new PlainText($("text"));
let view = null;
let shader = null; // of the last document without errors
let places = {}; // of its nodes
let element = null;
let options = {}; // of generation, for the picture
let request = 0; // the number of the newest compilation
let pause = 0;
let messages = []; // of the newest compilation
let remarks = []; // messages about files that were opened last
let cures = []; // quick fixes of the editor
const textures = new Map(); // pictures that were dropped, by the names of their files
const originals = new Map(); // values that documents had when they were opened, by the paths of inputs
let isOpened = false; // the text is that which was opened

function tell(sentence) {
    $("status").textContent = sentence;
    $("status").title = sentence;
}

function notify(lines, kind) {
    $("notice").hidden = !lines.length;
    $("notice").className = kind;
    $("notice").replaceChildren(...lines.map(line => Object.assign(document.createElement("p"), { textContent: line })));
}

const count = (number, word) => `${number} ${word}${number === 1 ? "" : "s"}`;

// ---- The document ----

function setText(value) {
    if (value.length > MAX_TEXT) {
        tell(`The document has ${(value.length / 1e6).toFixed(0)} MB; the page shows documents of up to ${MAX_TEXT >> 20} MB. The program mxgen reads larger ones.`);
        return;
    }
    text.value = value;
    isOpened = true;
    if (!document.body.dataset.picture)
        preview();
    compile();
}

/** Shows a place of the document; columns count characters. */
function goTo(line, column, length) {
    const start = offsetOf(text.value, line, column);
    layout.show("document");
    text.select(start, start + [...text.value.slice(start, start + 2 * length)].slice(0, length).join("").length);
}

function textChanged() {
    $("undo").disabled = !text.canUndo;
    $("redo").disabled = !text.canRedo;
    clearTimeout(pause);
    pause = setTimeout(compile, PAUSE);
}

/** Goes back or forth over all changes: of keys, of controls, and of what was opened. */
function travel(step) {
    if (!text[step])
        return; // the editor is not there yet
    text[step]();
    compile();
}

function travelByKey(event) {
    const key = event.key.toLowerCase(), isText = event.target === $("text") || event.target.type === "search";
    if (!(event.ctrlKey || event.metaKey) || event.altKey || isText || !["z", "y"].includes(key))
        return;
    event.preventDefault();
    travel(key === "y" || event.shiftKey ? "redo" : "undo");
}

// ---- The editor ----

function loadScript(name) {
    return new Promise((resolve, reject) => {
        const script = document.createElement("script");
        script.src = name;
        script.onload = resolve;
        script.onerror = () => reject(new Error(`The page cannot load ${name}.`));
        document.head.append(script);
    });
}

/** The argument that a script of the page gives to the function `mxgen…`. */
async function load(name, receiver) {
    const given = new Promise(resolve => globalThis[receiver] = resolve);
    await loadScript(name);
    return given;
}

/** Without it the text stays as it is. */
async function openEditor(module) {
    const Editor = await load("editor.js", "mxgenEditor");
    language.remember("begin", { name: "", letters: module }).catch(error => tell(error.message));
    text = text.replaceBy(Editor, { worker: language, tell, onCures: found => {
        cures = found;
        showMessages();
    } });
    text.addEventListener("input", textChanged);
    $("format").disabled = false;
    document.body.dataset.editor = "true";
}

let giveStudio;
const studio = new Promise(resolve => giveStudio = resolve); // null: there is none

async function openStudio() {
    try {
        const Studio = view && await load("studio.js", "mxgenStudio");
        giveStudio(Studio && new Studio({ view, picture: $("picture"), panel: layout.add("view", "View"), shape: $("shape"), tell, setOptions: chosen => {
            options = chosen;
            compile();
        } }));
        document.body.dataset.studio = "true";
    } finally {
        giveStudio(null);
    }
}

// ---- Results ----

function messageItem({ severity, id, message, file, line, column, length }) {
    const item = document.createElement("li"), button = document.createElement("button"), here = file === DOCUMENT && line > 0;
    const part = (className, textContent) => Object.assign(document.createElement("span"), { className, textContent });
    item.className = severity;
    button.type = "button";
    button.disabled = !here;
    button.append(part("place", line ? `${here ? "" : `${file}:`}${line}:${column}` : ""), part("severity", severity), part("message", message), part("id", id));
    button.addEventListener("click", () => goTo(line, column, length));
    item.append(button);
    const from = here && cures.length ? offsetOf(text.value, line, column) : -1;
    for (const cure of cures.filter(one => one.from === from && one.id === id)) {
        const fix = Object.assign(document.createElement("button"), { type: "button", className: "fix", textContent: cure.title });
        fix.addEventListener("click", cure.apply);
        item.append(fix);
    }
    return item;
}

function showMessages() {
    const list = $("messages").firstElementChild;
    const all = [...messages, ...remarks];
    list.replaceChildren(...all.map(messageItem));
    if (!all.length)
        list.append(Object.assign(document.createElement("li"), { className: "none", textContent: "No errors, no warnings." }));
    $("tab-messages").textContent = all.length ? `Messages (${all.length})` : "Messages";
    $("tab-messages").className = all.some(({ severity }) => severity === "error") ? "error" : "";
}

async function inspect() {
    if (layout.chosen !== "source" && layout.chosen !== "closures")
        return;
    const { source, closures } = await compiler.ask("inspect", { text: text.value, element, target: $("target").value });
    $("source").textContent = source;
    $("closures").textContent = closures;
}

function missingTextures() {
    const wanted = shader?.variables.filter(({ block, file }) => block === "textures" && file).map(({ file }) => file) ?? [];
    return [...new Set(wanted)].filter(file => !textures.has(nameOf(file)));
}

/** Notes for a person who looks at the picture. */
function showNotice(hasShader) {
    const errors = messages.filter(({ severity }) => severity === "error"), missing = missingTextures();
    if (errors.length)
        notify([`${errors[0].line ? `Line ${errors[0].line}: ` : ""}${errors[0].message}`, ...(errors.length > 1 ? [`and ${errors.length - 1} more`] : []),
            ...(hasShader || !shader || !view ? [] : ["The picture is of the last text without errors."])], "error");
    else
        notify(missing.length ? [`Drop the missing ${missing.length === 1 ? "texture" : "textures"} here: ${missing.join(", ")}`] : [], "warning");
}

/** While there is no picture: a coarse one, of a smaller shader. */
async function preview() {
    const small = await compiler.ask("preview", { text: text.value }).catch(() => null);
    if (small)
        view?.showPreview(small);
}

function takeShader(answer) {
    ({ shader, places } = answer);
    view?.setShader(shader);
    for (const { block, file, path, values } of shader.variables) {
        if (block === "textures" && textures.has(nameOf(file)))
            view?.setTexture(file, textures.get(nameOf(file)));
        if (block === "publicUniforms" && (isOpened || !originals.has(path)))
            originals.set(path, values);
    }
    isOpened = false;
    showInputs($("controls"), shader.variables, setInput, originals);
    filterInputs($("controls"), $("filter").value);
}

function statusOf(milliseconds) {
    const { info: { numClosures }, variables } = shader, numTextures = new Set(variables.filter(({ block, file }) => block === "textures" && file).map(({ file }) => file)).size;
    return [numClosures && count(numClosures, "closure"), numTextures && count(numTextures, "texture"), `${milliseconds} ms`].filter(Boolean).join(" · ");
}

async function compile() {
    clearTimeout(pause);
    const number = ++request, started = performance.now();
    try {
        const answer = await compiler.ask("compile", { text: text.value, element, options });
        if (number !== request)
            return; // a newer text is on its way
        messages = answer.diagnostics;
        showMessages();
        fillSelect($("element"), answer.renderables.map(({ path }) => path), answer.element);
        $("element-choice").hidden = answer.renderables.length < 2;
        ({ element } = answer);
        if (answer.shader)
            takeShader(answer);
        const errors = messages.filter(({ severity }) => severity === "error").length;
        tell(answer.shader ? statusOf(Math.round(performance.now() - started)) : errors ? count(errors, "error") : "The document has no material.");
        showNotice(answer.shader !== null);
        await inspect();
    } catch (error) {
        tell(error.message);
    }
    document.body.dataset.compiled = String(number);
}

// ---- Inputs ----

/** Changes the picture, and when a control rests one attribute of the text. */
function setInput(variable, values, isFinal) {
    const slash = variable.path.lastIndexOf("/"), path = variable.path.slice(0, slash), place = places[path];
    variable.values = values;
    if (view) {
        view.hasMoved = true;
        view.draw();
    }
    if (!isFinal)
        return;
    const node = path.slice(path.lastIndexOf("/") + 1), input = variable.path.slice(slash + 1);
    const change = place?.file === DOCUMENT ? changeOfInput(text.value, { ...place, node, input, type: variable.documentType }, valueText(variable, values)) : null;
    if (!change) {
        tell(place && place.file !== DOCUMENT ? `The text keeps its value: ${node} is in ${place.file}.` : `The text keeps its value: ${node} is not where it was.`);
        return;
    }
    text.change(change, variable.path);
    compile();
}

// ---- Files ----

const nameOf = path => path.slice(path.lastIndexOf("/") + 1);

async function takePicture(file) {
    textures.set(file.name, await createImageBitmap(file, { imageOrientation: "flipY", premultiplyAlpha: "none", colorSpaceConversion: "none" }));
    await language.remember("addFile", { name: file.name, content: new Uint8Array(await file.arrayBuffer()) });
}

/** The settings that the material is shown with. */
async function takeScenery(file) {
    const taker = await studio;
    if (!taker)
        throw new Error("there is no picture");
    remarks.push(...await taker.take(file));
}

/** Documents and texts that they include, textures, and scenery. */
async function take(files) {
    const texts = [], faults = [];
    let opened = null;
    remarks = [];
    for (const file of files) {
        try {
            if (SCENERY.test(file.name))
                await takeScenery(file);
            else if (file.type.startsWith("image/"))
                await takePicture(file);
            else if (file.name.endsWith(".mtlx") && !opened)
                opened = file;
            else if (file.size <= MAX_TEXT)
                texts.push([file.name, await file.text()]);
            else
                faults.push(file.name);
        } catch {
            faults.push(file.name);
        }
    }
    for (const [name, content] of texts)
        await Promise.all([compiler, language].map(worker => worker.remember("addFile", { name, content })));
    text.filesChanged();
    if (opened && opened.size > MAX_TEXT)
        setText({ length: opened.size });
    else if (opened)
        setText(await opened.text());
    else
        await compile();
    if (opened)
        $("example").value = "";
    if (faults.length)
        tell(`The page cannot read ${faults.join(", ")}.`);
    else if (remarks.length)
        tell((remarks.find(({ severity }) => severity === "error") ?? remarks[0]).message);
}

// ---- The page ----

function fillSelect(select, names, chosen) {
    select.replaceChildren(...names.map(name => new Option(name, name, false, name === chosen)));
}

async function openAddress() {
    const shared = await textOf(location.hash);
    if (shared !== null)
        setText(shared);
    return shared !== null;
}

async function share() {
    history.replaceState(null, "", await addressOf(text.value));
    const copied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
    tell(copied ? "The link is in the clipboard." : "The address of the page is the link.");
}

function listenToControls() {
    const orTell = work => () => work().catch(error => tell(error.message));
    text.element.addEventListener("input", textChanged);
    $("example").addEventListener("change", () => setText(EXAMPLES[$("example").value]));
    $("element").addEventListener("change", () => {
        element = $("element").value;
        compile();
    });
    $("shape").addEventListener("change", showShape);
    $("target").addEventListener("change", inspect);
    $("filter").addEventListener("input", () => filterInputs($("controls"), $("filter").value));
    $("open").addEventListener("change", () => take($("open").files));
    $("undo").addEventListener("click", () => travel("undo"));
    $("redo").addEventListener("click", () => travel("redo"));
    $("format").addEventListener("click", orTell(() => text.format()));
    $("share").addEventListener("click", orTell(share));
}

function listenToPage() {
    addEventListener("keydown", travelByKey);
    addEventListener("hashchange", () => openAddress().catch(error => tell(error.message)));
    addEventListener("dragover", event => {
        event.preventDefault();
        document.body.classList.add("dropping");
    });
    addEventListener("dragleave", () => document.body.classList.remove("dropping"));
    addEventListener("drop", event => {
        event.preventDefault();
        document.body.classList.remove("dropping");
        take(event.dataTransfer.files);
    });
}

function showShape() {
    if (view)
        view.shape = $("shape").value;
}

/** The promise ends with the first picture, or when there will be none. */
function openView() {
    return new Promise(done => {
        const end = () => {
            $("loading").hidden = true;
            done();
        };
        try {
            view = new View($("canvas"));
            showShape(); // which may have been chosen before
            view.onChange = () => { document.body.dataset.whole = "false"; };
            view.onPicture = isWhole => {
                document.body.dataset.picture ??= String(Math.round(performance.now()));
                document.body.dataset.whole = String(isWhole);
                end();
            };
            view.onError = fault => notify([`The driver refuses the shader, a bug in mxgen: ${fault}`], "error");
        } catch (error) {
            if (!(error instanceof ViewError))
                throw error;
            $("no-picture").hidden = false;
            $("no-picture").textContent = error.message;
            $("shape").disabled = true;
            end();
        }
    });
}

/** The compiler's module comes in a file of its own (pack.py), which calls this function. */
const module = new Promise((resolve, reject) => {
    globalThis.mxgenModule = (size, letters) => resolve({ size, letters });
    addEventListener("error", ({ target }) => target.tagName === "SCRIPT" && reject(new Error("The page cannot load the compiler.")), true);
});

async function begin() {
    fillSelect($("example"), Object.keys(EXAMPLES), "Gold");
    $("example").prepend(Object.assign(new Option("Examples", ""), { disabled: true }));
    fillSelect($("shape"), SHAPE_NAMES, "ball");
    listenToControls();
    listenToPage();
    layout.onShow = inspect;
    layout.show(document.body.dataset.width === "wide" ? "messages" : "inputs");
    const started = compiler.ask("started");
    const letters = await module, about = compiler.remember("begin", { name: "", letters }).then(() => compiler.ask("about"));
    let fault = null;
    const isShared = await openAddress().catch(error => { fault = error; });
    if (!isShared)
        setText(gold);
    // To open the view takes the page a while, in which the worker compiles; but a worker starts only while its page waits.
    await started.catch(() => {});
    const picture = openView(), { targets, version } = await about;
    fillSelect($("target"), targets, "essl");
    document.querySelector("h1").title = `mxgen ${version}`;
    if (fault)
        tell(fault.message);
    await picture;
    const faults = (await Promise.allSettled([openEditor(letters), openStudio()])).filter(({ reason }) => reason);
    if (faults.length)
        tell(faults.map(({ reason }) => reason.message).join(" "));
}

begin().catch(error => {
    $("loading").hidden = true;
    tell(error.message);
});
