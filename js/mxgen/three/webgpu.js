// SPDX-License-Identifier: Apache-2.0
// The entry mxgen/three/webgpu: materials for the WebGPURenderer of three.js (docs/three.md).

import { loaderOf } from "./loader.js";
import { MaterialXNodeMaterial } from "./node_material.js";

export const MaterialXLoader = loaderOf(MaterialXNodeMaterial);
export { MaterialXNodeMaterial };
export { MaterialXTextures } from "./textures.js";
