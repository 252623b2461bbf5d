// SPDX-License-Identifier: Apache-2.0
// The page loads this beside its editor: how the picture looks, beside its material.

import { Compiler } from "../compiler.js";
import { element } from "../dom.js";
import { Compare } from "./compare.js";
import readerSource from "reader.bundle.js";
import { refine } from "./mesh.js";
import { savePicture } from "./save.js";
import { TONES } from "./tones.js";

const SIZES = [512, 1024, 2048];
const SLABS = [["off", ""], ["any number", "0"], ["at most 4", "4"], ["at most 2", "2"], ["at most 1", "1"]]; // name, limit
const MAX_FILE = 256 << 20; // bytes
const SKY = "Sky";
const MESH = /\.(obj|glb)$/i;

const labelled = (name, control) => element("label", {}, element("span", { textContent: name }), control);

class Studio {
    #view;
    #shape;
    #tell;
    #reader = new Compiler(readerSource, "it takes longer than 20 seconds");
    #light = element("select", { id: "light" }, new Option(SKY));

    /**
     * `picture` is the element that the view fills, `panel` is for controls, `shape` the list of shapes. `tell` takes sentences for the user,
     * `setOptions` options of generation.
     */
    constructor({ view, picture, panel, shape, tell, setOptions }) {
        this.#view = view;
        this.#shape = shape;
        this.#tell = tell;
        new Compare(view, picture);
        panel.append(this.#looks(), this.#shaders(setOptions), this.#pictures());
    }

    /** Takes a file of light or of a mesh; returns messages about it: severity, id and message. */
    async take(file) {
        const isMesh = MESH.test(file.name), thing = `the ${isMesh ? "mesh" : "environment"} '${file.name}'`;
        try {
            if (file.size > MAX_FILE)
                throw new Error(`it has ${(file.size / 1e6).toFixed(0)} MB; the page reads files of up to ${MAX_FILE >> 20} MB`);
            const { maps, mesh, notes } = await this.#reader.ask(isMesh ? "mesh" : "light", { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) });
            if (isMesh)
                this.#offerMesh(file.name, mesh);
            else
                this.#offerLight(file.name, maps);
            return notes.map(note => ({ severity: "warning", id: "", message: `${thing} ${note}` }));
        } catch (error) {
            return [{ severity: "error", id: isMesh ? "bad-mesh" : "bad-environment", message: `cannot use ${thing}: ${error.message}` }];
        }
    }

    #offerMesh(name, mesh) {
        this.#view.addShape(name, detail => detail > 1 ? refine(mesh) : mesh);
        if (![...this.#shape.options].some(({ value }) => value === name))
            this.#shape.append(new Option(name));
        this.#shape.value = name;
        this.#shape.dispatchEvent(new Event("change"));
    }

    #offerLight(name, maps) {
        this.#light.replaceChildren(new Option(SKY), new Option(name, name, false, true));
        this.#light.onchange = () => { this.#view.light = this.#light.value === name ? maps : null; };
        this.#light.onchange();
    }

    #looks() {
        const tones = element("select", { id: "tones" }, ...Object.keys(TONES).map(name => new Option(name)));
        tones.addEventListener("change", () => { this.#view.tone = TONES[tones.value]; });
        return element("fieldset", {}, element("legend", { textContent: "Look" }), labelled("Light", this.#light), labelled("Tone mapping", tones),
            element("p", { textContent: "Drop a map of light (.hdr, .exr) or a mesh (.obj, .glb) on the page." }));
    }

    /** Budgets, to compare what they cost. */
    #shaders(setOptions) {
        const quality = element("select", { id: "quality" }, ...["reference", "good", "draft"].map(name => new Option(name)));
        const slabs = element("select", { id: "slabs" }, ...SLABS.map(([name, limit]) => new Option(name, limit)));
        for (const select of [quality, slabs])
            select.addEventListener("change", () => setOptions({ quality: quality.value, ...(slabs.value && { "slabs": "true", "max-slabs": slabs.value }) }));
        return element("fieldset", {}, element("legend", { textContent: "Shader" }), labelled("Quality", quality), labelled("Slabs", slabs));
    }

    #pictures() {
        const size = element("select", { id: "size" }, ...SIZES.map(pixels => new Option(`${pixels} × ${pixels}`, pixels)));
        const isTransparent = element("input", { id: "transparent", type: "checkbox" }), button = element("button", { id: "save", type: "button", textContent: "Save picture" });
        size.value = "1024";
        button.addEventListener("click", async () => {
            button.disabled = true;
            await this.#save(Number(size.value), isTransparent.checked).catch(error => this.#tell(error.message));
            button.disabled = false;
        });
        return element("fieldset", {}, element("legend", { textContent: "Picture" }), labelled("Size", size), labelled("Transparent", isTransparent), button);
    }

    async #save(size, isTransparent) {
        const picture = await this.#view.takePicture(size, isTransparent);
        if (picture)
            await savePicture(picture, this.#view.title);
        else
            this.#tell("There is no picture.");
    }
}

globalThis.mxgenStudio(Studio);
