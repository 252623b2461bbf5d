// SPDX-License-Identifier: Apache-2.0
// The parts of the page (web/) that the extension uses, and the files that the build makes.

declare module "@web/changes.js" {
    /** `text` replaces what stands from `start` to `end`, in UTF-16 code units. */
    export interface Change {
        start: number;
        end: number;
        text: string;
    }
    /** An input of a node, and the node's place: line and column from 1; columns count characters. */
    export interface InputPlace {
        line: number;
        column: number;
        node: string;
        input: string;
        type: string;
    }
    /** The offset of a place. */
    export function offsetOf(text: string, line: number, column: number): number;
    /** The change that gives an input of a node a value; null: the node is not at its place, or the text is broken there. */
    export function changeOfInput(text: string, place: InputPlace, value: string): Change | null;
}

declare module "@web/compiler.js" {
    /** A worker that answers requests, and is stopped when an answer takes too long. */
    export class Compiler {
        constructor(source: string);
        ask<Answer>(kind: string, request?: object): Promise<Answer>;
        /** Asks now, and again whenever another worker starts. */
        remember(kind: string, request: object): Promise<unknown>;
    }
}

declare module "@web/inputs.js" {
    import type { Variable } from "mxgen";
    /** Shows the controls whose names have all the words of a text. */
    export function filterInputs(panel: HTMLElement, text: string): void;
    /** The editor that has the focus keeps it. */
    export function showInputs(panel: HTMLElement, variables: Variable[], set: (variable: Variable, values: number[], isFinal: boolean) => void): void;
    export function valueText(variable: Variable, values: number[]): string;
}

declare module "@web/scene.js" {
    export const SHAPE_NAMES: string[];
}

declare module "@web/serve.js" {
    /** Answers messages by the function of their kind. */
    export function serve(kinds: Record<string, (request: any) => unknown>): void;
}

declare module "@web/shaders.js" {
    import type { Diagnostic, Document, ShaderInfo, Variable } from "mxgen";
    export interface Parts {
        info: Pick<ShaderInfo, "name" | "displaced" | "alpha"> & { alphaNow: string; numClosures?: number };
        vertex: string;
        pixel: string;
        variables: Variable[];
    }
    /** Where the nodes of the inputs and textures of a shader stand, by their paths. */
    export function placesOf(document: Document, shader: Parts): Record<string, { file: string; line: number; column: number }>;
    /** The shader that the page draws; null: it has errors, which go to `found`. */
    export function shaderOf(document: Document, element: string, found: Diagnostic[]): Parts | null;
    export function distinct(diagnostics: Diagnostic[]): Diagnostic[];
}

declare module "@web/view.js" {
    import type { Parts } from "@web/shaders.js";
    export class ViewError extends Error {}
    export class View {
        constructor(canvas: HTMLCanvasElement);
        shape: string;
        hasMoved: boolean;
        onChange: () => void;
        onPicture: (isWhole: boolean) => void;
        onError: (fault: string) => void;
        setShader(shader: Parts): void;
        setTexture(file: string, image: ImageBitmap): void;
        draw(): void;
    }
}

/** view/worker.ts, bundled, as text. */
declare module "worker.bundle.js" {
    const source: string;
    export default source;
}
