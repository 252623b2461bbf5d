// SPDX-License-Identifier: Apache-2.0
// The studio of `mxgen render` for three: its sphere, its sky without lights, its camera.

import * as THREE from "three";

import { makeMesh, makeSky } from "../../web/scene.js";

export const SIZE = 256;

/** The sphere of `mxgen render`. */
export function sphere() {
    const mesh = makeMesh("sphere", 1), geometry = new THREE.BufferGeometry();
    for (const [name, values, size] of [["position", mesh.position, 3], ["normal", mesh.normal, 3], ["uv", mesh.texcoord, 2]])
        geometry.setAttribute(name, new THREE.BufferAttribute(values, size));
    return geometry.setIndex(new THREE.BufferAttribute(mesh.indices, 1));
}

/** The map of the sky for three: rows from below, and a quarter turn, because u = 0.5 is +x for three and -z for MaterialX. */
function sky() {
    const { width, height, pixels } = makeSky().radiance[0], turned = new Float32Array(pixels.length);
    for (let y = 0; y < height; y++)
        for (let x = 0; x < width; x++)
            turned.set(pixels.subarray(4 * (y * width + (x + width / 4) % width), 4 * (y * width + (x + width / 4) % width) + 4), 4 * ((height - 1 - y) * width + x));
    const texture = new THREE.DataTexture(turned, width, height, THREE.RGBAFormat, THREE.FloatType, THREE.EquirectangularReflectionMapping);
    Object.assign(texture, { wrapS: THREE.RepeatWrapping, minFilter: THREE.LinearFilter, magFilter: THREE.LinearFilter, needsUpdate: true });
    return texture;
}

export const SKY = sky();

/** Azimuth and elevation in degrees, as `mxgen render --camera`. */
export function cameraAt(azimuth, elevation, distance, field) {
    const camera = new THREE.PerspectiveCamera(field, 1, 0.1, 100), [a, e] = [azimuth, elevation].map(THREE.MathUtils.degToRad);
    camera.position.set(Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e)).multiplyScalar(distance);
    camera.lookAt(0, 0, 0);
    return camera;
}

export const CAMERA = cameraAt(25, 16, 5, 30);

/** The picture of a canvas, rows from the top. */
export function pixelsOf(canvas) {
    const context = new OffscreenCanvas(SIZE, SIZE).getContext("2d");
    context.drawImage(canvas, 0, 0, SIZE, SIZE);
    return context.getImageData(0, 0, SIZE, SIZE);
}

/** The bytes of a PNG file. */
export async function encode(picture) {
    const canvas = new OffscreenCanvas(SIZE, SIZE);
    canvas.getContext("2d").putImageData(picture, 0, 0);
    return [...new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer())];
}
