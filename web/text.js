// SPDX-License-Identifier: Apache-2.0
// The document in a <textarea>, until the editor is there, which has the same members (editor/editor.js).

export class PlainText {
    constructor(area) {
        this.element = area;
    }

    get value() {
        return this.element.value;
    }

    set value(text) {
        this.element.value = text;
    }

    change({ start, end, text }) {
        this.element.setRangeText(text, start, end, "preserve");
    }

    select(start, end) {
        this.element.focus();
        this.element.setSelectionRange(start, end);
    }

    /** Puts the editor in the place of the textarea. `services` are what MaterialText.begin takes besides the text. */
    replaceBy(Editor, services) {
        const { value, selectionStart, selectionEnd } = this.element, hasFocus = document.activeElement === this.element, editor = new Editor();
        const [anchor, head] = hasFocus ? [selectionStart, selectionEnd] : [0, 0];
        editor.id = this.element.id;
        this.element.replaceWith(editor);
        editor.begin({ value, selection: { anchor, head }, ...services });
        if (hasFocus)
            editor.select(anchor, head);
        return editor;
    }

    filesChanged() {}
}
