// SPDX-License-Identifier: Apache-2.0
// Meshes of binary glTF 2.0 (.glb): the triangles of its scene, without skins and morphs.

import { multiply } from "../scene.js";
import { Unreadable } from "./unreadable.js";

const JSON_CHUNK = 0x4e4f534a, BINARY_CHUNK = 0x004e4942;
const MAX_DEPTH = 100;
/** By the numbers of glTF: the bytes of a number, how DataView reads it, and what an integer that counts as a fraction is divided by. */
const NUMBERS = { 5120: [1, "getInt8", 127], 5121: [1, "getUint8", 255], 5122: [2, "getInt16", 32767], 5123: [2, "getUint16", 65535], 5125: [4, "getUint32", 1], 5126: [4, "getFloat32", 1] };
const COMPONENTS = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };
const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

function chunksOf(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), chunks = new Map();
    if (bytes.length < 12 || view.getUint32(0, true) !== 0x46546c67 || view.getUint32(4, true) !== 2)
        throw new Unreadable("it is no binary glTF 2.0");
    const whole = view.getUint32(8, true);
    if (whole !== bytes.length)
        throw new Unreadable(`it has ${bytes.length} bytes, and its header says ${whole}`);
    for (let at = 12; at < bytes.length;) {
        const length = at + 8 <= bytes.length ? view.getUint32(at, true) : Infinity;
        if (at + 8 + length > bytes.length)
            throw new Unreadable("its last chunk is longer than the file");
        chunks.set(view.getUint32(at + 4, true), bytes.subarray(at + 8, at + 8 + length));
        at += 8 + length;
    }
    return chunks;
}

/** The numbers of an accessor. */
function numbersOf({ gltf, binary }, index) {
    const accessor = gltf.accessors[index], { componentType, count, type, normalized = false, sparse } = accessor, part = gltf.bufferViews?.[accessor.bufferView];
    if (sparse || !part || part.extensions?.EXT_meshopt_compression)
        throw new Unreadable("its numbers are sparse or compressed, which the page does not read");
    if (part.buffer !== 0 || gltf.buffers[0].uri !== undefined || !binary)
        throw new Unreadable("its numbers are in another file");
    const [size, get, most] = NUMBERS[componentType], components = COMPONENTS[type], stride = part.byteStride ?? size * components;
    const start = (part.byteOffset ?? 0) + (accessor.byteOffset ?? 0), view = new DataView(binary.buffer, binary.byteOffset, binary.byteLength);
    if (start + stride * (count - 1) + size * components > binary.byteLength)
        throw new Unreadable("its numbers lie behind its end");
    const numbers = new Float64Array(count * components);
    for (let i = 0; i < numbers.length; i++) {
        const number = view[get](start + stride * Math.floor(i / components) + size * (i % components), true);
        numbers[i] = normalized ? Math.max(number / most, -1) : number;
    }
    return numbers;
}

/** The corners of triangles of a primitive of mode 4 (a list), 5 (a strip) or 6 (a fan); others have none. */
function trianglesOf(mode, corners) {
    if (mode === 4)
        return corners.slice(0, corners.length - corners.length % 3);
    const triangles = [];
    for (let i = 2; (mode === 5 || mode === 6) && i < corners.length; i++)
        triangles.push(...(mode === 6 ? [corners[0], corners[i - 1], corners[i]] : i % 2 ? [corners[i - 1], corners[i - 2], corners[i]] : [corners[i - 2], corners[i - 1], corners[i]]));
    return triangles;
}

function matrixOf({ matrix, translation: [x, y, z] = [0, 0, 0], rotation: [i, j, k, w] = [0, 0, 0, 1], scale: [a, b, c] = [1, 1, 1] }) {
    return matrix ?? [a * (1 - 2 * (j * j + k * k)), 2 * a * (i * j + k * w), 2 * a * (i * k - j * w), 0, 2 * b * (i * j - k * w), b * (1 - 2 * (i * i + k * k)), 2 * b * (j * k + i * w), 0,
        2 * c * (i * k + j * w), 2 * c * (j * k - i * w), c * (1 - 2 * (i * i + j * j)), 0, x, y, z, 1];
}

