// SPDX-License-Identifier: Apache-2.0
// The look of the editor, in the colours of page.css.

import { HighlightStyle, syntaxHighlighting } from "@codemirror/language";
import { EditorView } from "@codemirror/view";
import { tags } from "@lezer/highlight";

const button = { padding: "2px 8px", border: "1px solid var(--line)", borderRadius: "4px", background: "var(--raised)", color: "var(--text)", font: "12px var(--sans)", cursor: "pointer" };
const popup = { border: "1px solid var(--line)", borderRadius: "6px", background: "var(--raised)", color: "var(--text)", boxShadow: "0 4px 16px var(--shadow)", overflow: "hidden" };

const theme = EditorView.theme({
    "&": { height: "100%", color: "var(--text)", fontSize: "13px" },
    "&.cm-focused": { outline: "none" },
    ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "20px" },
    ".cm-content": { padding: "8px 0", caretColor: "var(--text)" },
    ".cm-cursor": { borderLeftColor: "var(--text)", borderLeftWidth: "2px" },
    ".cm-gutters": { background: "var(--ground)", color: "var(--faint)", border: "none" },
    ".cm-lineNumbers .cm-gutterElement": { minWidth: "4ch", padding: "0 8px 0 4px" },
    ".cm-activeLine": { background: "var(--stripe)" },
    ".cm-activeLineGutter": { background: "none", color: "var(--text)" },
    "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground": { background: "var(--selection)" },
    ".cm-gutter-lint": { width: "14px" },
    ".cm-gutter-lint .cm-gutterElement": { padding: "4px 1px" },
    ".cm-lint-marker": { width: "10px", height: "10px", margin: "1px", borderRadius: "5px", content: "''" },
    ".cm-lint-marker-error": { content: "''", background: "var(--error)" },
    ".cm-lint-marker-warning": { content: "''", background: "var(--warning)", borderRadius: "2px" },
    ".cm-lintRange-error": { backgroundImage: "none", textDecoration: "underline wavy var(--error) 1px", textUnderlineOffset: "3px" },
    ".cm-lintRange-warning": { backgroundImage: "none", textDecoration: "underline wavy var(--warning) 1px", textUnderlineOffset: "3px" },
    ".cm-lintRange.unnecessary": { fontStyle: "italic" },
    ".cm-lintRange.deprecated": { textDecoration: "line-through" },
    ".cm-tooltip": { ...popup, maxWidth: "min(560px, 90vw)", zIndex: 10 },
    ".cm-tooltip-hover": { maxHeight: "50vh", overflow: "auto" },
    ".cm-tooltip-section:not(:first-child)": { borderTop: "1px solid var(--line)" },
    ".cm-diagnostic": { padding: "8px 12px", borderLeft: "3px solid", font: "13px/18px var(--sans)", whiteSpace: "pre-wrap" },
    ".cm-diagnostic-error": { borderColor: "var(--error)" },
    ".cm-diagnostic-warning": { borderColor: "var(--warning)" },
    ".cm-diagnosticText": { display: "block" },
    ".cm-diagnosticAction": { ...button, margin: "6px 6px 0 0", background: "var(--accent)", borderColor: "transparent", color: "var(--on-accent)" },
    ".cm-diagnosticAction u": { textDecoration: "none" }, // the letter of a key of the list, which has none here
    ".code": { color: "var(--faint)", font: "12px var(--mono)" },
    ".note": { color: "var(--faint)" },
    ".documentation": { padding: "8px 12px", font: "13px/19px var(--sans)", maxHeight: "40vh", overflow: "auto" },
    ".documentation p": { margin: "0 0 8px" },
    ".documentation ul": { margin: "0", paddingLeft: "18px" },
    ".documentation :last-child": { marginBottom: 0 },
    ".documentation code": { font: "12px var(--mono)", background: "var(--stripe)", borderRadius: "3px", padding: "1px 4px" },
    ".documentation a": { color: "var(--accent)" },
    ".cm-tooltip.cm-tooltip-autocomplete > ul": { maxHeight: "16em", minWidth: "220px", fontFamily: "var(--mono)" },
    ".cm-tooltip.cm-tooltip-autocomplete > ul > li": { display: "flex", justifyContent: "space-between", gap: "16px", padding: "3px 10px", lineHeight: "18px" },
    ".cm-tooltip-autocomplete ul li[aria-selected]": { background: "var(--accent)", color: "var(--on-accent)" },
    ".cm-completionMatchedText": { textDecoration: "none", fontWeight: "700" },
    ".cm-completionDetail": { fontStyle: "normal", marginLeft: 0, color: "var(--faint)", overflow: "hidden", textOverflow: "ellipsis" },
    "li[aria-selected] .cm-completionDetail": { color: "inherit" },
    ".cm-tooltip.cm-completionInfo": { padding: "0", maxWidth: "360px" },
    ".cm-panels": { background: "var(--raised)", color: "var(--text)", borderColor: "var(--line)", font: "13px var(--sans)" },
    ".cm-panels.cm-panels-top": { borderBottom: "1px solid var(--line)" },
    ".cm-panel.cm-search": { padding: "6px 28px 6px 8px" },
    ".cm-panel.cm-search label": { fontSize: "12px" },
    ".cm-dialog": { padding: "8px 32px 8px 12px" },
    ".cm-dialog label": { fontSize: "13px", display: "inline-flex", gap: "8px", alignItems: "center" },
    ".cm-dialog-close": { color: "var(--text)", top: "6px", right: "8px", fontSize: "18px" },
    ".cm-textfield": { border: "1px solid var(--line)", borderRadius: "4px", background: "var(--field)", color: "var(--text)", font: "13px var(--mono)", padding: "2px 6px" },
    ".cm-textfield:focus": { outline: "2px solid var(--accent)", outlineOffset: "-1px" },
    ".cm-panel [type=checkbox]": { accentColor: "var(--accent)", verticalAlign: "-2px" },
    ".cm-button": { ...button, backgroundImage: "none" },
    ".cm-searchMatch": { background: "var(--match)" },
    ".cm-snippetField": { background: "var(--stripe)", outline: "1px solid var(--line)" },
    ".hint": { marginLeft: "4px", color: "var(--faint)", fontStyle: "italic" },
    ".place": { background: "var(--line)", borderRadius: "2px" },
    ".colour": { appearance: "none", width: "14px", height: "14px", margin: "0 4px 0 0", padding: 0, border: "1px solid var(--faint)", borderRadius: "3px", background: "none", verticalAlign: "-2px", cursor: "pointer" },
    ".colour::-webkit-color-swatch-wrapper": { padding: 0 },
    ".colour::-webkit-color-swatch": { border: 0, borderRadius: "2px" },
});

const style = HighlightStyle.define([
    { tag: tags.tagName, color: "var(--code-tag)" },
    { tag: tags.attributeName, color: "var(--code-attribute)" },
    { tag: [tags.attributeValue, tags.string], color: "var(--code-value)" },
    { tag: [tags.comment, tags.blockComment], color: "var(--code-comment)", fontStyle: "italic" },
    { tag: [tags.angleBracket, tags.definitionOperator, tags.processingInstruction, tags.documentMeta], color: "var(--faint)" },
    { tag: tags.invalid, color: "var(--error)" },
]);

export const look = [theme, syntaxHighlighting(style)];
