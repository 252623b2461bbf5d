// SPDX-License-Identifier: Apache-2.0
// The part that materials for both renderers share: each follows a document, whose shader is a function (docs/hosts.md) among code of three.

import { ArgumentError } from "../errors.js";
import { MaterialXTextures } from "./textures.js";

// Names of the host that a function reads: u_NAME is host_NAME there.
const MATRICES = ["world", "view", "projection", "worldView", "viewProjection", "worldViewProjection"];
const HOST_NAMES = ["viewPosition", "viewDirection", ...MATRICES.flatMap(name => ["", "Inverse", "Transpose", "InverseTranspose"].map(kind => `${name}${kind}Matrix`))];

/** Values of HOST_NAMES, from those of MATRICES and the functions that turn them. */
export function hostOf({ viewPosition, viewDirection, matrices, inverse, transpose }) {
    const host = { viewPosition, viewDirection };
    for (const [name, matrix] of Object.entries(matrices))
        Object.assign(host, { [`${name}Matrix`]: matrix, [`${name}InverseMatrix`]: inverse(matrix), [`${name}TransposeMatrix`]: transpose(matrix),
                              [`${name}InverseTransposeMatrix`]: transpose(inverse(matrix)) });
    return host;
}

const OPTIONS = {
    "role": "function", "names": "neutral", "host-environment": true, "texture-modes": "shared", "ambient-occlusion": "none",
    "aovs": "none", "rename": HOST_NAMES.map(name => `u_${name}=host_${name}`),
};

/** The attributes of the geometry that a shader reads beside those of `given`: { name, variable }, named as GLTFLoader names them; `st` of USD is `uv`. */
export function attributesOf(shader, given) {
    return shader.variables.filter(({ block, semantic }) => block === "vertexData" && !(semantic in given)).map(variable => {
        const [kind, name] = variable.semantic.split(":");
        return { name: { texcoord: `uv${name}`, color: `color_${name}` }[kind] ?? name.replace(/\W/g, "_").replace(/^st(?=[123]?$)/, "uv"), variable };
    });
}

/**
 * A class over a standard material of three, so that the scene's lights, environment and fog apply. Its own class has `_uniform(variable, value)`,
 * which makes a uniform, an object with a `value`, and `_setShader(shader)`, for new code. index.d.ts describes the members.
 */
export const following = (Standard, target) => class extends Standard {
    #document = null;
    #shader = null;
    #element;
    #options;

    constructor(document, { element = null, options = {}, path = "", manager = undefined, textures = new MaterialXTextures(path, manager), ...parameters } = {}) {
        super();
        this.isMaterialXMaterial = true;
        this.premultipliedAlpha = true;
        this.uniforms = {};
        this.textures = textures;
        for (const key of Object.keys(options))
            if (key in OPTIONS)
                throw new ArgumentError(`the material sets the option '${key}' itself`);
        this.#element = element;
        this.#options = options;
        this.document = document;
        this.setValues(parameters);
    }

    get shader() {
        return this.#shader;
    }

    get document() {
        return this.#document;
    }

    /** Follows an edit: other values go to the uniforms, other code makes another program. */
    set document(document) {
        const before = this.#shader, after = before && this.#generate(document, { withoutSource: true });
        const isNew = !before || before.change(after).kind === "shader";
        // With the values of the document: most materials are opaque, although their opacity is a uniform.
        const reduced = this.#generate(document, { withoutSource: true }, { interface: "reduced" });
        this.transparent = reduced.info.alpha === "blend";
        this.#shader = isNew ? this.#generate(document) : after;
        this.#document = document;
        for (const variable of this.#shader.variables)
            this.#setUniform(variable, isNew);
        if (isNew) {
            this.name = this.#shader.info.name;
            this.vertexColors = this.#shader.variables.some(({ semantic }) => semantic === "color:0");
            this._setShader(this.#shader);
            this.needsUpdate = true;
        }
        for (const old of [before, reduced, isNew && after])
            old?.destroy?.();
    }

    /** The source of its function for another target. */
    _sourceOf(other) {
        const shader = this.#generate(this.#document, {}, {}, other), source = shader.pixel;
        shader.destroy();
        return source;
    }

    #generate(document, request, options, other = target) {
        return document.generate(other, { element: this.#element, ...request, options: { ...this.#options, ...OPTIONS, ...options } });
    }

    #setUniform(variable, isNew) {
        const { block, name, values, file } = variable, isKept = block === "privateUniforms" && name in this.uniforms; // by the host
        if (!["textures", "publicUniforms", "privateUniforms"].includes(block) || isKept)
            return;
        const value = block === "textures" ? this.textures.get(file ? this.#shader.textureFile(variable) : null, variable) : values.length === 1 ? values[0] : values;
        if (isNew)
            this.uniforms[name] = this._uniform(variable, value);
        else
            this.#write(name, value);
    }

    #write(name, value) {
        const uniform = this.uniforms[name];
        if (uniform.value?.fromArray)
            uniform.value.fromArray(value);
        else
            uniform.value = value;
    }

    setInput(path, value) {
        const variable = this.#shader.findVariable(path);
        if (variable)
            this.#write(variable.name, variable.block === "textures" ? this.textures.get(value || null, variable) : value?.toArray?.() ?? value);
        return variable !== null;
    }

    /** Textures and programs of the shader stay this material's own. */
    copy(source, own = {}) {
        const { uniforms } = this;
        super.copy(source);
        Object.assign(this, own, { uniforms });
        for (const { name } of this.#shader.variables)
            if (name in source.uniforms)
                this.#write(name, source.uniforms[name].value?.toArray?.() ?? source.uniforms[name].value);
        return this;
    }

    clone() {
        return new this.constructor(this.#document, { element: this.#element, options: this.#options, textures: this.textures }).copy(this);
    }
};
