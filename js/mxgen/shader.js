// SPDX-License-Identifier: Apache-2.0
// Shaders: sources and reflection.

import { Diagnostics } from "./diagnostics.js";
import { Document } from "./document.js";
import { ArgumentError, OutOfMemoryError } from "./errors.js";
import { expect, expectCount, expectEach, kindOf, nameOf, NONE, numberOf, Owner, readOptions, STATUS } from "./native.js";

const STAGES = ["vertex", "pixel"];

/** The result of a generation; immutable. */
export class Shader extends Owner {
    constructor(native, handle) {
        super(native, handle, "shader");
    }

    toString() {
        const info = this._native.record("mxg_shader_info", out => this._native.lib.mxg_result_info(this._pointer, out));
        return info ? `Shader "${info.name}" for ${info.target}` : "Shader, diagnostics only";
    }

    // ---- Source ----

    #source(stage) {
        return this._native.text(this._native.lib.mxg_result_source(this._pointer, numberOf("mxg_stage", stage, "stage"), 0));
    }

    /** The source of the vertex stage; null: the shader has none. */
    get vertex() {
        return this.#source("vertex");
    }

    /** The source of the pixel stage; for OSL the shader. */
    get pixel() {
        return this.#source("pixel");
    }

    /** The shaders of an OSL network. */
    get parts() {
        const { lib } = this._native;
        return this._native.records("mxg_part", lib.mxg_result_num_parts(this._pointer),
                                    (index, out) => lib.mxg_result_part(this._pointer, index, out)).map(({ sourceSize: _, ...part }) => part);
    }

    /** The place in the document that produced a line (from 1) of a stage's source; null: none. */
    sourcePlace(stage, line) {
        const native = this._native;
        const number = numberOf("mxg_stage", stage, "stage");
        return native.record("mxg_place", out => native.lib.mxg_result_source_place(this._pointer, number, line, out));
    }

    /** The path of the node that produced a line, also of a node inside a definition; null: none. */
    sourcePath(stage, line) {
        const { lib } = this._native, number = numberOf("mxg_stage", stage, "stage");
        return this._native.sizedText((out, capacity) => lib.mxg_result_source_path(this._pointer, number, line, out, capacity)) || null;
    }

    /** The paths of the nodes that produced the closures. */
    get closurePaths() {
        const { lib } = this._native;
        return Array.from({ length: this.info.numClosures }, (_, index) => this._native.sizedText(
            (out, capacity) => lib.mxg_result_closure_path(this._pointer, index, out, capacity)));
    }

    /** Files beside those of the document that the shader depends on. */
    get files() {
        const { lib } = this._native;
        return Array.from({ length: lib.mxg_result_num_files(this._pointer) },
                          (_, index) => this._native.text(lib.mxg_result_file(this._pointer, index)));
    }

    /** The functions that the source calls and the host writes (docs/hosts.md). */
    get hostFunctions() {
        const { lib } = this._native;
        return Array.from({ length: lib.mxg_result_num_host_functions(this._pointer) },
                          (_, index) => this._native.text(lib.mxg_result_host_function(this._pointer, index)));
    }

    /** The diagnostics of the call: warnings, if it succeeded. */
    get diagnostics() {
        return new Diagnostics(this, this._native.lib.mxg_result_diagnostics(this._pointer));
    }

    // ---- Reflection ----

    /** The shader as a whole. Throws ArgumentError after `onlyDiagnostics`. */
    get info() {
        const info = this._native.record("mxg_shader_info", out => this._native.lib.mxg_result_info(this._pointer, out));
        if (!info)
            throw new ArgumentError("the call made diagnostics only");
        return info;
    }

    /** The images that the shader stores for the passes of the deferred pipeline; null after `onlyDiagnostics`. */
    get storage() {
        return this._native.record("mxg_storage", out => this._native.lib.mxg_result_storage(this._pointer, out));
    }

    /** How the pass of the deferred pipeline runs; null for a shader that is none. */
    get passInfo() {
        return this._native.record("mxg_pass", out => this._native.lib.mxg_result_pass(this._pointer, out));
    }

    #variable(index) {
        const { lib } = this._native, variable = this._native.record("mxg_variable", out => lib.mxg_result_variable(this._pointer, index, out));
        variable.index = index;
        variable.stages = STAGES.filter((_, stage) => variable.stages >> stage & 1);
        variable.values.length = variable.numValues;
        variable.tiles = this._native.records("mxg_tile", variable.numTiles,
                                              (tile, out) => lib.mxg_result_tile(this._pointer, index, tile, out));
        delete variable.numValues;
        delete variable.numTiles;
        return variable;
    }

    /** Every variable of the interface. */
    get variables() {
        return Array.from({ length: this._native.lib.mxg_result_num_variables(this._pointer) }, (_, index) => this.#variable(index));
    }

    /** The variable for a document path; null: the input is unused or compiled in. */
    findVariable(path) {
        const native = this._native;
        const index = native.using(() => native.lib.mxg_result_find_variable(this._pointer, native.newText(path, "path"))) >>> 0;
        return index === NONE ? null : this.#variable(index);
    }

    #index(variable) {
        const index = expectCount(expect(variable?.index, "number", "variable.index"), "variable.index");
        if (index >= this._native.lib.mxg_result_num_variables(this._pointer))
            throw new ArgumentError(`the shader has no variable ${index}`);
        return index;
    }

    /** The file of a texture, or of one of its tiles, at a frame; null: the frame has no file. */
    textureFile(variable, request = {}) {
        const { tile, frame } = readOptions(request, { tile: 0, frame: 0 });
        const { lib } = this._native, index = this.#index(variable);
        expectCount(tile, "tile");
        if (!Number.isInteger(frame) || frame !== (frame | 0))
            throw new ArgumentError(`frame must be an integer of 32 bits, not ${String(frame)}`);
        return this._native.sizedText((out, capacity) => lib.mxg_result_texture_file(this._pointer, index, tile, frame, out, capacity)) || null;
    }

    /** Inputs whose value is compiled in. */
    get compiledInputs() {
        const { lib } = this._native;
        return this._native.records("mxg_compiled_input", lib.mxg_result_num_compiled_inputs(this._pointer),
                                    (index, out) => lib.mxg_result_compiled_input(this._pointer, index, out));
    }

    /** The effect of a new value of an input of a node or nodegraph. */
    inputState(path) {
        return this._native.using(() => nameOf("mxg_input_state",
                                               this._native.lib.mxg_result_input_state(this._pointer, this._native.newText(path, "path"))));
    }

    /** The steps of a host that draws `after` in place of this shader, and the variables of `after` with other values. */
    change(after) {
        expect(after, Shader, "after");
        const native = this._native, capacity = native.lib.mxg_result_num_variables(after._pointer);
        return native.using(() => {
            const indices = native.space(capacity * 4), count = native.space(4);
            const kind = nameOf("mxg_change", native.lib.mxg_result_change(this._pointer, after._pointer, indices, capacity, count));
            return { kind, variables: Array.from({ length: Math.min(native.pointer(count), capacity) },
                                                 (_, index) => after.#variable(native.pointer(indices + 4 * index))) };
        });
    }

    /** A block of the interface. */
    block(block) {
        const number = numberOf("mxg_block", block, "block");
        const info = this._native.record("mxg_block_info", out => this._native.lib.mxg_result_block(this._pointer, number, out));
        if (!info)
            throw new ArgumentError("the call made no interface");
        return info;
    }

    /** The buffer of a block of uniforms with the default values, ready for upload. */
    pack(block) {
        return this.#packed(0, block, status => this._native.check(status));
    }

    /** The values of a native document, or 0: those of the shader. `check` sees the status. */
    #packed(document, block, check) {
        const native = this._native, number = numberOf("mxg_block", block, "block");
        return native.using(() => {
            const info = native.record("mxg_block_info", out => native.lib.mxg_result_block(this._pointer, number, out));
            const size = info?.byteSize ?? 0, data = native.space(size);
            if (size)
                check(native.lib.mxg_result_pack_block(this._pointer, document, number, data, size));
            return native.bytes(data, size).slice();
        });
    }

    /**
     * The buffer of a block with the values of another document, for example after an edit of inputs that are uniforms. Generates nothing.
     * Throws ArgumentError if an input of the block has no value there, for example because it is connected.
     */
    packFrom(document, block) {
        expect(document, Document, "document");
        return this.#packed(document._pointer, block, status => {
            if (status === STATUS.errorDocument)
                throw new ArgumentError("an input of the block has no value in the document");
            this._native.check(status, status === STATUS.errorArgument ? "the document has another library" : "");
        });
    }

    /** Writes the value of a variable to its place in such a buffer. `element` is the light or the element of an array. */
    packValue(data, variable, values, element = 0) {
        expect(data, Uint8Array, "data");
        expectCount(element, "element");
        const native = this._native, index = this.#index(variable);
        const components = Array.from(typeof values === "number" ? [values] : expectEach(values, "values"), value => expect(value, "number", "a value"));
        native.using(() => {
            const copy = native.newBytes(data), status = native.lib.mxg_result_pack_value(this._pointer, index, element,
                native.newFloats(components), components.length, copy, data.length);
            native.check(status, status === STATUS.errorArgument
                ? `'${variable.name}' is in no buffer, has another number of values or no room in the buffer, or is an integer, and the value has a fraction or lies beyond 2^24` : "");
            data.set(native.bytes(copy, data.length));
        });
    }

    /** The light shaders. `members[n]` is the variable of member n of LightData; null: no stage reads it. */
    get lightTypes() {
        const native = this._native, { lib } = native;
        return native.records("mxg_light_type", lib.mxg_result_num_light_types(this._pointer),
                              (index, out) => lib.mxg_result_light_type(this._pointer, index, out)).map(({ numMembers, ...light }, index) => ({
            ...light,
            members: Array.from({ length: numMembers }, (_, member) => {
                const variable = lib.mxg_result_light_member(this._pointer, index, member) >>> 0;
                return variable === NONE ? null : this.#variable(variable);
            }),
        }));
    }

    /** The variables, inputs and info as JSON (docs/reflection.md). */
    get reflectionJson() {
        const text = this._native.text(this._native.lib.mxg_result_reflection_json(this._pointer, 0));
        if (text === null)
            throw new OutOfMemoryError("there is no shader, or no memory for the text");
        return text;
    }

    /** The reflection as an object. */
    reflection() {
        return JSON.parse(this.reflectionJson);
    }

    /** The text of an inspection. */
    _text() {
        return this._native.text(this._native.lib.mxg_result_text(this._pointer, 0));
    }
}

/** Calls `use` with the native options of a call; `values` is null or an object. */
export function withOptions(context, values, use) {
    if (values === null || values === undefined)
        return use(0);
    expect(values, "object", "options");
    const native = context._native, { lib } = native;
    return native.using(() => {
        const out = native.space(4);
        native.check(context._turn(pointer => lib.mxg_options_create(pointer, out)));
        const options = native.pointer(out), reason = () => native.sizedText((buffer, capacity) => lib.mxg_options_error(options, buffer, capacity));
        try {
            for (const [key, value] of Object.entries(values))
                for (const item of Array.isArray(value) ? value : [value]) {
                    if (!["string", "number", "boolean"].includes(typeof item))
                        throw new TypeError(`option '${key}' must be a boolean, number, string or an array of strings, not ${kindOf(item)}`);
                    const status = lib.mxg_options_set(options, native.newText(key, "the key of an option"),
                                                       native.newText(String(item), `option '${key}'`));
                    native.check(status, status === STATUS.errorArgument ? reason() : "");
                }
            return use(options);
        } finally {
            lib.mxg_options_destroy(options);
        }
    });
}
