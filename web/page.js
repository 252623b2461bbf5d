// SPDX-License-Identifier: Apache-2.0
// The page: a document, its picture, its inputs, and what the compiler says.

import carPaint from "../examples/car_paint.mtlx";
import displaced from "../examples/displaced.mtlx";
import expression from "../examples/custom_expression.mtlx";
import fog from "../examples/fog.mtlx";
import gold from "../examples/gold.mtlx";
import marble from "../examples/marble.mtlx";
import shaderx from "../examples/shaderx.mtlx";
import { Compiler } from "./compiler.js";
import { showInputs, valueText } from "./inputs.js";
import { addressOf, textOf } from "./link.js";
import { SHAPE_NAMES } from "./scene.js";
import { View, ViewError } from "./view.js";
import workerSource from "worker.bundle.js";

const EXAMPLES = { "Gold": gold, "Marble": marble, "Car paint": carPaint, "Displaced": displaced, "ShaderX nodes": shaderx, "Custom node": expression, "Fog": fog };
const MAX_TEXT = 4 << 20; // an editor of more is slow
const PAUSE = 250; // milliseconds after a key before the document is compiled

const $ = id => document.getElementById(id);
const compiler = new Compiler(workerSource);
let view = null;
let shader = null; // of the last document without errors
let element = null;
let request = 0; // the number of the newest compilation
let pause = 0;
const textures = new Set(); // names of the files that were dropped

function tell(text) {
    $("status").textContent = text;
    $("status").title = text;
}

// ---- The document ----

const text = $("text");

function showGutter(diagnostics) {
    const marks = new Map();
    for (const { severity, line } of diagnostics)
        if (severity !== "note" && marks.get(line) !== "error")
            marks.set(line, severity);
    const lines = text.value.split("\n").length, parts = [];
    let plain = "";
    for (let line = 1; line <= lines; line++) {
        if (!marks.has(line)) {
            plain += `${line}\n`;
            continue;
        }
        parts.push(plain, Object.assign(document.createElement("span"), { className: marks.get(line), textContent: String(line) }));
        plain = "\n";
    }
    $("gutter").replaceChildren(...parts, `${plain}\n\n`);
    $("gutter").scrollTop = text.scrollTop;
}

/** Puts the caret at a place of the document; columns count characters. */
function goTo(line, column, length) {
    const lines = text.value.split("\n"), before = lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0);
    const units = count => [...lines[line - 1] ?? ""].slice(0, count).join("").length;
    text.focus();
    text.setSelectionRange(before + units(column - 1), before + units(column - 1 + length));
    text.scrollTop = Math.max(0, (line - 5) * 18);
}

function setText(value) {
    if (value.length > MAX_TEXT) {
        tell(`The document has ${(value.length / 1e6).toFixed(0)} MB; the page shows documents of up to ${MAX_TEXT >> 20} MB. The program mxgen reads larger ones.`);
        return;
    }
    text.value = value;
    showGutter([]);
    if (!document.body.dataset.picture)
        preview();
    compile();
}

// ---- Results ----

function showMessages(diagnostics) {
    $("messages").replaceChildren(...diagnostics.map(({ severity, id, message, file, line, column, length }) => {
        const item = document.createElement("li"), button = document.createElement("button"), here = file === "document.mtlx" && line > 0;
        button.type = "button";
        button.textContent = `${line ? `${here ? "" : `${file}:`}${line}:${column}: ` : ""}${message} [${id}]`;
        button.disabled = !here;
        button.addEventListener("click", () => goTo(line, column, length));
        item.className = severity;
        item.append(button);
        return item;
    }));
    if (!diagnostics.length)
        $("messages").append(Object.assign(document.createElement("li"), { textContent: "No errors, no warnings." }));
    const errors = diagnostics.filter(({ severity }) => severity === "error").length;
    document.querySelector("[data-tab=messages]").textContent = diagnostics.length ? `Messages (${diagnostics.length})` : "Messages";
    return errors;
}

function showTab(name) {
    for (const button of document.querySelectorAll("[data-tab]")) {
        button.setAttribute("aria-selected", String(button.dataset.tab === name));
        $(button.dataset.tab).hidden = button.dataset.tab !== name;
    }
    if (name !== "messages")
        inspect();
}

async function inspect() {
    const shown = document.querySelector("[aria-selected=true]").dataset.tab;
    if (shown === "messages")
        return;
    const { source, closures } = await compiler.ask("inspect", { text: text.value, element, target: $("target").value });
    $("source").textContent = source;
    $("closures").textContent = closures;
}

function missingTextures() {
    return shader.variables.filter(({ block, file }) => block === "textures" && file && !textures.has(nameOf(file))).map(({ file }) => file);
}

/** While there is no picture: a coarse one, of a smaller shader. */
async function preview() {
    const small = await compiler.ask("preview", { text: text.value }).catch(() => null);
    if (small)
        view?.showPreview(small);
}

