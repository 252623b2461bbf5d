// SPDX-License-Identifier: Apache-2.0
// Meshes from files, with all that a shader reads. render/mesh.c is the same in C.

import { cross, dot, minus, normalize } from "../scene.js";
import { readGlb } from "./glb.js";
import { readObj } from "./obj.js";
import { Unreadable } from "./unreadable.js";

const MAX_TRIANGLES = 500_000;
const CREASE = Math.cos(60 * Math.PI / 180); // sharper edges stay edges where normals are made
const FINE_TRIANGLES = 1 << 17; // of a mesh that is displaced

function allow(triangles) {
    if (triangles > MAX_TRIANGLES)
        throw new Unreadable(`it has more than ${MAX_TRIANGLES} triangles`);
}

const at = (values, index) => [values[3 * index], values[3 * index + 1], values[3 * index + 2]];
const unit = (v, otherwise) => dot(v, v) > 1e-40 ? normalize(v) : otherwise;
const add = (sums, index, v) => v.forEach((x, c) => { sums[3 * index + c] += x; });

/** Moves the parts of a mesh to the middle, and scales them into the unit sphere. */
function fit(parts) {
    const low = [Infinity, Infinity, Infinity], high = low.map(x => -x);
    for (const { position } of parts)
        position.forEach((x, i) => {
            low[i % 3] = Math.min(low[i % 3], x);
            high[i % 3] = Math.max(high[i % 3], x);
        });
    const middle = low.map((x, c) => (x + high[c]) / 2);
    let square = 0;
    for (const { position } of parts)
        for (let i = 0; i < position.length; i += 3)
            square = Math.max(square, middle.reduce((sum, x, c) => sum + (position[i + c] - x) ** 2, 0));
    if (!(square > 0 && Number.isFinite(square)))
        throw new Unreadable("its triangles have no area, or numbers that are infinite");
    for (const { position } of parts)
        position.forEach((x, i) => { position[i] = (x - middle[i % 3]) / Math.sqrt(square); });
}

/** Gives each corner of a triangle a vertex of its own. */
function split({ position, normal, texcoord, indices }) {
    const pick = (values, size) => {
        const made = new Float32Array(size * indices.length);
        for (let i = 0, to = 0; i < indices.length; i++)
            for (let c = 0; c < size; c++)
                made[to++] = values[size * indices[i] + c];
        return made;
    };
    return { position: pick(position, 3), normal: normal && pick(normal, 3), texcoord: texcoord && pick(texcoord, 2), indices: Uint32Array.from(indices, (_, i) => i) };
}

/** Its length is twice the area. */
function faceNormal({ position, indices }, first) {
    const [a, b, c] = [0, 1, 2].map(k => at(position, indices[first + k]));
    return cross(minus(b, a), minus(c, a));
}

/** A number for each vertex, the same for those that are equal in lists of numbers: [values, how many a vertex has]. */
function placesOf(count, lists) {
    const size = lists.reduce((sum, [, length]) => sum + length, 0), all = new Float32Array(size * count), bits = new Uint32Array(all.buffer);
    const numbers = new Uint32Array(count), firsts = new Uint32Array(count), slots = new Int32Array(1 << Math.ceil(Math.log2(2 * count + 1))).fill(-1);
    let to = 0, numPlaces = 0;
    for (let i = 0; i < count; i++)
        for (const [values, length] of lists)
            for (let c = 0; c < length; c++)
                all[to++] = values[length * i + c] + 0; // -0 is 0
    const isEqual = (a, b) => {
        let c = 0;
        while (c < size && bits[size * a + c] === bits[size * b + c])
            c++;
        return c === size;
    };
    for (let i = 0; i < count; i++) {
        let hash = 0;
        for (let c = 0; c < size; c++)
            hash = Math.imul(hash ^ bits[size * i + c], 0x9e3779b1) ^ hash >>> 15;
        let slot = (hash ^ hash >>> 16) & slots.length - 1;
        while (slots[slot] >= 0 && !isEqual(firsts[slots[slot]], i))
            slot = slot + 1 & slots.length - 1;
        if (slots[slot] < 0) {
            firsts[numPlaces] = i;
            slots[slot] = numPlaces++;
        }
        numbers[i] = slots[slot];
    }
    return { numbers, count: numPlaces };
}

/** Positions without what rounding makes of them: in a mesh of size 1 they are the same. */
const rounded = position => Float32Array.from(position, x => Math.round(1e5 * x));

