// SPDX-License-Identifier: Apache-2.0
// What the page loads beside its editor: how the picture looks, beside its material.

import { Compiler } from "../compiler.js";
import { element } from "../dom.js";
import readerSource from "reader.bundle.js";
import { savePicture } from "./save.js";
import { TONES } from "./tones.js";

const SIZES = [512, 1024, 2048];
const MAX_FILE = 256 << 20; // bytes
const SKY = "Sky";

const labelled = (name, control) => element("label", {}, element("span", { textContent: name }), control);

class Studio {
    #view;
    #tell;
    #reader = new Compiler(readerSource, "it takes longer than 20 seconds");
    #light = element("select", { id: "light" }, new Option(SKY));

    /** `panel` is for its controls; `tell` takes sentences for the user. */
    constructor({ view, panel, tell }) {
        this.#view = view;
        this.#tell = tell;
        panel.append(this.#looks(), this.#pictures());
    }

    /** Takes a file of light; returns messages about it: severity, id and message. */
    async take(file) {
        try {
            if (file.size > MAX_FILE)
                throw new Error(`it has ${(file.size / 1e6).toFixed(0)} MB; the page reads files of up to ${MAX_FILE >> 20} MB`);
            const { maps, notes } = await this.#reader.ask("light", { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) });
            this.#offerLight(file.name, maps);
            return notes.map(note => ({ severity: "warning", id: "bad-pixels", message: `Of '${file.name}' ${note}.` }));
        } catch (error) {
            return [{ severity: "error", id: "bad-environment", message: `cannot use the environment '${file.name}': ${error.message}` }];
        }
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
            element("p", { textContent: "Drop a map of light (.hdr, .exr) on the page." }));
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
