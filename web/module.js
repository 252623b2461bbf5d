// SPDX-License-Identifier: Apache-2.0
// The compiler's module from the letters that pack.py makes of it.

const BARRED = [0, 10, 13, 34, 92]; // letters that stand with the next one in a letter of two bytes

/** The bytes: `size` of them. */
function unpack(size, letters) {
    const bytes = new Uint8Array(size);
    let held = 0, bits = 0, at = 0;
    const take = value => {
        held = held << 7 | value;
        bits += 7;
        if (bits >= 8) {
            bits -= 8;
            bytes[at++] = held >> bits;
            held &= (1 << bits) - 1;
        }
    };
    for (let i = 0; i < letters.length; i++) {
        const letter = letters.charCodeAt(i);
        if (letter < 128) {
            take(letter);
        } else {
            take(BARRED[(letter >> 7) - 1]);
            take(letter & 127);
        }
    }
    return bytes;
}

/** The module of WebAssembly, for `instantiate`. */
export function moduleOf({ size, letters }) {
    return new Response(new Blob([unpack(size, letters)]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}