/** Lists of what lies at each place: those of place p are `items` from starts[p] to starts[p + 1]. */
function listsOf({ numbers, count }) {
    const starts = new Uint32Array(count + 1), items = new Uint32Array(numbers.length);
    for (const place of numbers)
        starts[place + 1]++;
    for (let place = 0; place < count; place++)
        starts[place + 1] += starts[place];
    const next = starts.slice();
    numbers.forEach((place, i) => { items[next[place]++] = i; });
    return { starts, items };
}

/** The normal of each corner: the mean of the triangles around it, up to an edge. */
function makeNormals(mesh) {
    const made = split(mesh), numCorners = made.indices.length, places = placesOf(numCorners, [[rounded(made.position), 3]]), { starts, items } = listsOf(places);
    const faces = new Float64Array(numCorners), lengths = new Float64Array(numCorners / 3), sum = [0, 0, 0];
    for (let face = 0; face < lengths.length; face++) {
        const v = faceNormal(made, 3 * face);
        faces.set(v, 3 * face);
        lengths[face] = Math.hypot(...v);
    }
    made.normal = new Float32Array(made.position.length);
    for (let corner = 0; corner < numCorners; corner++) {
        const own = Math.floor(corner / 3), place = places.numbers[corner];
        sum.fill(0);
        for (let k = starts[place]; k < starts[place + 1]; k++) {
            const face = Math.floor(items[k] / 3), cosine = faces[3 * own] * faces[3 * face] + faces[3 * own + 1] * faces[3 * face + 1] + faces[3 * own + 2] * faces[3 * face + 2];
            for (let c = 0; cosine >= CREASE * lengths[own] * lengths[face] && c < 3; c++)
                sum[c] += faces[3 * face + c];
        }
        made.normal.set(unit(sum, [0, 1, 0]), 3 * corner);
    }
    return made;
}

/** Each triangle has its own normal. */
function makeFlat(mesh) {
    const made = split(mesh);
    made.normal = new Float32Array(made.position.length);
    for (let corner = 0; corner < made.indices.length; corner++)
        made.normal.set(faceNormal(made, corner - corner % 3), 3 * corner);
    return made;
}

/** Projects each triangle along the axis that it looks to most. */
function makeTexcoords(mesh) {
    const made = split(mesh);
    made.texcoord = new Float32Array(2 * made.indices.length);
    for (let first = 0; first < made.indices.length; first += 3) {
        const n = faceNormal(made, first), [x, y, z] = n.map(Math.abs), axis = x > y && x > z ? 0 : y > z ? 1 : 2;
        const across = axis === 0 ? 2 : 0, up = axis === 1 ? 2 : 1, side = n[axis] < 0 === (axis === 2) ? -1 : 1; // pictures are not mirrored
        for (let corner = first; corner < first + 3; corner++) {
            const t = made.position[3 * corner + up];
            made.texcoord.set([0.5 - 0.5 * side * made.position[3 * corner + across], 0.5 + 0.5 * (axis === 1 ? -t : t)], 2 * corner);
        }
    }
    return made;
}

