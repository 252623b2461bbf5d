// SPDX-License-Identifier: Apache-2.0
// The scene of `mxgen render`: shapes from formulas, a sky with three lights, and a camera around them. render/shapes.c, environment.c,
// scene.c and studio.c are the same in C; the page is compared with their pictures.

const PI = Math.PI, DEGREE = PI / 180;

// ---- Vectors and matrices; a matrix has its columns one after the other ----

export function normalize(v) {
    const length = Math.sqrt(dot(v, v));
    return [v[0] / length, v[1] / length, v[2] / length];
}

export function cross(a, b) {
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

export function multiply(a, b) {
    return IDENTITY.map((_, i) => [0, 1, 2, 3].reduce((sum, k) => sum + a[k * 4 + i % 4] * b[(i & ~3) + k], 0));
}

export function transpose(a) {
    return a.map((_, i) => a[i % 4 * 4 + (i >> 2)]);
}

/** Gauss-Jordan elimination with the largest pivot of each column. */
export function inverse(matrix) {
    const rows = [0, 1, 2, 3].map(r => [0, 1, 2, 3].map(c => matrix[c * 4 + r]).concat([0, 1, 2, 3].map(c => c === r ? 1 : 0)));
    for (let k = 0; k < 4; k++) {
        const pivot = [0, 1, 2, 3].slice(k).reduce((best, r) => Math.abs(rows[r][k]) > Math.abs(rows[best][k]) ? r : best, k);
        [rows[k], rows[pivot]] = [rows[pivot], rows[k]];
        rows[k] = rows[k].map(x => x / rows[k][k]);
        for (let r = 0; r < 4; r++)
            if (r !== k)
                rows[r] = rows[r].map((x, c) => x - rows[r][k] * rows[k][c]);
    }
    return IDENTITY.map((_, i) => rows[i % 4][4 + (i >> 2)]);
}

function lookAt(eye) {
    const z = normalize(eye), x = normalize(cross([0, 1, 0], z)), y = cross(z, x);
    return [x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0, -dot(x, eye), -dot(y, eye), -dot(z, eye), 1];
}

/** For the clip space of OpenGL. */
function perspective(vertical, aspect, near, far) {
    const f = 1 / Math.tan(vertical / 2);
    return [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0];
}

// ---- Shapes: patches over 0 <= u, v <= 1 ----

const sphere = (u, v) => [Math.sin(PI * v) * Math.sin(2 * PI * u), -Math.cos(PI * v), Math.sin(PI * v) * Math.cos(2 * PI * u)];

/** A ball with a groove around it, leaning to the right. */
function ball(u, v) {
    const p = sphere(u, v), latitude = Math.asin(Math.max(-1, Math.min(1, 0.35 * p[0] + 0.88 * p[1] - 0.32 * p[2]))) - 0.15;
    const groove = 1 / (1 + Math.exp(-70 * (latitude + 0.09))) - 1 / (1 + Math.exp(-70 * (latitude - 0.09)));
    const radius = 0.74 * (1 - 0.055 * groove);
    return [radius * p[0], radius * p[1] + 0.22, radius * p[2]];
}

const FOOT = [[0, -0.5], [0, -0.5], [0.24, -0.5], [0.32, -0.53], [0.34, -0.62], [0.4, -0.72], [0.54, -0.76], [0.58, -0.79], [0.57, -0.84],
              [0.5, -0.86], [0, -0.86], [0, -0.86]];

/** The profile (radius, height) is a uniform cubic B-spline. */
function foot(u, v) {
    const spans = FOOT.length - 3, at = (1 - v) * spans, span = Math.min(Math.floor(at), spans - 1), t = at - span;
    const weights = [(1 - t) ** 3, 3 * t ** 3 - 6 * t * t + 4, -3 * t ** 3 + 3 * t * t + 3 * t + 1, t ** 3];
    const [radius, height] = [0, 1].map(i => weights.reduce((sum, weight, k) => sum + weight * FOOT[span + k][i], 0) / 6);
    return [radius * Math.sin(2 * PI * u), height, radius * Math.cos(2 * PI * u)];
}

const HALF_CUBE = 0.6;

function cubeSide(degrees) {
    const c = Math.cos(degrees * DEGREE), s = Math.sin(degrees * DEGREE);
    return (u, v) => {
        const x = HALF_CUBE * (2 * u - 1);
        return [c * x + s * HALF_CUBE, HALF_CUBE * (2 * v - 1), -s * x + c * HALF_CUBE];
    };
}

const cubeEnd = up => (u, v) => [HALF_CUBE * (2 * u - 1), up * HALF_CUBE, up * HALF_CUBE * (1 - 2 * v)];

/** A square laid over a ball: up to an angle at which it leaves the ball it follows that, then it hangs down in folds. */
function cloth(u, v) {
    const half = 1.05, radius = 0.52, leaves = 1.25, x = half * (2 * u - 1), z = half * (1 - 2 * v), r = Math.hypot(x, z), around = Math.atan2(z, x);
    const bend = Math.min(r / radius, leaves), hang = Math.max(r - leaves * radius, 0), fold = Math.sin(8 * around + 0.6) + 0.3 * Math.sin(13 * around - 1.1);
    const away = radius * Math.sin(bend) + hang * (0.2 + 0.28 * fold * hang / (hang + 0.12));
    return [away * Math.cos(around), radius * Math.cos(bend) - 0.93 * hang + 0.22, away * Math.sin(around)];
}

/** Formula, cells across and up. */
const SHAPES = {
    ball: [[ball, 192, 160], [foot, 128, 64]],
    sphere: [[sphere, 128, 64]],
    cloth: [[cloth, 192, 192]],
    cube: [...[0, 90, 180, 270].map(degrees => [cubeSide(degrees), 16, 16]), [cubeEnd(1), 16, 16], [cubeEnd(-1), 16, 16]],
    plane: [[(u, v) => [1.6 * u - 0.8, 1.6 * v - 0.8, 0], 16, 16]],
};
export const SHAPE_NAMES = Object.keys(SHAPES);

export const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const sum = (items, value) => items.reduce((total, item) => total + value(item), 0);

/** The square of the distance of a point from the middle between two vertices. */
const miss = (position, a, b, point) => sum([0, 1, 2], i => ((position[3 * a + i] + position[3 * b + i]) / 2 - point[i]) ** 2);

/** Position, normal, tangent and texture coordinates of all vertices, and indices of triangles. `detail` multiplies the cells. A cell is halved along the
 * diagonal that is nearer to the surface, as in render/shapes.c. */
export function makeMesh(name, detail) {
    const patches = SHAPES[name].map(([point, across, up]) => ({ point, across: across * detail, up: up * detail }));
    const count = sum(patches, ({ across, up }) => (across + 1) * (up + 1));
    const position = new Float32Array(3 * count), normal = new Float32Array(3 * count), tangent = new Float32Array(3 * count);
    const texcoord = new Float32Array(2 * count), indices = new Uint32Array(6 * sum(patches, ({ across, up }) => across * up));
    const inside = x => Math.max(1e-4, Math.min(1 - 1e-4, x)); // away from poles, where a patch has no tangent
    let vertex = 0, index = 0;
    for (const { point, across, up } of patches) {
        const first = vertex;
        for (let j = 0; j <= up; j++)
            for (let i = 0; i <= across; i++, vertex++) {
                const u = i / across, v = j / up, a = inside(u), b = inside(v);
                const x = minus(point(a + 1e-5, b), point(a - 1e-5, b)), y = minus(point(a, b + 1e-5), point(a, b - 1e-5));
                position.set(point(u, v), 3 * vertex);
                normal.set(normalize(cross(x, y)), 3 * vertex);
                tangent.set(normalize(x), 3 * vertex);
                texcoord[2 * vertex] = u;
                texcoord[2 * vertex + 1] = v;
            }
        for (let j = 0; j < up; j++)
            for (let i = 0; i < across; i++, index += 6) {
                const corner = first + j * (across + 1) + i, higher = corner + across + 1;
                const middle = point((i + 0.5) / across, (j + 0.5) / up);
                const falls = miss(position, corner + 1, higher, middle) < 0.999 * miss(position, corner, higher + 1, middle);
                indices.set(falls ? [corner, corner + 1, higher, corner + 1, higher + 1, higher]
                                  : [corner, corner + 1, higher + 1, corner, higher + 1, higher], index);
            }
    }
    return { count, position, normal, tangent, texcoord, indices };
}

/** The triangles of a mesh in the order of their distance, the farthest first. A counting sort, because each frame needs it. */
export function backToFront({ position, indices }, direction) {
    const STEPS = 1 << 14, count = indices.length / 3, steps = new Uint16Array(count), starts = new Uint32Array(STEPS + 1);
    for (let i = 0; i < count; i++) {
        let depth = 0;
        for (let k = 0; k < 3; k++) {
            const at = indices[3 * i + k] * 3;
            depth += position[at] * direction[0] + position[at + 1] * direction[1] + position[at + 2] * direction[2];
        }
        steps[i] = Math.max(0, Math.min(STEPS - 1, (1 - depth / 3) / 2 * STEPS)); // a mesh lies in the unit sphere
        starts[steps[i] + 1]++;
    }
    for (let step = 0; step < STEPS; step++)
        starts[step + 1] += starts[step];
    const sorted = new Uint32Array(indices.length);
    for (let i = 0; i < count; i++)
        sorted.set(indices.subarray(3 * i, 3 * i + 3), 3 * starts[steps[i]]++);
    return sorted;
}

// Attributes that are linear in (s, t): value = a + b s + c t for each component.
const LINEAR = [
    [/^i_texcoord_/, [[1.21, -0.83, 0.31], [-0.37, 0.29, 1.13], [0, 0, 0], [0, 0, 0]]],
    [/^i_color_0$/, [[0.11, 0.67, 0.13], [0.83, -0.21, -0.47], [0.29, -0.17, 0.59], [0.41, 0.37, 0.19]]],
    [/^i_color_/, [[0.29, -0.17, 0.59], [0.11, 0.67, 0.13], [0.83, -0.21, -0.47], [0.41, 0.37, 0.19]]],
    [/^i_geomprop_/, [[0.23, 0.71, -0.11], [-0.43, 0.31, 0.53], [0.79, -0.61, 0.23], [0.51, 0.17, -0.37]]],
];

/** The values of an attribute of the mesh, with their number of components; null: there is none. */
export function attributeOf(mesh, name) {
    const own = { i_position: [mesh.position, 3], i_normal: [mesh.normal, 3], i_tangent: [mesh.tangent, 3], i_texcoord_0: [mesh.texcoord, 2] }[name];
    if (own)
        return { values: own[0], components: own[1] };
    const found = LINEAR.find(([pattern]) => pattern.test(name));
    if (!found)
        return null;
    const values = new Float32Array(mesh.count * 4);
    for (let i = 0; i < mesh.count; i++)
        found[1].forEach(([a, b, c], k) => { values[i * 4 + k] = a + b * mesh.texcoord[i * 2] + c * mesh.texcoord[i * 2 + 1]; });
    return { values, components: 4 };
}

// ---- Light ----

const ABOVE = [0.35, 0.55, 0.95], BELOW = [0.22, 0.17, 0.12], SUN = [1.0, 0.86, 0.62], SUN_DIRECTION = [0.36, 0.80, 0.48];

function radiance(d) {
    const c = dot(d, SUN_DIRECTION), height = 1 / (1 + Math.exp(-6 * d[1]));
    return SUN.map((sun, i) => BELOW[i] + (ABOVE[i] - BELOW[i]) * height + sun * 12 * Math.exp(24 * (c - 1)) + 0.05 * (1 + d[i]));
}

function directionOf(map, x, y) {
    const latitude = PI * (0.5 - (y + 0.5) / map.height), longitude = 2 * PI * ((x + 0.5) / map.width - 0.5);
    return [Math.cos(latitude) * Math.sin(longitude), Math.sin(latitude), -Math.cos(latitude) * Math.cos(longitude)];
}

function makeMap(width, height, value) {
    const map = { width, height, pixels: new Float32Array(width * height * 4) };
    for (let y = 0; y < height; y++)
        for (let x = 0; x < width; x++)
            map.pixels.set([...value(directionOf(map, x, y)), 1], (y * width + x) * 4);
    return map;
}

/** Half the width and height, by box averages. */
export function halve(map) {
    const width = Math.max(map.width >> 1, 1), height = Math.max(map.height >> 1, 1), pixels = new Float32Array(width * height * 4);
    for (let y = 0; y < height; y++)
        for (let x = 0; x < width; x++)
            for (let c = 0; c < 4; c++) {
                const at = (dx, dy) => map.pixels[(Math.min(2 * y + dy, map.height - 1) * map.width + Math.min(2 * x + dx, map.width - 1)) * 4 + c];
                pixels[(y * width + x) * 4 + c] = (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) / 4;
            }
    return { width, height, pixels };
}

/** The cosine-weighted average of a map around each direction. */
function irradianceOf(map) {
    const lights = [];
    for (let y = 0; y < map.height; y++) {
        const solid = Math.sin(PI * (0.5 - y / map.height)) - Math.sin(PI * (0.5 - (y + 1) / map.height));
        for (let x = 0; x < map.width; x++)
            lights.push([...directionOf(map, x, y), ...map.pixels.subarray((y * map.width + x) * 4, (y * map.width + x) * 4 + 3), solid]);
    }
    return makeMap(32, 16, n => {
        let r = 0, g = 0, b = 0, weights = 0;
        for (const light of lights) {
            const cosine = n[0] * light[0] + n[1] * light[1] + n[2] * light[2];
            if (cosine > 0) {
                const weight = cosine * light[6];
                weights += weight;
                r += weight * light[3];
                g += weight * light[4];
                b += weight * light[5];
            }
        }
        return [r / weights, g / weights, b / weights];
    });
}

/** A latitude-longitude map as light: its levels, and the irradiance map. */
export function lightOf(map) {
    const levels = [map];
    while (levels.at(-1).width > 1 || levels.at(-1).height > 1)
        levels.push(halve(levels.at(-1)));
    return { radiance: levels, irradiance: [irradianceOf(levels.find(({ width }) => width <= 64))] };
}

export const makeSky = () => lightOf(makeMap(256, 128, radiance));

const LIGHTS = [
    { type: 1, direction: [-0.6, -0.7, -0.4], position: [0, 0, 0], color: [1.0, 0.95, 0.9], intensity: 2.0, decay_rate: 0 },
    { type: 1, direction: [0.8, -0.2, -0.55], position: [0, 0, 0], color: [0.4, 0.55, 0.9], intensity: 0.9, decay_rate: 0 },
    { type: 2, direction: [-1.4, -1.1, -2.2], position: [1.4, 1.1, 2.2], color: [1.0, 0.8, 0.6], intensity: 9.0, decay_rate: 2.0 },
].map(light => ({ ...light, direction: normalize(light.direction) }));

/** The value of a member of u_lightData[index]; null: lights have none. */
export function lightValue(index, member) {
    const value = LIGHTS[index]?.[member];
    return value === undefined ? null : [value].flat();
}

// ---- Uniforms ----

export const CAMERA = { azimuth: 25, elevation: 16, zoom: 1 };

/** The value of a private uniform for a camera and an aspect; null: the scene has none. */
export function uniformOf(name, camera, aspect, numLevels) {
    const half = Math.tan(15 * DEGREE), distance = 1.04 / Math.sin(15 * DEGREE) / camera.zoom;
    const azimuth = camera.azimuth * DEGREE, elevation = camera.elevation * DEGREE;
    const eye = [distance * Math.sin(azimuth) * Math.cos(elevation), distance * Math.sin(elevation),
                 distance * Math.cos(azimuth) * Math.cos(elevation)];
    const view = lookAt(eye), projection = perspective(2 * Math.atan(aspect < 1 ? half / aspect : half), aspect, distance / 100, distance + 10);
    const plain = {
        u_frame: [1], u_time: [0], u_numActiveLightSources: [LIGHTS.length], u_envRadianceMips: [numLevels], u_envRadianceSamples: [32],
        u_envLightIntensity: [1], u_alphaThreshold: [0.001], u_volumeDepth: [2], u_viewPosition: eye, u_viewDirection: normalize(eye.map(x => -x)),
        u_envMatrix: IDENTITY,
    };
    if (Object.hasOwn(plain, name))
        return plain[name];
    if (name.startsWith("u_geomprop_"))
        return [1, 1, 1, 1];
    const [, base, inverted, transposed] = /^u_(\w+?)(Inverse)?(Transpose)?Matrix$/.exec(name) ?? [];
    let matrix = { world: IDENTITY, view, projection, worldView: view, viewProjection: multiply(projection, view),
                   worldViewProjection: multiply(projection, view) }[base];
    if (!matrix)
        return null;
    matrix = inverted ? inverse(matrix) : matrix;
    return transposed ? transpose(matrix) : matrix;
}
