// SPDX-License-Identifier: Apache-2.0
// Scenes, and the layers of materials of their primitives (docs/slots.md).

import { Diagnostics } from "./diagnostics.js";
import { ArgumentError, DocumentError } from "./errors.js";
import { expect, expectEach, NONE, numberOf, Owner, STATUS } from "./native.js";


/** The text of mxg_slot_encode or mxg_slot_decode. */
export function slotText(native, name, text, what) {
    return native.using(() => {
        const given = native.newText(text, "name"), made = native.sizedText((out, capacity) => native.lib[name](given, out, capacity));
        if (!made)
            throw new ArgumentError(`'${text}' is not ${what}`);
        return made;
    });
}

/** A primitive of a scene. */
export class Primitive {
    /** `number` is that of the C interface; a parent has a lower one than its children. */
    constructor(scene, number) {
        this.scene = expect(scene, Scene, "scene");
        this.number = expect(number, "number", "number");
        this.#info();
    }

    get #native() {
        return this.scene._native;
    }

    #info() {
        const { lib } = this.#native;
        const info = this.#native.record("mxg_primitive", out => lib.mxg_scene_primitive(this.scene._pointer, this.number, out));
        if (!info)
            throw new ArgumentError(`the scene has no primitive ${this.number}`);
        return info;
    }

    /** The last part of the path. */
    get name() {
        return this.#info().name;
    }

    /** The type in USD: "Mesh"; "" if unknown. */
    get type() {
        return this.#info().type;
    }

    /** "/set/table" */
    get path() {
        const { lib } = this.#native;
        return this.#native.sizedText((out, capacity) => lib.mxg_scene_primitive_path(this.scene._pointer, this.number, out, capacity));
    }

    /** The primitive above; null for a root. */
    get parent() {
        return this.scene._primitive(this.#info().parent);
    }

    /** The primitives directly below. */
    get children() {
        const found = [];
        for (let next = this.#info().firstChild; next !== NONE; next = found.at(-1).#info().nextSibling)
            found.push(new Primitive(this.scene, next));
        return found;
    }

    // ---- Properties ----

    /** The properties by name. A primitive of a list has none; an instance has those of its prototype that it does not set. */
    get properties() {
        const { lib } = this.#native;
        const found = this.#native.records("mxg_property", lib.mxg_scene_num_properties(this.scene._pointer, this.number),
                                           (index, out) => lib.mxg_scene_property(this.scene._pointer, this.number, index, out));
        return new Map(found.map(property => [property.name, property]));
    }

    /** The property of a name; null: there is none. */
    property(name) {
        const native = this.#native;
        return native.using(() => {
            const index = native.lib.mxg_scene_find_property(this.scene._pointer, this.number, native.newText(name, "name"));
            return native.record("mxg_property", out => native.lib.mxg_scene_property(this.scene._pointer, this.number, index, out));
        });
    }

    /** The numbers of a property in a row; true is 1. Empty: there are none. */
    numbers(name) {
        const native = this.#native;
        return native.using(() => {
            const key = native.newText(name, "name");
            const read = (out, capacity) => native.lib.mxg_scene_property_numbers(this.scene._pointer, this.number, key, out, capacity);
            const count = read(0, 0), out = native.space(count * 8);
            read(out, count);
            return Array.from({ length: count }, (_, index) => native.view.getFloat64(out + index * 8, true));
        });
    }

    /** The strings, tokens or paths of a property, without quotes. */
    words(name) {
        const native = this.#native, found = [];
        return native.using(() => {
            const key = native.newText(name, "name");
            const read = (out, capacity) => native.lib.mxg_scene_property_word(this.scene._pointer, this.number, key, found.length, out, capacity);
            for (let word; (word = native.sizedText(read));)
                found.push(word);
            return found;
        });
    }

    /** The primitives that a relationship names; null for a path that the scene does not have. */
    targets(name) {
        const native = this.#native;
        return native.using(() => {
            const key = native.newText(name, "name");
            const read = (out, capacity) => native.lib.mxg_scene_property_targets(this.scene._pointer, this.number, key, out, capacity);
            const count = read(0, 0), out = native.space(count * 4);
            read(out, count);
            return Array.from({ length: count }, (_, index) => this.scene._primitive(native.view.getUint32(out + index * 4, true)));
        });
    }

    /** Whether both are the same primitive of the same scene. */
    equals(other) {
        return other instanceof Primitive && other.scene === this.scene && other.number === this.number;
    }
}

/** The primitives that C asks for, one after the other. An exception waits until the call returns. */
class Adding {
    #native;
    #scene;
    #items;
    #known = new Map(); // their numbers by the objects that gave them
    #given = null;
    #texts = [];

