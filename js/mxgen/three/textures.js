// SPDX-License-Identifier: Apache-2.0
// The textures of materials. A shader converts colours itself, so textures have no colour space.

import { ClampToEdgeWrapping, DataArrayTexture, DataTexture, DataUtils, HalfFloatType, LinearFilter, LinearMipmapLinearFilter, LoaderUtils, MirroredRepeatWrapping,
         NearestFilter, NearestMipmapNearestFilter, NoColorSpace, RepeatWrapping, RGBAFormat, TextureLoader, UnsignedByteType } from "three";

const WRAPPINGS = { clamp: ClampToEdgeWrapping, constant: ClampToEdgeWrapping, mirror: MirroredRepeatWrapping };

function modesOf({ uaddressmode, vaddressmode, filtertype }) {
    const closest = filtertype === "closest"; // WebGPURenderer gives no sampler to NearestFilter alone
    return { colorSpace: NoColorSpace, wrapS: WRAPPINGS[uaddressmode] ?? RepeatWrapping, wrapT: WRAPPINGS[vaddressmode] ?? RepeatWrapping,
             magFilter: closest ? NearestFilter : LinearFilter, minFilter: closest ? NearestMipmapNearestFilter : LinearMipmapLinearFilter, generateMipmaps: !closest };
}

/** The bytes of an image in another size, rows from below. */
function bytesOf(image, width, height) {
    const context = new OffscreenCanvas(width, height).getContext("2d");
    context.setTransform(1, 0, 0, -1, 0, height);
    context.drawImage(image, 0, 0, width, height);
    return context.getImageData(0, 0, width, height).data;
}

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

    /** The texture of a file, or of the tiles of the variable; null: one texel of the default colour. */
    get(file, { values, tiles, ...variable }) {
        const modes = modesOf(variable), key = JSON.stringify([file, file === null ? values : [modes, tiles]]);
        if (!this.#found.has(key))
            this.#found.set(key, file === null ? this.#texel(values) : tiles.length ? this.#array(tiles, values, modes) : this.#load(file, modes).texture);
        return this.#found.get(key);
    }

    /** Resolves when all files are there or have failed. */
    get ready() {
        return Promise.all(this.#loading);
    }

    /** Begins to load a file; `loaded` resolves to the texture, or to undefined. */
    #load(file, modes) {
        const loader = this.#manager?.getHandler(file) ?? new TextureLoader(this.#manager), address = LoaderUtils.resolveURL(file, this.#path);
        let texture;
        const loaded = new Promise(resolve => { // loaders set modes of their own
            texture = loader.load(address, () => resolve(Object.assign(texture, modes)), undefined,
                                  () => resolve(console.error(`MaterialXMaterial: cannot load ${address}`)));
        });
        this.#loading.push(loaded);
        return { texture: Object.assign(texture, modes, { name: file }), loaded };
    }

    /** Tiles as the layers of an array. Until all are there, each has the default colour. */
    #array(tiles, values, modes) {
        const { data } = this.#texel(values).image, array = new DataArrayTexture(Uint16Array.from({ length: 4 * tiles.length }, (_, i) => data[i % 4]), 1, 1, tiles.length);
        Object.assign(array, { type: HalfFloatType, needsUpdate: true });
        this.#loading.push(Promise.all(tiles.map(({ file }) => this.#load(file, modes).loaded)).then(parts => {
            const images = parts.map(texture => texture?.image);
            if (images.some(image => !image || image.data)) {
                console.error(`MaterialXMaterial: not all tiles of ${tiles[0].file} are images that a canvas draws`);
                return;
            }
            const [{ width, height }] = images, all = new Uint8Array(4 * width * height * images.length);
            images.forEach((image, layer) => all.set(bytesOf(image, width, height), layer * 4 * width * height));
            array.dispose(); // its memory has another size
            Object.assign(array, modes, { image: { data: all, width, height, depth: images.length }, type: UnsignedByteType, needsUpdate: true });
        }));
        return array;
    }

    // Many devices of WebGPU cannot filter 32-bit floats.
    #texel([r = 0, g = r, b = g, a = 1]) {
        const halves = Uint16Array.from([r, g, b, a], value => DataUtils.toHalfFloat(value));
        return Object.assign(new DataTexture(halves, 1, 1, RGBAFormat, HalfFloatType), { needsUpdate: true });
    }

    /** Frees the memory of the device. Textures that are drawn again go there again. */
    dispose() {
        for (const texture of this.#found.values())
            texture.dispose();
    }
}