/** All nodes of the scene that have meshes, with their matrices. */
function placedMeshes(gltf) {
    const placed = [], visit = (index, above, depth) => {
        const node = gltf.nodes[index], matrix = multiply(above, matrixOf(node));
        if (depth > MAX_DEPTH)
            throw new Unreadable(`its nodes are nested more than ${MAX_DEPTH} deep`);
        if (node.mesh !== undefined)
            placed.push([gltf.meshes[node.mesh], matrix]);
        for (const child of node.children ?? [])
            visit(child, matrix, depth + 1);
    };
    if (!gltf.scenes)
        return (gltf.meshes ?? []).map(mesh => [mesh, IDENTITY]);
    for (const root of gltf.scenes[gltf.scene ?? 0].nodes ?? [])
        visit(root, IDENTITY, 0);
    return placed;
}

const cross = (m, a, b) => [m[a + 1] * m[b + 2] - m[a + 2] * m[b + 1], m[a + 2] * m[b] - m[a] * m[b + 2], m[a] * m[b + 1] - m[a + 1] * m[b]];

/** Positions and directions of a primitive by a matrix; the normals by its cofactors, so they stay upright. */
function place(m, { position, normal }) {
    const columns = [cross(m, 4, 8), cross(m, 8, 0), cross(m, 0, 4)], isMirrored = m[0] * columns[0][0] + m[1] * columns[0][1] + m[2] * columns[0][2] < 0;
    for (let i = 0; i < position.length; i += 3) {
        const [x, y, z] = position.subarray(i, i + 3), [u, v, w] = normal ? normal.subarray(i, i + 3) : [0, 0, 0];
        for (let r = 0; r < 3; r++) {
            position[i + r] = m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r];
            if (normal)
                normal[i + r] = (columns[0][r] * u + columns[1][r] * v + columns[2][r] * w) * (isMirrored ? -1 : 1);
        }
    }
    return isMirrored;
}

function primitiveOf(file, { attributes, indices, mode = 4, extensions }, matrix, allow) {
    if (extensions?.KHR_draco_mesh_compression)
        throw new Unreadable("it is compressed by Draco, which the page does not read");
    if (attributes.POSITION === undefined || mode < 4)
        return null;
    const read = name => attributes[name] === undefined ? null : numbersOf(file, attributes[name]);
    const made = { position: read("POSITION"), normal: read("NORMAL"), texcoord: read("TEXCOORD_0") }, count = made.position.length / 3;
    for (let i = 1; i < (made.texcoord?.length ?? 0); i += 2)
        made.texcoord[i] = 1 - made.texcoord[i]; // the first row of a texture is its top
    made.indices = trianglesOf(mode, indices === undefined ? Array.from({ length: count }, (_, i) => i) : [...numbersOf(file, indices)]);
    if (made.indices.some(index => !(index < count)))
        throw new Unreadable("it has triangles with corners that are not there");
    allow(made.indices.length / 3);
    if (place(matrix, made))
        made.indices.reverse();
    return made;
}

/** glTF 2.0, 3.12: a file that requires what is not read is not to be loaded. Extensions of materials and textures change no triangles. */
function checkRequired({ extensionsRequired = [] }) {
    const unknown = extensionsRequired.find(name => !/^(KHR_mesh_quantization|KHR_lights_punctual|KHR_materials_.*|KHR_texture_.*|EXT_texture_.*)$/.test(name));
    if (unknown !== undefined)
        throw new Unreadable(`it requires the extension '${unknown}', which the page does not read`);
}

/** Parts with position, normal and texcoord (null: it lacks them; without normals it is flat), and indices of triangles. `allow(count)` throws if they are too many. */
export function readGlb(bytes, allow) {
    const chunks = chunksOf(bytes), file = { gltf: JSON.parse(new TextDecoder().decode(chunks.get(JSON_CHUNK))), binary: chunks.get(BINARY_CHUNK) };
    const parts = [];
    let triangles = 0;
    checkRequired(file.gltf);
    for (const [mesh, matrix] of placedMeshes(file.gltf))
        for (const primitive of mesh.primitives) {
            const part = primitiveOf(file, primitive, matrix, count => allow(triangles + count));
            if (!part)
                continue;
            triangles += part.indices.length / 3;
            parts.push({ ...part, isFlat: !part.normal });
        }
    return parts;
}
