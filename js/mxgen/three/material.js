// SPDX-License-Identifier: Apache-2.0
// A material of a document, for three's WebGLRenderer.

import { MeshStandardMaterial, ShaderLib, UniformsUtils } from "three";

import { attributesOf, following } from "./following.js";
import { PARAMETERS, stagesOf } from "./shader.js";

/** Its stages come from the document: the colour, roughness and the other inputs of a standard material have no effect. */
export class MaterialXMaterial extends following(MeshStandardMaterial, "essl") {
    type = "MaterialXMaterial";

    _uniform(variable, value) {
        return { value };
    }

    _setShader(shader) {
        const attributes = attributesOf(shader, PARAMETERS), reads = new Set(shader.variables.map(({ semantic }) => semantic));
        Object.assign(this, stagesOf(shader, attributes));
        this.uniforms = { ...UniformsUtils.clone(ShaderLib.standard.uniforms), ...this.uniforms };
        this.anisotropy = ["tangent:world", "tangent:object", "bitangent:world", "bitangent:object"].some(name => reads.has(name)) ? 1 : 0; // asks three for tangents
        this.defines = Object.fromEntries(attributes.filter(({ name }) => /^uv[123]$/.test(name)).map(({ name }) => [`USE_${name.toUpperCase()}`, ""]));
        this.defaultAttributeValues = Object.fromEntries([["color", [1, 1, 1, 1]], ...attributes.map(({ name, variable }) => [name, variable.values])]);
    }

    copy(source) {
        return super.copy(source, { defines: this.defines });
    }
}
