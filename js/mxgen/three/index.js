// SPDX-License-Identifier: Apache-2.0
// The entry mxgen/three: materials for the WebGLRenderer of three.js (docs/three.md).

import { loaderOf } from "./loader.js";
import { MaterialXMaterial } from "./material.js";

export const MaterialXLoader = loaderOf(MaterialXMaterial);
export { MaterialXMaterial };
export { MaterialXTextures } from "./textures.js";
