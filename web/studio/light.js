// SPDX-License-Identifier: Apache-2.0
// Light from the file of a latitude-longitude map.

import { halve, lightOf } from "../scene.js";
import { readExr } from "./exr.js";
import { readHdr } from "./hdr.js";
import { Unreadable } from "./unreadable.js";

const MAX_PIXELS = 1 << 25; // 8192 x 4096
const MAX_WIDTH = 2048; // of what is drawn
const MAX_HALF = 65504;

function allow(width, height) {
    if (!(width > 0 && height > 0))
        throw new Unreadable("it has no pixels");
    if (width * height > MAX_PIXELS)
        throw new Unreadable(`it has ${width} × ${height} pixels; the page reads up to 8192 × 4096`);
}

/** Light is neither negative nor without bound, as in render/environment_file.c. Returns how many pixels were not finite. */
function makeSane({ pixels }) {
    let numBad = 0;
    for (let i = 0; i < pixels.length; i++) {
        const isBound = pixels[i] < 1e9;
        numBad += isBound ? 0 : 1;
        pixels[i] = isBound && pixels[i] > 0 ? pixels[i] : 0;
    }
    return numBad;
}

/** The maps of a file (lightOf of scene.js), and notes for the user. */
export function readLight(name, bytes) {
    let map = /\.hdr$/i.test(name) ? readHdr(bytes, allow) : readExr(bytes, allow);
    const numBad = makeSane(map);
    while (map.width > MAX_WIDTH)
        map = halve(map);
    const maps = lightOf(map);
    for (const { pixels } of [...maps.radiance, ...maps.irradiance]) // which the device stores as halves
        pixels.forEach((x, i) => { pixels[i] = Math.min(x, MAX_HALF); });
    return { maps, notes: numBad ? [`has ${numBad} numbers that are NaN, infinite or larger than 1e9; they are 0 here`] : [] };
}