/** Lengyel 2001, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh". */
function makeTangents(mesh) {
    const { position, normal, texcoord, indices } = mesh, { numbers, count } = placesOf(position.length / 3, [[position, 3], [normal, 3], [texcoord, 2]]), sums = new Float64Array(3 * count), tangent = new Float32Array(position.length);
    for (let first = 0; first < indices.length; first += 3) {
        const [i, j, k] = [indices[first], indices[first + 1], indices[first + 2]];
        const s1 = texcoord[2 * j] - texcoord[2 * i], t1 = texcoord[2 * j + 1] - texcoord[2 * i + 1], s2 = texcoord[2 * k] - texcoord[2 * i], t2 = texcoord[2 * k + 1] - texcoord[2 * i + 1];
        const sign = s1 * t2 - s2 * t1 < 0 ? -1 : 1;
        for (let c = 0; c < 3; c++) {
            const along = sign * ((position[3 * j + c] - position[3 * i + c]) * t2 - (position[3 * k + c] - position[3 * i + c]) * t1);
            for (let corner = first; corner < first + 3; corner++)
                sums[3 * numbers[indices[corner]] + c] += along;
        }
    }
    for (let i = 0; i < position.length / 3; i++) {
        const n = at(normal, i), sum = at(sums, numbers[i]), along = dot(sum, n), any = normalize(cross(Math.abs(n[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0], n));
        tangent.set(unit(sum.map((x, c) => x - along * n[c]), any), 3 * i);
    }
    return tangent;
}

/** A part with all that it lacks. */
function complete(part) {
    let mesh = part.normal ? part : part.isFlat ? makeFlat(part) : makeNormals(part);
    for (let i = 0; i < mesh.normal.length / 3; i++)
        mesh.normal.set(unit(at(mesh.normal, i), [0, 1, 0]), 3 * i);
    mesh = mesh.texcoord ? mesh : makeTexcoords(mesh);
    return { ...mesh, tangent: makeTangents(mesh) };
}

/** One mesh of all parts. */
function join(parts) {
    const count = parts.reduce((sum, { position }) => sum + position.length / 3, 0);
    const mesh = { position: new Float32Array(3 * count), normal: new Float32Array(3 * count), tangent: new Float32Array(3 * count), texcoord: new Float32Array(2 * count), count };
    const indices = new Uint32Array(parts.reduce((sum, part) => sum + part.indices.length, 0));
    let vertex = 0, corner = 0;
    for (const part of parts) {
        for (const [name, size] of [["position", 3], ["normal", 3], ["tangent", 3], ["texcoord", 2]])
            mesh[name].set(part[name], size * vertex);
        for (const index of part.indices)
            indices[corner++] = vertex + index;
        vertex += part.position.length / 3;
    }
    return { ...mesh, indices };
}

/** The mesh of a file, as makeMesh of scene.js makes them, and notes for the user. Each part of it has by itself what it lacks. */
export function readMesh(name, bytes) {
    const parts = (/\.glb$/i.test(name) ? readGlb : readObj)(bytes, allow).filter(part => part.indices.length);
    if (!parts.length)
        throw new Unreadable("it has no triangles");
    fit(parts);
    const numBare = parts.filter(part => !part.texcoord).length;
    const notes = numBare ? [`has ${numBare < parts.length ? "parts with " : ""}no texture coordinates; they were made`] : [];
    return { mesh: join(parts.map(complete)), notes };
}

// ---- Displacement ----

/** Gives all vertices at a position one normal, and a tangent, so that what is displaced stays closed. */
function weld(mesh) {
    const { numbers, count } = placesOf(mesh.count, [[rounded(mesh.position), 3]]), sums = new Float64Array(3 * count), firsts = new Map();
    numbers.forEach((place, i) => add(sums, place, at(mesh.normal, i)));
    const normal = mesh.normal.slice(), tangent = mesh.tangent.slice();
    numbers.forEach((place, i) => {
        firsts.has(place) || firsts.set(place, i);
        normal.set(unit(at(sums, place), at(mesh.normal, i)), 3 * i);
        tangent.set(at(mesh.tangent, firsts.get(place)), 3 * i);
    });
    return { ...mesh, normal, tangent };
}

/** Four triangles for each; both triangles of an edge have the same point in its middle. */
function quarter({ position, normal, tangent, texcoord, indices }) {
    const pick = (values, size) => {
        const made = new Float32Array(2 * size * indices.length), value = (corner, c) => values[size * indices[corner] + c];
        for (let first = 0, to = 0; first < indices.length; first += 3)
            for (let k = 0; k < 6; k++)
                for (let c = 0; c < size; c++)
                    made[to++] = k < 3 ? value(first + k, c) : (value(first + k - 3, c) + value(first + (k - 2) % 3, c)) / 2;
        return made;
    };
    const units = values => {
        for (let i = 0; i < values.length / 3; i++)
            values.set(unit(at(values, i), [0, 1, 0]), 3 * i);
        return values;
    };
    const pattern = [0, 3, 5, 3, 1, 4, 5, 4, 2, 3, 4, 5], made = Uint32Array.from({ length: 4 * indices.length }, (_, i) => 6 * Math.floor(i / 12) + pattern[i % 12]);
    return { position: pick(position, 3), normal: units(pick(normal, 3)), tangent: units(pick(tangent, 3)), texcoord: pick(texcoord, 2), indices: made };
}

/** A mesh with triangles small enough to move. */
export function refine(mesh) {
    let made = weld(mesh);
    while (made.indices.length / 3 < FINE_TRIANGLES)
        made = quarter(made);
    return { ...made, count: made.position.length / 3 };
}
