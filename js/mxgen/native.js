// SPDX-License-Identifier: Apache-2.0
// Calls of the C library in WebAssembly: texts, structs, exceptions, and the lifetime of objects.

import { ArgumentError, CancelledError, InternalError, MxgenError, OutOfMemoryError } from "./errors.js";
import { ENUMS, STRUCTS } from "./layout.js";

const encoder = new TextEncoder();
const decoder = new TextDecoder();
const STATUS = ENUMS.mxg_status;
/** An index that is none. */
export const NONE = 0xffffffff;
const NAMES = Object.fromEntries(Object.entries(ENUMS).map(
    ([type, values]) => [type, Object.fromEntries(Object.entries(values).map(([name, value]) => [value, name]))]));
const WASI_NOT_SUPPORTED = 52; // ENOSYS
const WASI_BAD_DESCRIPTOR = 8; // EBADF
// The library finds an empty environment, and no files or streams.
const WASI = {
    environ_get: () => 0,
    fd_prestat_get: () => WASI_BAD_DESCRIPTOR,
    proc_exit: () => { throw new InternalError("mxgen ended"); },
};

const PLAIN = new Set(["number", "boolean", "undefined"]); // which WebAssembly takes without running code of the caller

/** The exception of mem_fail (src/base/mem.h). */
class Unwinding {
    constructor(trap) {
        this.trap = trap;
    }
}

/** The kind of a value, for messages. */
export function kindOf(value) {
    return value === null ? "null" : Array.isArray(value) ? "an array" : typeof value === "object" ? value.constructor?.name ?? "object" : typeof value;
}

/** A number that C takes as a uint32_t. WebAssembly makes 0 of NaN and of 2^32. */
export function expectCount(value, what) {
    if (!Number.isInteger(value) || value < 0 || value > 0xffffffff)
        throw new ArgumentError(`${what} must be an integer from 0 to 4294967295, not ${String(value)}`);
    return value;
}

/** Throws a TypeError unless the argument has the type. `what` names the argument. */
export function expect(value, type, what) {
    if (typeof type === "function" ? !(value instanceof type) : typeof value !== type || value === null)
        throw new TypeError(`${what} must be ${typeof type === "function" ? type.name : type}, not ${kindOf(value)}`);
    return value;
}

/** Throws if an option is none of the known ones. */
export function expectOptions(options, known) {
    for (const name of Object.keys(expect(options, "object", "options")))
        if (!known.includes(name))
            throw new ArgumentError(`there is no option '${name}'; known are ${known.join(", ")}`);
}

/** The options over their defaults. Throws if one is none of these. */
export function readOptions(options, defaults) {
    expectOptions(options, Object.keys(defaults));
    return Object.fromEntries(Object.entries(defaults).map(([name, initial]) => [name, options[name] === undefined ? initial : options[name]]));
}

/** Throws a TypeError unless the argument is iterable. */
export function expectEach(values, what) {
    if (typeof values?.[Symbol.iterator] !== "function")
        throw new TypeError(`${what} must be iterable, not ${kindOf(values)}`);
    return values;
}

/** The number of a value of an enumeration. */
export function numberOf(type, value, what) {
    const values = ENUMS[type];
    if (!Object.hasOwn(values, value))
        throw new ArgumentError(`${what} must be one of ${Object.keys(values).join(", ")}, not '${String(value)}'`);
    return values[value];
}

/** The name of a number of an enumeration. */
export function nameOf(type, number) {
    return NAMES[type][number];
}

/** An instance of the library: its memory, its functions, and the callbacks of its contexts. */
export class Native {
    #exports;
    #temporary = []; // addresses that the end of `using` frees
    #hosts = new Map();
    #nextHost = 1;
    #written = []; // the pieces of a text that C writes
    #fault = null; // the reason why the instance ended

