// SPDX-License-Identifier: Apache-2.0
// A loader with the interface of three's loaders.

import { FileLoader, Loader, LoaderUtils } from "three";
import { load } from "mxgen";

import { MaterialXTextures } from "./textures.js";

let compiler = null; // that all loaders share

function sharedCompiler() {
    compiler ??= load().catch(error => {
        compiler = null;
        throw error;
    });
    return compiler;
}

/** The loader whose materials are of a class. */
export const loaderOf = Material => class MaterialXLoader extends Loader {
    #context = null;
    #parameters = {};

    /** Uses a compiler that is there already; otherwise the first `load` of any loader loads one. */
    setCompiler(mxgen) {
        this.#context = mxgen.createContext();
        return this;
    }

    /** Each material gets these: options of generation, and parameters of three such as `side`. */
    setParameters(parameters) {
        this.#parameters = parameters;
        return this;
    }

    load(url, onLoad, onProgress, onError = console.error) {
        this.manager.itemStart(url);
        this.#load(url, onProgress).then(onLoad).catch(error => {
            onError(error);
            this.manager.itemError(url);
        }).finally(() => this.manager.itemEnd(url));
    }

    async #load(url, onProgress) {
        this.#context ??= (await sharedCompiler()).createContext();
        const address = LoaderUtils.resolveURL(url, this.path);
        const files = new FileLoader(this.manager).setRequestHeader(this.requestHeader).setWithCredentials(this.withCredentials);
        const document = await this.#context.loadAsync(address, async (from, ref) => {
            const name = from ? LoaderUtils.resolveURL(ref, LoaderUtils.extractUrlBase(from)) : ref;
            return { name, data: await files.loadAsync(name, onProgress) };
        });
        const result = this.#materials(document, address);
        await result.textures.ready;
        return result;
    }

    /** The materials of a text, after `setCompiler`. `path` is that of its textures. */
    parse(text, path = this.path) {
        if (!this.#context)
            throw new Error("MaterialXLoader.parse needs a compiler: loader.setCompiler(await load())");
        return this.#materials(this.#context.parse(text, { name: `${path}document.mtlx` }), path);
    }

    #materials(document, address) {
        const textures = new MaterialXTextures(this.resourcePath || LoaderUtils.extractUrlBase(address), this.manager);
        const materials = Object.fromEntries(document.renderables.map(
            ({ path }) => [path, new Material(document, { ...this.#parameters, element: path, textures })]));
        return { document, materials, textures };
    }
};
