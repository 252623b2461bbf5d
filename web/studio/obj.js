// SPDX-License-Identifier: Apache-2.0
// Meshes of Wavefront (.obj): positions, texture coordinates, normals and faces; faces become fans.

import { Unreadable } from "./unreadable.js";

function* linesOf(text) {
    for (let at = 0, end; at < text.length; at = end + 1) {
        end = text.indexOf("\n", at);
        end = end < 0 ? text.length : end;
        yield text.slice(at, end);
    }
}

const KINDS = ["v", "vt", "vn"], SIZES = [3, 2, 3];

/** A corner as places in the lists of positions, texture coordinates and normals, from 0; -1: the corner has none. */
function cornerOf(word, lists, line) {
    const corner = [-1, -1, -1];
    word.split("/").forEach((digits, i) => {
        const count = (lists[i]?.length ?? 0) / SIZES[i], number = Number(digits), place = number > 0 ? number - 1 : number + count;
        if (digits !== "" && !(Number.isInteger(number) && number !== 0 && place >= 0 && place < count) || digits === "" && i === 0)
            throw new Unreadable(`line ${line} has a corner '${word}' that is not there`);
        corner[i] = digits === "" ? -1 : place;
    });
    return corner;
}

function addNumbers(list, words, size, line) {
    for (let i = 0; i < size; i++) {
        const number = words[i] === undefined && size === 2 ? 0 : Number(words[i]);
        if (!Number.isFinite(number))
            throw new Unreadable(`line ${line} has no ${size} numbers`);
        list.push(number);
    }
}

/** The lists of numbers, and the faces in parts, of which one has texture coordinates, or normals, at all corners, and another has not. */
function readLines(text, allow) {
    const lists = [[], [], []], known = new Map(), parts = new Map();
    let line = 0, triangles = 0;
    for (const content of linesOf(text)) {
        line++;
        const [kind, ...words] = content.trim().split(/\s+/), list = KINDS.indexOf(kind);
        if (list >= 0)
            addNumbers(lists[list], words, SIZES[list], line);
        if (kind !== "f")
            continue;
        const keys = words.map(word => {
            const key = word.includes("-") ? cornerOf(word, lists, line).join() : word; // what counts from the end means another corner each time
            if (!known.has(key))
                known.set(key, cornerOf(word, lists, line));
            return key;
        });
        const kinds = [1, 2].map(list => keys.every(key => known.get(key)[list] >= 0)).join();
        if (!parts.has(kinds))
            parts.set(kinds, { numbers: new Map(), corners: [], indices: [] });
        const { numbers, corners, indices } = parts.get(kinds);
        const face = keys.map(key => {
            if (!numbers.has(key))
                numbers.set(key, corners.push(known.get(key)) - 1);
            return numbers.get(key);
        });
        for (let k = 2; k < face.length; k++)
            indices.push(face[0], face[k - 1], face[k]);
        triangles += Math.max(face.length - 2, 0);
        allow(triangles);
    }
    return { lists, parts: [...parts.values()] };
}

/** Parts with position, normal and texcoord (null: a corner lacks it), and indices of triangles. `allow(count)` throws if they are too many. */
export function readObj(bytes, allow) {
    const { lists, parts } = readLines(new TextDecoder().decode(bytes), allow);
    return parts.map(part => partOf(lists, part));
}

function partOf(lists, { corners, indices }) {
    const values = list => {
        const size = SIZES[list], made = new Float32Array(size * corners.length);
        for (let i = 0; i < corners.length; i++)
            for (let c = 0; c < size; c++)
                made[size * i + c] = lists[list][size * corners[i][list] + c];
        return corners.every(corner => corner[list] >= 0) ? made : null;
    };
    return { position: values(0), texcoord: values(1), normal: values(2), indices: Uint32Array.from(indices) };
}
