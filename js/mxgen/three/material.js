// SPDX-License-Identifier: Apache-2.0
// A material of a document, for three's WebGLRenderer.

import { MeshStandardMaterial, ShaderLib, UniformsUtils } from "three";

import { ArgumentError } from "../errors.js";
import { attributesOf, OPTIONS, stagesOf } from "./shader.js";
import { MaterialXTextures } from "./textures.js";

/**
 * For three it is a standard material, so the scene's lights, environment and fog apply, but its stages come from the document: its colour,
 * roughness and the other inputs of a standard material have no effect. index.d.ts describes the members.
 */
export class MaterialXMaterial extends MeshStandardMaterial {
    #document = null;
    #shader = null;
    #element;
    #options;

    constructor(document, { element = null, options = {}, path = "", manager = undefined, textures = new MaterialXTextures(path, manager), ...parameters } = {}) {
        super();
        this.isMaterialXMaterial = true;
        this.type = "MaterialXMaterial";
        this.premultipliedAlpha = true;
        this.uniforms = UniformsUtils.clone(ShaderLib.standard.uniforms);
        this.textures = textures;
        for (const key of Object.keys(options))
            if (key in OPTIONS)
                throw new ArgumentError(`MaterialXMaterial sets the option '${key}' itself`);
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
        if (isNew)
            this.#setStages();
        for (const variable of this.#shader.variables)
            this.#setUniform(variable);
        for (const old of [before, reduced, isNew && after])
            old?.destroy?.();
    }

    #generate(document, request, options) {
        return document.generate("essl", { element: this.#element, ...request, options: { ...this.#options, ...OPTIONS, ...options } });
    }

    #setStages() {
        const shader = this.#shader, attributes = attributesOf(shader), reads = new Set(shader.variables.map(({ semantic }) => semantic));
        Object.assign(this, stagesOf(shader));
        this.name = shader.info.name;
        this.vertexColors = reads.has("color:0");
        this.anisotropy = ["tangent:world", "tangent:object", "bitangent:world", "bitangent:object"].some(name => reads.has(name)) ? 1 : 0; // asks three for tangents
        this.defines = Object.fromEntries(attributes.filter(({ name }) => /^uv[123]$/.test(name)).map(({ name }) => [`USE_${name.toUpperCase()}`, ""]));
        this.defaultAttributeValues = Object.fromEntries([["color", [1, 1, 1, 1]], ...attributes.map(({ name, variable }) => [name, variable.values])]);
        this.needsUpdate = true;
    }

    #setUniform(variable) {
        const { block, name, values, file } = variable;
        if (block === "textures")
            this.uniforms[name] = { value: this.textures.get(file ? this.#shader.textureFile(variable) : null, variable) };
        else if (block === "publicUniforms" || block === "privateUniforms" && !(name in this.uniforms))
            this.uniforms[name] = { value: values.length === 1 ? values[0] : values };
    }

    setInput(path, value) {
        const variable = this.#shader.findVariable(path);
        if (variable?.block === "textures")
            this.uniforms[variable.name].value = this.textures.get(value || null, variable);
        else if (variable)
            this.uniforms[variable.name].value = value?.toArray?.() ?? value;
        return variable !== null;
    }

    copy(source) {
        const { defines } = this;
        super.copy(source);
        for (const { name } of this.#shader.variables)
            if (name in source.uniforms)
                this.uniforms[name].value = source.uniforms[name].value;
        return Object.assign(this, { defines });
    }

    clone() {
        return new MaterialXMaterial(this.#document, { element: this.#element, options: this.#options, textures: this.textures }).copy(this);
    }
}