    constructor() {
        this.lib = new Proxy(this, { get: (native, name) => native.#function(name) });
    }

    static async instantiate(module) {
        const native = new Native();
        const imports = { mxgen: native.#imports(), wasi_snapshot_preview1: {} };
        for (const { module: from, name } of WebAssembly.Module.imports(module))
            if (from === "wasi_snapshot_preview1")
                imports[from][name] = WASI[name] ?? (() => WASI_NOT_SUPPORTED);
        imports.wasi_snapshot_preview1.environ_sizes_get = (count, size) => {
            native.view.setUint32(count, 0, true);
            native.view.setUint32(size, 0, true);
            return 0;
        };
        const instance = await WebAssembly.instantiate(module, imports);
        native.#exports = instance.exports;
        native.#exports._initialize();
        return native;
    }

    // ---- Calls ----

    /**
     * A function of the library, which takes numbers. An exception of WebAssembly itself, for example a stack overflow, ends the instance.
     */
    #function(name) {
        const called = this.#exports[name];
        return (...values) => {
            if (this.#fault)
                throw new InternalError(`mxgen ended after an error: ${this.#fault}`);
            for (const value of values)
                if (!PLAIN.has(typeof value))
                    throw new TypeError(`a number is expected, not ${kindOf(value)}`);
            try {
                return called(...values);
            } catch (error) {
                this.#fault = error instanceof Unwinding ? "out of memory outside a call" : String(error?.message ?? error);
                throw error instanceof InternalError ? error : new InternalError(this.#fault);
            }
        };
    }

    #imports() {
        return {
            try: (work, argument, trap) => this.#try(work, argument, trap),
            throw: trap => { throw new Unwinding(trap); },
            abort: message => { throw new InternalError(this.text(message)); },
            open: (host, ...rest) => this.#hosts.get(host).open(...rest),
            release: (host, blob) => this.#hosts.get(host).release(blob),
            list_folder: (host, ...rest) => this.#hosts.get(host).listFolder(...rest),
            cancel: host => this.#hosts.get(host).cancel(),
            read_texels: (host, ...rest) => this.#hosts.get(host).readTexels(...rest),
            next_primitive: (host, ...rest) => this.#hosts.get(host).nextPrimitive(...rest),
            write: (_, data, size) => { this.#written.push(this.bytes(data, size).slice()); return 1; },
        };
    }

    #try(work, argument, trap) {
        const stack = this.#exports.__stack_pointer.value;
        try {
            this.#exports.__indirect_function_table.get(work)(argument);
            return 1;
        } catch (error) {
            if (!(error instanceof Unwinding) || error.trap !== trap)
                throw error;
            this.#exports.__stack_pointer.value = stack;
            return 0;
        }
    }

    /** Registers callbacks, of a context or a call; returns their number. */
    addHost(host) {
        this.#hosts.set(this.#nextHost, host);
        return this.#nextHost++;
    }

    removeHost(number) {
        this.#hosts.delete(number);
    }

    // ---- Memory ----

    /** The memory. A call of the library may grow it, and the view then ends. */
    get view() {
        return new DataView(this.#exports.memory.buffer);
    }

    bytes(address, size) {
        return new Uint8Array(this.#exports.memory.buffer, address, size);
    }

    /** Zeroed memory for `free`. */
    allocate(size) {
        const address = this.lib.malloc(Math.max(size, 1));
        if (!address)
            throw new OutOfMemoryError("there is no memory left");
        this.bytes(address, size).fill(0);
        return address;
    }

    /** Calls `work`, and frees afterwards what the functions below made in it. */
    using(work) {
        const mark = this.#temporary.length;
        try {
            return work();
        } finally {
            this.#free(this.#temporary.splice(mark));
        }
    }

    /** In `using`: calls `work` with a function that frees what the functions below make in it, instead of the end of `using`. */
    keeping(work) {
        const mark = this.#temporary.length, kept = [], made = work(() => this.#free(kept));
        kept.push(...this.#temporary.splice(mark));
        return made;
    }

    #free(addresses) {
        for (const address of addresses)
            if (!this.#fault)
                this.lib.free(address);
    }

    space(size) {
        const address = this.allocate(size);
        this.#temporary.push(address);
        return address;
    }

    /** A text for C. `what` names the argument in the TypeError. */
    newText(value, what) {
        expect(value, "string", what);
        if (value.includes("\0"))
            throw new ArgumentError(`${what} contains a NUL character`);
        return this.newBytes(encoder.encode(value));
    }

    /** As above; null and undefined give NULL. */
    newOptionalText(value, what) {
        return value === null || value === undefined ? 0 : this.newText(value, what);
    }

    /** Bytes for C, with a NUL behind them. */
    newBytes(bytes) {
        const address = this.space(bytes.length + 1);
        this.bytes(address, bytes.length).set(bytes);
        return address;
    }

    /** An array of texts. `what` names the argument. */
    newTexts(values, what) {
        if (!Array.isArray(values))
            throw new TypeError(`${what} must be an array, not ${kindOf(values)}`);
        const addresses = values.map(value => this.newText(value, `a text of ${what}`)), array = this.space(addresses.length * 4);
        addresses.forEach((address, index) => this.view.setUint32(array + index * 4, address, true));
        return array;
    }

    newNumbers(values) {
        const array = this.space(4 * values.length);
        values.forEach((number, index) => this.view.setUint32(array + index * 4, number, true));
        return array;
    }

    newFloats(values) {
        const array = this.space(values.length * 4);
        values.forEach((value, index) => this.view.setFloat32(array + index * 4, value, true));
        return array;
    }

    /** The text at an address; null for NULL. */
    text(address) {
        if (!address)
            return null;
        const bytes = new Uint8Array(this.#exports.memory.buffer);
        return decoder.decode(bytes.subarray(address, bytes.indexOf(0, address)));
    }

    pointer(address) {
        return this.view.getUint32(address, true);
    }

    /** The text of a function that writes into a buffer and returns the full length. */
    sizedText(write) {
        return this.using(() => {
            const size = write(0, 0), buffer = this.space(size + 1);
            write(buffer, size + 1);
            return this.text(buffer);
        });
    }

    /** The result of a call of C, and the pieces that it writes. */
    written(call) {
        const status = call();
        return { status, pieces: this.#written.splice(0) };
    }

    /** The text that a call of C writes in pieces, and its status. */
    writtenText(call) {
        const { status, pieces } = this.written(call), stream = new TextDecoder();
        return { status, text: pieces.map(piece => stream.decode(piece, { stream: true })).join("") + stream.decode() };
    }

    // ---- Structs ----

    #read(kind, address) {
        switch (kind) {
        case "text": return this.text(this.pointer(address));
        case "piece": return decoder.decode(this.bytes(this.pointer(address), this.pointer(address + 4)));
        case "bool": return this.view.getUint8(address) !== 0;
        case "i32": return this.view.getInt32(address, true);
        case "f32": return this.view.getFloat32(address, true);
        case "u64": return this.view.getBigUint64(address, true);
        default: {
            const number = this.view.getUint32(address, true);
            return kind in NAMES ? NAMES[kind][number] : number;
        }
        }
    }

    #write(kind, address, value) {
        if (kind === "bool")
            this.view.setUint8(address, value ? 1 : 0);
        else if (kind === "piece")
            value.forEach((number, index) => this.view.setUint32(address + 4 * index, number, true));
        else
            this.view.setUint32(address, value, true);
    }

    /** A struct with its size and the given members: numbers, booleans, addresses, and [address, length] of texts without NUL. */
    newStruct(type, values = {}) {
        const { size, members } = STRUCTS[type], address = this.space(size);
        for (const [name, value] of Object.entries({ size, ...values }))
            this.#write(members[name][0], address + members[name][1], value);
        return address;
    }

    /** Sets members of a struct that C gave. */
    setMembers(type, address, values) {
        for (const [name, value] of Object.entries(values))
            this.#write(STRUCTS[type].members[name][0], address + STRUCTS[type].members[name][1], value);
    }

    /** The members of a struct. An address is a number. */
    members(type, address) {
        const found = {};
        for (const [name, [kind, offset, items]] of Object.entries(STRUCTS[type].members)) {
            if (name === "size")
                continue;
            found[name] = items ? Array.from({ length: items }, (_, i) => this.#read(kind, address + offset + 4 * i))
                                : this.#read(kind, address + offset);
        }
        return found;
    }

    /** The struct that a function fills; null if the function refuses its arguments. */
    record(type, fill) {
        return this.using(() => {
            const address = this.newStruct(type), status = fill(address);
            if (status === STATUS.errorArgument)
                return null;
            this.check(status);
            return this.members(type, address);
        });
    }

    /** The structs 0 to `count` - 1 that a function fills. */
    records(type, count, fill) {
        return Array.from({ length: count }, (_, index) => this.record(type, address => fill(index, address)));
    }

    // ---- Status ----

    /** Throws unless the status is MXG_OK. */
    check(status, reason = "") {
        if (status !== STATUS.ok)
            throw this.errorOf(status, reason);
    }

    errorOf(status, reason = "") {
        const kinds = { errorArgument: ArgumentError, errorMemory: OutOfMemoryError, errorCancelled: CancelledError };
        return new (kinds[nameOf("mxg_status", status)] ?? InternalError)(reason || this.text(this.lib.mxg_status_string(status)));
    }
}

/**
 * A native object. It ends after its owner and after every object that was made from it, in whatever order they end: a child counts as an
 * owner of its parents.
 */
export class Handle {
    #owners = 1;
    #destroy;
    #parents;

    constructor(pointer, destroy, parents = []) {
        this.pointer = pointer;
        this.#destroy = destroy;
        this.#parents = parents;
        for (const parent of parents)
            parent.#owners++;
    }

    /** Ends the share of one owner. */
    release() {
        if (--this.#owners > 0)
            return;
        this.#destroy(this.pointer);
        this.pointer = 0;
        for (const parent of this.#parents)
            parent.release();
    }
}

export const INSPECT = Symbol.for("nodejs.util.inspect.custom");

const abandoned = new FinalizationRegistry(handle => {
    try {
        handle.release();
    } catch (error) {
        if (!(error instanceof InternalError)) // the instance has ended
            throw error;
    }
});

/** An object that owns a handle. */
export class Owner {
    #handle;
    #kind;

    constructor(native, handle, kind) {
        Object.defineProperty(this, "_native", { value: native });
        this.#handle = handle;
        this.#kind = kind;
        abandoned.register(this, handle, this);
    }

    /** Throws after `destroy`. */
    get _handle() {
        if (!this.#handle)
            throw new MxgenError(`the ${this.#kind} was destroyed`);
        return this.#handle;
    }

    get _pointer() {
        return this._handle.pointer;
    }

    get _isDestroyed() {
        return !this.#handle;
    }

    /** The handle, which the caller then owns. */
    _take() {
        const handle = this._handle;
        abandoned.unregister(this);
        this.#handle = null;
        return handle;
    }

    toString() {
        return this.constructor.name;
    }

    /** console.log of Node shows this. */
    [INSPECT]() {
        return this.#handle ? this.toString() : `${this.constructor.name}, destroyed`;
    }

    /** Frees the memory of the object now, instead of after its last use. Objects that were made from it stay. */
    destroy() {
        if (this.#handle)
            this._take().release();
    }
}

if (Symbol.dispose)
    Owner.prototype[Symbol.dispose] = Owner.prototype.destroy;

export { STATUS };
