// SPDX-License-Identifier: Apache-2.0
// A document in the address of the page: deflated, as base64 for addresses. No server sees it.

const KEY = "#document=";

async function through(bytes, stream) {
    return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

export async function addressOf(text) {
    const packed = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
    let letters = "";
    for (const byte of packed)
        letters += String.fromCharCode(byte);
    return KEY + btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** null: the address has no document. Throws if it is damaged. */
export async function textOf(address) {
    if (!address.startsWith(KEY))
        return null;
    try {
        const letters = atob(address.slice(KEY.length).replaceAll("-", "+").replaceAll("_", "/"));
        return new TextDecoder().decode(await through(Uint8Array.from(letters, letter => letter.charCodeAt(0)), new DecompressionStream("deflate-raw")));
    } catch {
        throw new Error("The link is damaged: it has no document.");
    }
}
