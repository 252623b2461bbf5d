// SPDX-License-Identifier: Apache-2.0
// What the page loads beside its editor: how the picture looks, beside its material.

import { element } from "../dom.js";
import { savePicture } from "./save.js";
import { TONES } from "./tones.js";

const SIZES = [512, 1024, 2048];

const labelled = (name, control) => element("label", {}, element("span", { textContent: name }), control);

class Studio {
    #view;
    #tell;

    /** `panel` is for its controls; `tell` takes sentences for the user. */
    constructor({ view, panel, tell }) {
        this.#view = view;
        this.#tell = tell;
        panel.append(this.#looks(), this.#pictures());
    }

    #looks() {
        const tones = element("select", { id: "tones" }, ...Object.keys(TONES).map(name => new Option(name)));
        tones.addEventListener("change", () => { this.#view.tone = TONES[tones.value]; });
        return element("fieldset", {}, element("legend", { textContent: "Look" }), labelled("Tone mapping", tones));
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
