// SPDX-License-Identifier: Apache-2.0
// A picture as a file of the user.

async function toPng(picture) {
    const canvas = new OffscreenCanvas(picture.width, picture.height);
    canvas.getContext("2d").putImageData(picture, 0, 0);
    return canvas.convertToBlob({ type: "image/png" });
}

/** Gives the user a picture of ImageData as a file. */
export async function savePicture(picture, name) {
    const address = URL.createObjectURL(await toPng(picture)), link = document.createElement("a");
    Object.assign(link, { href: address, download: `${name}.png` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(address), 60_000); // the browser reads it after the click
}
