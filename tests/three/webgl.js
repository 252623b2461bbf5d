// SPDX-License-Identifier: Apache-2.0
// The renderer that page.js draws with: WebGLRenderer.

import { WebGLRenderer } from "three";

export { MaterialXLoader, MaterialXMaterial as Material, MaterialXTextures } from "mxgen/three";

export const renderer = new WebGLRenderer({ alpha: true, preserveDrawingBuffer: true, premultipliedAlpha: true });

/** The number that tells one program from another, after a drawing. */
export const programOf = material => renderer.properties.get(material).currentProgram.id;

/** A surface that covers nothing. */
export function uncover(material) {
    material.fragmentShader = material.fragmentShader.replace("float covered", "shaded.alpha = 0.0; float covered");
}
