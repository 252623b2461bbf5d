// SPDX-License-Identifier: Apache-2.0
// Pictures of Radiance (.hdr): Ward 1991, "Real Pixels", and the RLE of its scanlines.

import { Unreadable } from "./unreadable.js";

const MAX_HEADER = 1 << 16; // bytes

/** The lines of the header, the last one with the resolution, and where the pixels begin. */
function readHeader(bytes) {
    const lines = [];
    let at = 0;
    for (let wasEmpty = false; ;) {
        const end = bytes.indexOf(10, at);
        if (end < 0 || end > MAX_HEADER)
            throw new Unreadable("its header has no end");
        const line = String.fromCharCode(...bytes.subarray(at, end)).trim();
        at = end + 1;
        lines.push(line);
        if (wasEmpty)
            return { lines, at };
        wasEmpty = line === "";
    }
}

function sizeOf({ lines }) {
    const format = lines.find(line => line.startsWith("FORMAT="));
    if (!lines[0].startsWith("#?"))
        throw new Unreadable("it does not begin with '#?RADIANCE'");
    if (format && format !== "FORMAT=32-bit_rle_rgbe")
        throw new Unreadable(`its pixels are '${format.slice(7)}'; the page reads 32-bit_rle_rgbe`);
    const [, height, width] = /^-Y (\d{1,6}) \+X (\d{1,6})$/.exec(lines.at(-1)) ?? [];
    if (!(width > 0 && height > 0))
        throw new Unreadable(`its size is '${lines.at(-1)}'; the page reads rows from the top, '-Y height +X width'`);
    return { width: Number(width), height: Number(height) };
}

/** A scanline whose components stand one after the other, each with runs; returns where it ends. */
function readRuns(bytes, at, width, line) {
    for (let component = 0; component < 4; component++)
        for (let x = 0; x < width;) {
            const head = bytes[at++], count = head > 128 ? head - 128 : head;
            if (!(count > 0 && x + count <= width))
                throw new Unreadable("its pixels are damaged");
            for (let i = 0; i < count; i++)
                line[4 * x++ + component] = bytes[head > 128 ? at : at + i];
            at += head > 128 ? 1 : count;
        }
    return at;
}

/** A scanline of whole pixels; red, green and blue of 1 repeat the one before. */
function readPixels(bytes, at, width, line) {
    for (let x = 0, shift = 0; x < width; at += 4) {
        const [r, g, b, e] = bytes.subarray(at, at + 4);
        if (r === 1 && g === 1 && b === 1 && x > 0) {
            for (let count = Math.min(e << shift, width - x); count > 0; count--, x++)
                line.copyWithin(4 * x, 4 * x - 4, 4 * x);
            shift += 8;
        } else {
            line.set([r, g, b, e], 4 * x++);
            shift = 0;
        }
        if (shift > 16 || at + 4 > bytes.length)
            throw new Unreadable("its pixels are damaged");
    }
    return at;
}

/** The pixels as RGBA, rows from the top. `allow(width, height)` throws if they are too many. */
export function readHdr(bytes, allow) {
    const header = readHeader(bytes), { width, height } = sizeOf(header);
    allow(width, height);
    const pixels = new Float32Array(4 * width * height), line = new Uint8Array(4 * width);
    let { at } = header;
    for (let y = 0; y < height; y++) {
        if (at + 4 > bytes.length)
            throw new Unreadable(`it ends after ${y} of ${height} rows`);
        const isRuns = width >= 8 && width < 1 << 15 && bytes[at] === 2 && bytes[at + 1] === 2 && (bytes[at + 2] << 8 | bytes[at + 3]) === width;
        at = isRuns ? readRuns(bytes, at + 4, width, line) : readPixels(bytes, at, width, line);
        for (let x = 0; x < width; x++) {
            const scale = line[4 * x + 3] ? 2 ** (line[4 * x + 3] - 136) : 0, to = 4 * (y * width + x);
            for (let c = 0; c < 3; c++)
                pixels[to + c] = scale * line[4 * x + c];
            pixels[to + 3] = 1;
        }
    }
    return { width, height, pixels };
}
