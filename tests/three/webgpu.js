// SPDX-License-Identifier: Apache-2.0
// What page.js draws with, for WebGPURenderer.

import { WebGLRenderer } from "three";
import { ClusteredLighting } from "three/addons/lighting/ClusteredLighting.js";
import { DynamicLighting } from "three/addons/lighting/DynamicLighting.js";
import { WebGPURenderer } from "three/webgpu";
import { bool, lights, positionLocal, vec4 } from "three/tsl";

export { MaterialXLoader, MaterialXNodeMaterial as Material } from "mxgen/three/webgpu";

export const renderer = new WebGPURenderer({ alpha: true });
await renderer.init();
if (!renderer.backend.isWebGPUBackend)
    throw new Error("no WebGPU here");

const { device } = renderer.backend, createShaderModule = device.createShaderModule.bind(device);
let modules = 0;
device.createShaderModule = descriptor => {
    modules++;
    return createShaderModule(descriptor);
};

/** What tells one program from another, after a drawing: programs do not go, so their number does. */
export const programOf = () => modules;

/** A surface that covers nothing. */
export function uncover(material) {
    material.surfaceNode = vec4(material.surfaceNode.rgb, 0);
}

/** Nodes of three that change a red sphere in front of nothing. */
export const nodes = {
    none: {}, outputNode: { outputNode: vec4(0, 0, 1, 1) }, maskNode: { maskNode: bool(false) }, lightsNode: { lightsNode: lights([]) },
    positionNode: { positionNode: positionLocal.mul(0) },
};

/** Other ways in which three draws lights. */
export const lightings = { clustered: new ClusteredLighting(), dynamic: new DynamicLighting() };

/** Draws with other renderers, and gives what they throw. */
export async function misuse(scene, camera) {
    const fallback = new WebGPURenderer({ forceWebGL: true });
    await fallback.init();
    fallback.render(scene, camera);
    try {
        new WebGLRenderer().render(scene, camera);
    } catch (error) {
        return error.message;
    }
}
