// SPDX-License-Identifier: Apache-2.0
// The worker that reads files of light and of meshes, so that the page answers while it works.

import { serve } from "../serve.js";
import { readLight } from "./light.js";
import { readMesh } from "./mesh.js";
import { Unreadable } from "./unreadable.js";

/** Other errors, as of a place behind the end of the file, say nothing to a user. */
function read(reader, name, bytes) {
    try {
        return reader(name, bytes);
    } catch (error) {
        throw error instanceof Unreadable ? error : new Unreadable("it is damaged");
    }
}

serve({
    light: ({ name, bytes }) => read(readLight, name, bytes),
    mesh: ({ name, bytes }) => read(readMesh, name, bytes),
});
