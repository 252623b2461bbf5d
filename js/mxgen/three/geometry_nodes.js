// SPDX-License-Identifier: Apache-2.0
// The data that a surface reads of its geometry, as nodes.

import { If, Loop, abs, attribute, batch, convert, cross, dFdx, dFdy, dot, float, instancedMesh, int, mat4, modelWorldMatrix, normalize, normalLocal,
         normalWorldGeometry, positionLocal, positionWorld, select, sign, tangentGeometry, tangentLocal, varyingProperty, vec2, vec3, vec4 } from "three/tsl";

// In object space, after bones and morphs, and the matrix of the instance. moveInstances writes them.
export const positionObject = varyingProperty("vec3", "mxgPositionObject");
export const normalObject = varyingProperty("vec3", "mxgNormalObject");
const columns = [0, 1, 2, 3].map(i => varyingProperty("vec3", `mxgInstance${i}`));

const hasInstances = object => object.isInstancedMesh || object.isBatchedMesh;

/** From object space to the world; three's modelWorldMatrix knows no instances. */
export function toWorldOf({ object }) {
    const [origin, x, y, z] = columns;
    return hasInstances(object) ? modelWorldMatrix.mul(mat4(vec4(x, 0), vec4(y, 0), vec4(z, 0), vec4(origin, 1))) : modelWorldMatrix;
}

/** Moves the vertices of instances, and writes what the surface reads in object space. */
export function moveInstances(builder, needsMatrix) {
    const { object } = builder, move = () => (object.isBatchedMesh ? batch : instancedMesh)(object);
    positionObject.assign(positionLocal);
    normalObject.assign(normalLocal);
    if (hasInstances(object) && needsMatrix) { // three has no name for the matrix: its columns are where the origin and the axes go, before the vertex goes
        const moved = [positionLocal, normalLocal, ...builder.hasGeometryAttribute("tangent") ? [tangentLocal] : []], before = moved.map(node => node.toVar());
        Loop(5, ({ i }) => {
            moved.forEach((node, index) => node.assign(before[index]));
            If(i.lessThan(4), () => void positionLocal.assign(vec3(i.equal(1), i.equal(2), i.equal(3))));
            move();
            columns.forEach((column, index) => If(i.equal(index), () => void column.assign(positionLocal)));
        });
        columns.slice(1).forEach(column => column.subAssign(columns[0]));
    } else if (hasInstances(object)) {
        move();
    }
}

/** Types of WGSL, as three names them. */
export const TYPES = { f32: "float", i32: "int", u32: "uint", bool: "bool", vec2f: "vec2", vec3f: "vec3", vec4f: "vec4", mat3x3f: "mat3", mat4x4f: "mat4" };

const CONSTANTS = { float, int, vec2, vec3, vec4 };

/** An attribute of the geometry as a type, or a constant. */
export function attributeOf(builder, name, type, values, isFlat = false) {
    if (!builder.hasGeometryAttribute(name))
        return CONSTANTS[type](...values);
    const node = attribute(name);
    return convert(isFlat ? node.toVarying().setInterpolation("flat") : node, type);
}

/**
 * The tangent and the bitangent in the world. Without tangents of the geometry: the derivatives of the position by u and v, from those by x and
 * y of the screen (Cramer's rule).
 */
export function frameOf(builder) {
    const N = normalWorldGeometry;
    if (builder.hasGeometryAttribute("tangent")) {
        const T = normalize(modelWorldMatrix.mul(vec4(tangentLocal, 0)).xyz.toVarying()).toVar();
        return [T, cross(N, T).mul(select(tangentGeometry.w.lessThan(0), -1, 1))];
    }
    const coordinates = attributeOf(builder, "uv", "vec2", [0, 0]).toVar(), x = dFdx(coordinates).toVar(), y = dFdy(coordinates).toVar();
    const Px = dFdx(positionWorld).toVar(), Py = dFdy(positionWorld).toVar();
    const handed = sign(x.x.mul(y.y).sub(x.y.mul(y.x))).toVar();
    const along = Px.mul(y.y).sub(Py.mul(x.y)).mul(handed), B = Py.mul(x.x).sub(Px.mul(y.x)).mul(handed);
    const flat = along.sub(N.mul(dot(N, along))).toVar();
    const T = normalize(select(dot(flat, flat).equal(0), cross(select(abs(N.y).lessThan(0.9), vec3(0, 1, 0), vec3(1, 0, 0)), N), flat)).toVar();
    const across = cross(N, T).toVar();
    return [T, select(dot(across, B).lessThan(0), across.negate(), across)];
}
