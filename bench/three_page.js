// SPDX-License-Identifier: Apache-2.0
// The browser's part of three.mjs: a material by mxgen/three, or by three's own MaterialXLoader, on the sphere under the sky.

import * as THREE from "three";
import { MaterialXLoader as Theirs } from "three/addons/loaders/MaterialXLoader.js";
import { WebGPURenderer } from "three/webgpu";
import { MaterialXLoader as Ours } from "mxgen/three";

import { CAMERA, encode, pixelsOf, SIZE, SKY, sphere } from "../tests/three/studio.js";

function prepared(renderer) {
    renderer.setPixelRatio(2);
    renderer.setSize(SIZE, SIZE);
    renderer.setClearColor(0, 0);
    return Object.assign(renderer, { toneMapping: THREE.LinearToneMapping, toneMappingExposure: 0.6 });
}

const geometry = sphere();
geometry.computeTangents();
let mine = null, own = null;

async function rendererOf(isOurs) {
    if (isOurs)
        return mine ??= prepared(new THREE.WebGLRenderer({ alpha: true, preserveDrawingBuffer: true }));
    if (!own) {
        own = prepared(new WebGPURenderer({ alpha: true, forceWebGL: true }));
        await own.init();
    }
    return own;
}

/** The bytes of a PNG file. Throws what the loader says. Both loaders wait for textures. */
window.drawDocument = async (isOurs, url, name) => {
    const manager = new THREE.LoadingManager(), Loader = isOurs ? Ours : Theirs, renderer = await rendererOf(isOurs);
    const { materials } = await new Loader(manager).loadAsync(url);
    const found = Object.entries(materials).find(([path]) => path.split("/").at(-1) === name), material = found?.[1] ?? Object.values(materials)[0];
    const scene = new THREE.Scene();
    scene.environment = SKY;
    if (material.transparent)
        material.side = THREE.DoubleSide; // as mxgen render
    scene.add(new THREE.Mesh(geometry, material));
    renderer.render(scene, CAMERA);
    const picture = pixelsOf(renderer.domElement);
    material.dispose();
    return encode(picture);
};
window.drawingIsReady = true;
