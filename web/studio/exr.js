// SPDX-License-Identifier: Apache-2.0
// Pictures of OpenEXR. The package parse-exr decodes pixels; what it would read wrongly is told before.

import parseExr from "parse-exr";
import { Unreadable } from "./unreadable.js";

const FLOAT = 1015; // what parse-exr calls numbers of 32 bits
/** By their numbers: name, rows of a block. null: the package has none. */
const COMPRESSIONS = [["none", 1], ["RLE", 1], ["ZIPS", 1], ["ZIP", 16], ["PIZ", 32], ["PXR24", 16], null, null, ["DWAA", 32], ["DWAB", 256]];
const PIXEL_TYPES = ["integers", "half", "float"];

/** The attributes of the header, as views of their bytes, and where it ends. */
function attributesOf(view) {
    const found = new Map();
    let at = 8;
    const word = () => {
        let text = "";
        for (let code; (code = view.getUint8(at++)) !== 0;)
            text += String.fromCharCode(code);
        return text;
    };
    for (let name; (name = word());) {
        word(); // the type
        const size = view.getUint32(at, true);
        found.set(name, new DataView(view.buffer, view.byteOffset + at + 4, size));
        at += 4 + size;
    }
    return { attributes: found, end: at };
}

/** The channels by their names: their type, and whether they have fewer pixels. */
function channelsOf(view) {
    const channels = new Map();
    for (let at = 0; view.getUint8(at) !== 0; at += 16) {
        let name = "";
        for (let code; (code = view.getUint8(at++)) !== 0;)
            name += String.fromCharCode(code);
        channels.set(name, { type: view.getInt32(at, true), isWhole: view.getInt32(at + 8, true) === 1 && view.getInt32(at + 12, true) === 1 });
    }
    return channels;
}

/** Throws unless blocks of rows follow each other behind the table of their places, and are whole. */
function checkBlocks(view, end, top, bottom, numRows) {
    const numBlocks = Math.ceil((bottom - top + 1) / numRows);
    let at = end + 8 * numBlocks;
    for (let block = 0; block < numBlocks; block++) {
        if (view.getInt32(at, true) !== top + block * numRows)
            throw new Unreadable("its rows are not in their order");
        at += 8 + view.getUint32(at + 4, true);
    }
    if (at > view.byteLength)
        throw new Unreadable("it ends before its last row");
}

/** Throws if the package would not read the file, or not rightly. */
function check(view, allow) {
    if (view.getUint32(0, true) !== 20000630)
        throw new Unreadable("it is no picture of OpenEXR");
    if (view.getUint32(4, true) & 0x1a00)
        throw new Unreadable("it has tiles, depths or several parts; the page reads one picture of scanlines");
    const { attributes, end } = attributesOf(view), box = attributes.get("dataWindow"), channels = channelsOf(attributes.get("channels"));
    const [left, top, right, bottom] = [0, 4, 8, 12].map(at => box.getInt32(at, true));
    allow(right - left + 1, bottom - top + 1);
    if (attributes.get("lineOrder").getUint8(0) !== 0)
        throw new Unreadable("its rows begin at the bottom; the page reads rows from the top");
    const compression = COMPRESSIONS[attributes.get("compression").getUint8(0)];
    if (!compression)
        throw new Unreadable(`its compression is unknown; the page reads ${COMPRESSIONS.filter(Boolean).map(([name]) => name).join(", ")}`);
    checkBlocks(view, end, top, bottom, compression[1]);
    const kinds = new Set([...channels.values()].map(({ type, isWhole }) => isWhole ? PIXEL_TYPES[type] : "parts of the pixels"));
    if (!["R", "G", "B"].every(name => channels.has(name)) && !channels.has("Y"))
        throw new Unreadable(`its channels are ${[...channels.keys()].join(", ")}; the page reads R, G, B, or Y`);
    if (kinds.size !== 1 || !(kinds.has("half") || kinds.has("float")))
        throw new Unreadable(`its channels are of ${[...kinds].join(" and ")}; the page reads half, or float`);
}

/** The pixels as RGBA, rows from the top. `allow(width, height)` throws if they are too many. */
export function readExr(bytes, allow) {
    check(new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), allow);
    const { width, height, data } = parseExr(bytes.slice().buffer, FLOAT), numChannels = data.length / (width * height);
    const pixels = new Float32Array(4 * width * height);
    for (let y = 0; y < height; y++)
        for (let x = 0; x < width; x++) {
            const from = ((height - 1 - y) * width + x) * numChannels, to = 4 * (y * width + x); // the package begins at the bottom
            for (let c = 0; c < 3; c++)
                pixels[to + c] = data[from + Math.min(c, numChannels - 1)];
            pixels[to + 3] = 1;
        }
    return { width, height, pixels };
}