    constructor(native, scene, items) {
        this.#native = native;
        this.#scene = scene;
        this.#items = expectEach(items, "primitives")[Symbol.iterator]();
        this.numbers = [];
        this.raised = null; // { error }
    }

    #parent(above) {
        if (above === null)
            return NONE;
        if (this.#known.has(above))
            return this.#known.get(above);
        if (expect(above, Primitive, "parent").scene !== this.#scene)
            throw new ArgumentError("the parent is of another scene");
        return above.number;
    }

    #text(text, what) {
        const bytes = new TextEncoder().encode(expect(text, "string", what)), address = this.#native.allocate(bytes.length);
        this.#native.bytes(address, bytes.length).set(bytes);
        this.#texts.push(address);
        return [address, bytes.length];
    }

    #fill(last, out) {
        if (this.#given) {
            this.numbers.push(last);
            this.#known.set(this.#given, last);
        }
        this.finish();
        const { done, value } = this.#items.next();
        if (done)
            return 0;
        const { name, parent = null, type = "" } = this.#given = expect(value, "object", "a primitive");
        this.#native.setMembers("mxg_primitive", out, { parent: this.#parent(parent), name: this.#text(name, "name"), type: this.#text(type, "type") });
        return 1;
    }

    nextPrimitive(last, out) {
        try {
            return this.#fill(last >>> 0, out);
        } catch (error) {
            this.raised = { error };
            return 0;
        }
    }

    finish() {
        for (const address of this.#texts.splice(0))
            this.#native.lib.free(address);
    }
}

/** The primitives of a scene. `Context.scene` and `Context.loadScene` give scenes. */
export class Scene extends Owner {
    constructor(context, handle) {
        super(context._native, handle, "scene");
    }

    _primitive(number) {
        // WebAssembly gives numbers with a sign.
        return number >>> 0 === NONE ? null : new Primitive(this, number);
    }

    /** The diagnostics of reading it. */
    get diagnostics() {
        return new Diagnostics(this, this._native.lib.mxg_scene_diagnostics(this._pointer));
    }

    /** Adds primitives and those above them. Throws DocumentError if a path is none (the others are added). After a change its bindings say nothing. */
    add(...paths) {
        const native = this._native;
        native.using(() => {
            const status = native.lib.mxg_scene_add_paths(this._pointer, native.newTexts(paths, "paths"), paths.length);
            this.#check(status);
        });
    }

