// SPDX-License-Identifier: Apache-2.0
// The textures of materials. A shader converts colours itself, so textures have no colour space.

import { ClampToEdgeWrapping, DataTexture, FloatType, LinearFilter, LinearMipmapLinearFilter, LoaderUtils, MirroredRepeatWrapping, NearestFilter,
         NoColorSpace, RepeatWrapping, RGBAFormat, TextureLoader } from "three";

const WRAPPINGS = { clamp: ClampToEdgeWrapping, constant: ClampToEdgeWrapping, mirror: MirroredRepeatWrapping };

/** Loads each file once for each of its modes. Materials that share one share its textures. */
export class MaterialXTextures {
    #path;
    #manager;
    #found = new Map();
    #loading = [];

    constructor(path, manager) {
        this.#path = path;
        this.#manager = manager;
    }

    /** The texture of a file; null: one texel of the default colour. */
    get(file, { values, uaddressmode, vaddressmode, filtertype }) {
        const key = JSON.stringify([file, file === null ? values : [uaddressmode, vaddressmode, filtertype]]);
        if (!this.#found.has(key))
            this.#found.set(key, file === null ? this.#texel(values) : this.#load(file, uaddressmode, vaddressmode, filtertype));
        return this.#found.get(key);
    }

    /** Resolves when all files are there or have failed. */
    get ready() {
        return Promise.all(this.#loading);
    }

    #load(file, uaddressmode, vaddressmode, filtertype) {
        const loader = this.#manager?.getHandler(file) ?? new TextureLoader(this.#manager), closest = filtertype === "closest";
        const address = LoaderUtils.resolveURL(file, this.#path);
        let texture;
        this.#loading.push(new Promise(resolve => {
            texture = loader.load(address, resolve, undefined, () => resolve(console.error(`MaterialXMaterial: cannot load ${address}`)));
        }));
        return Object.assign(texture, {
            name: file, colorSpace: NoColorSpace, wrapS: WRAPPINGS[uaddressmode] ?? RepeatWrapping, wrapT: WRAPPINGS[vaddressmode] ?? RepeatWrapping,
            magFilter: closest ? NearestFilter : LinearFilter, minFilter: closest ? NearestFilter : LinearMipmapLinearFilter, generateMipmaps: !closest,
        });
    }

    #texel([r = 0, g = r, b = g, a = 1]) {
        const texture = new DataTexture(Float32Array.of(r, g, b, a), 1, 1, RGBAFormat, FloatType);
        texture.needsUpdate = true;
        return texture;
    }

    /** Frees the memory of the device. Textures that are drawn again go there again. */
    dispose() {
        for (const texture of this.#found.values())
            texture.dispose();
    }
}
