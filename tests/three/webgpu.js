// SPDX-License-Identifier: Apache-2.0
// The renderer that page.js draws with: WebGPURenderer.

import { WebGLRenderer } from "three";
import { ClusteredLighting } from "three/addons/lighting/ClusteredLighting.js";
import { DynamicLighting } from "three/addons/lighting/DynamicLighting.js";
import { WebGPURenderer } from "three/webgpu";
import { lights, positionLocal, vec4 } from "three/tsl";

export { MaterialXLoader, MaterialXNodeMaterial as Material, MaterialXTextures } from "mxgen/three/webgpu";

export const renderer = new WebGPURenderer({ alpha: true }); // where there is no WebGPU, it draws by WebGL 2
await renderer.init();

const { device, gl } = renderer.backend, [owner, name] = device ? [device, "createShaderModule"] : [gl, "createShader"], create = owner[name].bind(owner);
let modules = 0;
owner[name] = (...values) => {
    modules++;
    return create(...values);
};

/** The number that tells one program from another, after a drawing: programs do not go, so their number does. */
export const programOf = () => modules;

/** A surface that covers nothing. */
export function uncover(material) {
    material.surfaceNode = vec4(material.surfaceNode.rgb, 0);
}

/** Nodes of three that change a red sphere in front of nothing. */
export const nodes = {
    none: {}, outputNode: { outputNode: vec4(0, 0, 1, 1) }, maskNode: { maskNode: positionLocal.x.greaterThan(9) }, lightsNode: { lightsNode: lights([]) },
    positionNode: { positionNode: positionLocal.mul(0) },
};

/** Other ways in which three draws lights. */
export const lightings = { clustered: new ClusteredLighting(), dynamic: new DynamicLighting() };

/** The errors that WebGLRenderer throws. */
export function misuse(scene, camera) {
    try {
        new WebGLRenderer().render(scene, camera);
    } catch (error) {
        return error.message;
    }
}
