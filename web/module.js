// SPDX-License-Identifier: Apache-2.0
// What the page has compressed: the compiler's module from the letters that pack.py makes of it, and the text of the worker.

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

const inflated = bytes => new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip")));

/** The module of WebAssembly, for `instantiate`. */
export const moduleOf = ({ size, letters }) => inflated(unpack(size, letters)).arrayBuffer();

/** A text that gzip and base64 packed (bundle.sh). */
export const inflate = packed => inflated(Uint8Array.from(atob(packed), letter => letter.charCodeAt(0))).text();
