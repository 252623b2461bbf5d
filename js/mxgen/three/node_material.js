// SPDX-License-Identifier: Apache-2.0
// A material of a document, for three's WebGPURenderer.

import { Matrix3, Matrix4, MeshStandardNodeMaterial, Vector2, Vector3, Vector4 } from "three/webgpu";
import { diffuseColor, max, morphReference, positionLocal, skinning, subBuild, texture, uniform, vec2, vec4 } from "three/tsl";

import { following } from "./following.js";
import { moveInstances, TYPES } from "./geometry_nodes.js";
import { SurfaceNode } from "./surface_node.js";

const VALUES = { vec2: Vector2, vec3: Vector3, vec4: Vector4, mat3: Matrix3, mat4: Matrix4 };
const WHITE = vec4(1);

/** Its surface is a node, which comes from the document: the colour, roughness and the other inputs of a standard material have no effect. */
export class MaterialXNodeMaterial extends following(MeshStandardNodeMaterial, "wgsl") {
    static get type() {
        return "MaterialXNodeMaterial";
    }

    _uniform({ name, block, type }, value) {
        if (block === "textures")
            return texture(value, vec2(0));
        const Value = VALUES[TYPES[type]];
        return uniform(Value ? new Value().fromArray(value) : Number(value), TYPES[type]).setName(name);
    }

    _setShader(shader) {
        this.colorNode = WHITE; // times the colours of vertices, instances and batches, which the surface reads
        const uniforms = shader.variables.filter(({ name }) => name in this.uniforms).map(({ name }) => [name, this.uniforms[name]]);
        this.surfaceNode = new SurfaceNode(shader, Object.fromEntries(uniforms), target => this._sourceOf(target));
    }

    /** As three does, but the surface reads the positions before instances move them. */
    setupPosition(builder) {
        const { object, geometry } = builder, { position, normal, color } = geometry.morphAttributes;
        if (position || normal || color)
            morphReference(object);
        if (object.isSkinnedMesh)
            skinning(object);
        moveInstances(builder, this.surfaceNode.readsWorld);
        if (this.positionNode)
            positionLocal.assign(subBuild(this.positionNode, "POSITION", "vec3"));
        return positionLocal;
    }

    /** The colour of a surface is premultiplied; three makes it so once more, after the fog. */
    setupLighting() {
        const shaded = this.surfaceNode.toVar(), covered = max(shaded.a, 1e-6).toVar();
        diffuseColor.a.assign(covered);
        return shaded.rgb.div(covered);
    }

    /** WebGLRenderer calls it. */
    onBeforeCompile() {
        throw new Error("MaterialXNodeMaterial is for WebGPURenderer; for WebGLRenderer there is MaterialXMaterial of mxgen/three");
    }

    copy(source) {
        return super.copy(source, { surfaceNode: this.surfaceNode });
    }
}
