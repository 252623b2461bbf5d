// SPDX-License-Identifier: Apache-2.0
// Libraries of the settings, for contexts that have no files of their own.

import type { Context, Library } from "mxgen";

/** The library of some files on top of the one that is built in; null: there are none. `context` finds them by their names. Throws DocumentError. */
export function loadLibraries(context: Context, files: Iterable<string>): Library | null {
    const documents = [...files].filter(name => name.endsWith(".mtlx"));
    return documents.length ? context.loadLibrary(documents) : null;
}

/** The address of `ref` beside the file `from` (of a file itself if that is ""); null: it has none. */
export function resolve(from: string, ref: string): string | null {
    try {
        return from ? new URL(ref.replaceAll("\\", "/"), from).href : ref;
    } catch {
        return null;
    }
}
