// SPDX-License-Identifier: Apache-2.0
// The entry mxgen/three/webgpu: materials for the WebGPURenderer of three.js. docs/three.md explains it.

import type { MeshStandardNodeMaterial, Node } from "three/webgpu";
import type { Document } from "mxgen";
import { MaterialXLoader as Loader } from "./index.js";
import type { MaterialXMembers, MaterialXParameters, MaterialXResult as Result } from "./index.js";

export { MaterialXTextures } from "./index.js";
export type { MaterialXParameters } from "./index.js";
export type MaterialXResult = Result<MaterialXNodeMaterial>;

export interface MaterialXNodeMaterial extends MaterialXMembers {}

/** A material of a document for WebGPURenderer. The inputs of a standard material (`color`, `roughness`, `map`…) and their nodes have no effect. */
export class MaterialXNodeMaterial extends MeshStandardNodeMaterial {
    /** Throws DocumentError. */
    constructor(document: Document, parameters?: MaterialXParameters);
    /** The premultiplied colour and alpha of the surface. */
    surfaceNode: Node<"vec4">;
}

/** As MaterialXLoader of mxgen/three. */
export class MaterialXLoader extends Loader<MaterialXNodeMaterial> {}