    #check(status) {
        if (status === STATUS.errorDocument)
            throw new DocumentError(this.diagnostics);
        this._native.check(status);
    }

    /**
     * Adds primitives { name, parent, type }, and gives them; null for one that is faulty. `parent` is a Primitive, or one of these objects
     * that came before. Throws DocumentError if all are added but faulty ones. The iterable must not use the scene.
     */
    addEach(primitives) {
        const native = this._native, adding = new Adding(native, this, primitives), host = native.addHost(adding);
        try {
            const status = native.lib.mxgen_js_scene_add_primitives(this._pointer, host);
            if (adding.raised)
                throw adding.raised.error;
            this.#check(status);
        } finally {
            adding.finish();
            native.removeHost(host);
        }
        return adding.numbers.map(number => this._primitive(number));
    }

    /** Removes primitives, all below them, and their bindings. The numbers of the others stay. Throws if one is removed already: all stay then. */
    remove(...primitives) {
        const native = this._native, numbers = primitives.map(primitive => this.#place(primitive));
        native.using(() => this.#check(native.lib.mxg_scene_remove_primitives(this._pointer, native.newNumbers(numbers), numbers.length)));
    }

    // ---- Bindings of the scene itself ----

    #place(primitive) {
        if (primitive === null)
            return NONE;
        const found = typeof primitive === "string" ? this.find(primitive) : expect(primitive, Primitive, "primitive");
        if (!found || found.scene !== this)
            throw new ArgumentError(found ? "the primitive is of another scene" : `the scene has no primitive '${primitive}'`);
        return found.number;
    }

    /**
     * Binds a material to a slot of a primitive (null: the whole scene), in the place of its direct bindings there. "" removes what the
     * primitive would inherit. Throws DocumentError if the slot's name is none.
     */
    bind(primitive, slot, material) {
        const native = this._native, place = this.#place(primitive);
        native.using(() => this.#check(native.lib.mxg_scene_set_binding(this._pointer, place, native.newText(slot, "slot"), native.newText(material, "material"))));
    }

    /** Removes the direct bindings of a slot from a primitive. */
    unbind(primitive, slot) {
        const native = this._native, place = this.#place(primitive);
        native.using(() => this.#check(native.lib.mxg_scene_remove_binding(this._pointer, place, native.newText(slot, "slot"))));
    }

    /** The bindings of the scene itself that stand at a primitive; null: the whole scene. */
    bindingsOf(primitive) {
        const { lib } = this._native, place = this.#place(primitive);
        return this._native.records("mxg_slot_binding", lib.mxg_scene_num_bindings(this._pointer, place),
                                    (index, out) => lib.mxg_scene_binding(this._pointer, place, index, out));
    }

    /** A primitive by path; null: there is none. */
    find(path) {
        const native = this._native;
        return this._primitive(native.using(() => native.lib.mxg_scene_find_primitive(this._pointer, native.newText(path, "path"))));
    }

    /** The number of primitives. */
    get length() {
        return [...this].length;
    }

    /** All primitives, each after its parent. */
    *[Symbol.iterator]() {
        const { lib } = this._native, num = lib.mxg_scene_num_primitives(this._pointer);
        for (let number = 0; number < num; number++)
            if (lib.mxg_scene_primitive_path(this._pointer, number, 0, 0))
                yield new Primitive(this, number);
    }

    /** "Y" or "Z". */
    get upAxis() {
        return String.fromCharCode(this._native.lib.mxg_scene_up_axis(this._pointer));
    }

    /** Metres in a unit of the scene; 0 for a list of paths. */
    get metersPerUnit() {
        return this._native.lib.mxg_scene_meters_per_unit(this._pointer);
    }
}

/** The layers of each primitive of a scene under a look. `Document.bind` gives bindings. */
export class Bindings extends Owner {
    constructor(document, scene, handle) {
        super(document._native, handle, "bindings");
        this.document = document;
        this.scene = scene;
    }

    #number(primitive) {
        const found = typeof primitive === "string" ? this.scene.find(primitive) : expect(primitive, Primitive, "primitive");
        if (!found || found.scene !== this.scene)
            throw new ArgumentError(found ? "the primitive is of another scene" : `the scene has no primitive '${primitive}'`);
        return found.number;
    }

    #stack(number) {
        const { lib } = this._native;
        return { bindings: this, number,
                 name: this._native.sizedText((out, capacity) => lib.mxg_bindings_stack_name(this._pointer, number, out, capacity)) };
    }

    /** The diagnostics of finding the layers. */
    get diagnostics() {
        return new Diagnostics(this, this._native.lib.mxg_bindings_diagnostics(this._pointer));
    }

    /** The number of primitives whose assignments were found: all, or with `previous` those at or below a difference. */
    get numResolved() {
        return this._native.lib.mxg_bindings_num_resolved_primitives(this._pointer);
    }

    /** The structs of a primitive; `source` is the primitive that each comes from. */
    #records(struct, count, get, primitive) {
        const number = this.#number(primitive);
        const found = this._native.records(struct, count(this._pointer, number), (index, out) => get(this._pointer, number, index, out));
        return found.map(({ from, ...record }) => ({ ...record, source: this.scene._primitive(from) }));
    }

    /** The layers of a primitive, base first; a product, override or vertical layer follows its layer. */
    layers(primitive) {
        const { lib } = this._native;
        return this.#records("mxg_layer", lib.mxg_bindings_num_layers, lib.mxg_bindings_layer, primitive);
    }

    /** Properties, tokens and visibility of a primitive: the strongest of each kind, name and target. */
    facts(primitive) {
        const { lib } = this._native;
        return this.#records("mxg_fact", lib.mxg_bindings_num_facts, lib.mxg_bindings_fact, primitive);
    }

    /** The different stacks of the scene. */
    get stacks() {
        return Array.from({ length: this._native.lib.mxg_bindings_num_stacks(this._pointer) }, (_, number) => this.#stack(number));
    }

    /** The stack of a primitive; null: it has none. Primitives with equal layers have the same one. */
    stack(primitive) {
        const number = this._native.lib.mxg_bindings_stack(this._pointer, this.#number(primitive)) >>> 0;
        return number === NONE ? null : this.#stack(number);
    }

    #written(call) {
        const { status, text } = this._native.writtenText(call);
        if (status === STATUS.errorDocument)
            throw new DocumentError(this.diagnostics);
        this._native.check(status);
        return text;
    }

    /** All bindings as text: "table", "tableColour", "json" or "usda". Throws DocumentError if "usda" cannot express some of them. */
    text(format = "table") {
        const number = numberOf("mxg_bindings_format", format, "format");
        return this.#written(() => this._native.lib.mxgen_js_bindings_write(this._pointer, number));
    }

    /** The reasons of a primitive's layers: every assignment that was considered. */
    explain(primitive) {
        const number = this.#number(primitive);
        return this.#written(() => this._native.lib.mxgen_js_bindings_write_reasons(this._pointer, number));
    }
}
