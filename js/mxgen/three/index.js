// SPDX-License-Identifier: Apache-2.0
// The entry mxgen/three: materials for three.js (docs/three.md).

export { MaterialXLoader } from "./loader.js";
export { MaterialXMaterial } from "./material.js";
export { MaterialXTextures } from "./textures.js";
