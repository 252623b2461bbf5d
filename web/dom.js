// SPDX-License-Identifier: Apache-2.0
// Elements of the page.

export function element(name, properties = {}, ...children) {
    const made = Object.assign(document.createElement(name), properties);
    made.append(...children);
    return made;
}