async function compile() {
    clearTimeout(pause);
    const number = ++request, started = performance.now();
    try {
        const answer = await compiler.ask("compile", { text: text.value, element });
        if (number !== request)
            return; // a newer text is on its way
        const errors = showMessages(answer.diagnostics);
        showGutter(answer.diagnostics);
        fillSelect($("element"), answer.renderables.map(({ path }) => path), answer.element);
        ({ element } = answer);
        if (answer.shader) {
            ({ shader } = answer);
            view?.setShader(shader);
            nameTextures();
            showInputs($("inputs"), shader.variables, setInput);
            const missing = missingTextures();
            tell(missing.length ? `Drop the missing textures here: ${missing.join(", ")}` : `${shader.info.numClosures} closures, ${Math.round(performance.now() - started)} ms`);
        } else {
            tell(errors ? `${errors} ${errors === 1 ? "error" : "errors"}; the picture shows the last good document` : "The document has no material.");
        }
        await inspect();
    } catch (error) {
        tell(error.message);
    }
    document.body.dataset.compiled = String(number);
}

/** The view knows textures by the whole name in the document. */
const images = new Map();

function nameTextures() {
    for (const { block, file } of shader.variables)
        if (block === "textures" && images.has(nameOf(file)))
            view?.setTexture(file, images.get(nameOf(file)));
}

// ---- Inputs ----

async function setInput(variable, values, isFinal) {
    variable.values = values;
    if (view) {
        view.hasMoved = true;
        view.draw();
    }
    if (!isFinal)
        return;
    try {
        const before = text.value;
        const answer = await compiler.ask("setValue", { text: before, path: variable.path, value: valueText(variable, values), type: variable.documentType });
        if (answer?.text && text.value === before) {
            text.value = answer.text;
            compile();
        }
    } catch (error) {
        tell(`The document keeps its value: ${error.message}`);
    }
}

// ---- Files ----

const nameOf = path => path.slice(path.lastIndexOf("/") + 1);

/** Documents and texts that they include, and textures. */
async function take(files) {
    const texts = [], faults = [];
    let opened = null;
    for (const file of files) {
        try {
            if (file.type.startsWith("image/")) {
                images.set(file.name, await createImageBitmap(file, { imageOrientation: "flipY", premultiplyAlpha: "none", colorSpaceConversion: "none" }));
                textures.add(file.name);
            } else if (file.name.endsWith(".mtlx") && !opened) {
                opened = file;
            } else if (file.size <= MAX_TEXT) {
                texts.push([file.name, await file.text()]);
            } else {
                faults.push(file.name);
            }
        } catch {
            faults.push(file.name);
        }
    }
    for (const [name, content] of texts)
        await compiler.remember("addFile", { name, content });
    if (opened && opened.size > MAX_TEXT)
        setText({ length: opened.size });
    else if (opened)
        setText(await opened.text());
    else
        await compile();
    if (faults.length)
        tell(`The page cannot read ${faults.join(", ")}.`);
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

function listen() {
    text.addEventListener("input", () => {
        clearTimeout(pause);
        pause = setTimeout(compile, PAUSE);
    });
    text.addEventListener("scroll", () => { $("gutter").scrollTop = text.scrollTop; });
    $("example").addEventListener("change", () => setText(EXAMPLES[$("example").value]));
    $("element").addEventListener("change", () => {
        element = $("element").value;
        compile();
    });
    $("shape").addEventListener("change", showShape);
    $("target").addEventListener("change", inspect);
    $("open").addEventListener("change", () => take($("open").files));
    for (const button of document.querySelectorAll("[data-tab]"))
        button.addEventListener("click", () => showTab(button.dataset.tab));
    $("format").addEventListener("click", async () => {
        try {
            setText((await compiler.ask("format", { text: text.value })).text);
        } catch (error) {
            tell(error.message);
        }
    });
    $("share").addEventListener("click", async () => {
        history.replaceState(null, "", await addressOf(text.value));
        const copied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
        tell(copied ? "The link is in the clipboard." : "The address of the page is the link.");
    });
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

function openView() {
    try {
        view = new View($("canvas"));
        showShape(); // which may have been chosen before
        view.onChange = () => { document.body.dataset.whole = "false"; };
        view.onPicture = isWhole => {
            document.body.dataset.picture ??= String(Math.round(performance.now()));
            document.body.dataset.whole = String(isWhole);
        };
        view.onError = fault => tell(`The driver refuses the shader, a bug in mxgen: ${fault}`);
    } catch (error) {
        if (!(error instanceof ViewError))
            throw error;
        $("no-picture").hidden = false;
        $("no-picture").textContent = error.message;
        $("shape").disabled = true;
    }
}

async function begin() {
    fillSelect($("example"), Object.keys(EXAMPLES), "Gold");
    fillSelect($("shape"), SHAPE_NAMES, "ball");
    listen();
    showTab("messages");
    const started = compiler.ask("started"), about = compiler.ask("about");
    let fault = null;
    const isShared = await openAddress().catch(error => { fault = error; });
    if (!isShared)
        setText(gold);
    // To open the view takes the page a while, in which the worker compiles; but a worker starts only while its page waits.
    await started.catch(() => {});
    openView();
    const { targets, version } = await about;
    fillSelect($("target"), targets, "essl");
    document.querySelector("h1").title = `mxgen ${version}`;
    if (fault)
        tell(fault.message);
}

begin().catch(error => tell(error.message));
