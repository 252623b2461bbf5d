// SPDX-License-Identifier: Apache-2.0
// The package mxgen: MaterialX documents to shaders. docs/javascript.md explains it.

// `using` needs this, as TypeScript's lib "esnext.disposable" has it.
declare global {
    interface SymbolConstructor {
        readonly dispose: unique symbol;
    }
    interface Disposable {
        [Symbol.dispose](): void;
    }
}

/** A compiled module, WebAssembly.Module: only the lib "dom" of TypeScript has its type. */
export type CompiledModule = object;
export type Bytes = ArrayBuffer | ArrayBufferView;

/** Loads mxgen.wasm, by default from beside the package. `source` is an address (in Node a path), the bytes, or a compiled module. */
export function load(source?: string | { readonly href: string } | Bytes | CompiledModule): Promise<Mxgen>;
/** Loads mxgen from bytes or a compiled module, without default callbacks. */
export function instantiate(source: Bytes | CompiledModule, defaults?: Pick<ContextOptions, "resolver" | "listFolder">): Promise<Mxgen>;

export type Severity = "error" | "warning" | "note";
export type Stage = "vertex" | "pixel";
export type Block = "publicUniforms" | "privateUniforms" | "lightData" | "textures" | "appData" | "vertexData" | "outputs" | "own1" | "own2" | "own3" | "own4";
/** opaque: without blending; mask: with the depth test alone; blend: back to front. Colours are premultiplied. */
export type Alpha = "opaque" | "mask" | "blend";
export type View = "elements" | "graph" | "dot" | "ir" | "closures" | "statistics" | "slabs" | "slabsJson";
/** The effect of a new value of an input on a shader. */
export type InputState = "unknown" | "unused" | "uniform" | "compiled" | "connected";
export type ChangeKind = "nothing" | "values" | "shader";
export type Rewriting = "format" | "upgrade";
export type OptionType = "bool" | "int" | "string" | "enum" | "list" | "float";

/** An instance of mxgen with memory of its own. */
export class Mxgen {
    private constructor();
    createContext(options?: ContextOptions): Context;
    createLanguageServer(options: LanguageServerOptions): LanguageServer;
    /** The version of the library: "0.1.0". */
    readonly version: string;
    readonly targets: Target[];
    /** Every option of `Document.generate`. */
    readonly options: Option[];
    /** The resources that the passes of the deferred pipeline share; the place in the list is the binding. */
    readonly passResources: PassResource[];
    /** Whether an option has a meaning for a target, which ignores the others. */
    optionApplies(key: string, target: string): boolean;
    /** The name of a slot in USD: "050::010" is "_050:_:_010". Throws ArgumentError. */
    encodeSlot(name: string): string;
    /** The reverse of `encodeSlot`. */
    decodeSlot(identifiers: string): string;
    /** Every diagnostic that mxgen can report. */
    readonly diagnosticKinds: DiagnosticKind[];
    /** The meanings of variables without a path. */
    readonly semantics: Semantic[];
    /** The values of an enumeration of the C interface: "mxg_view". */
    static valuesOf(type: string): string[];
}

export interface Target {
    name: string;
    materialxName: string;
    brief: string;
    /** file endings; null: no such stage */
    suffixes: { vertex: string | null; pixel: string | null; pass: string | null; functions: string | null };
}

export interface Option {
    key: string;
    type: OptionType;
    /** enum: "complete|authored|reduced"; int: "0..1024" */
    values: string;
    /** the default, as text */
    initial: string;
    doc: string;
}

export interface DiagnosticKind {
    id: string;
    /** the default; the context's `warnings` can change it */
    severity: Severity;
    message: string;
    cause: string;
    cure: string;
    /** an example as a diff; "": no example */
    example: string;
}

export interface Semantic {
    block: Block;
    semantic: string;
    /** "": several */
    type: string;
    doc: string;
}

// ---- Objects ----

/** An object of the library. The garbage collector frees it; `destroy`, or `using` where JavaScript has it, frees it at once. */
declare class Owner {
    /** Frees the memory of the object now. Objects that were made from it stay. A later use throws MxgenError. */
    destroy(): void;
    [Symbol.dispose](): void;
    /** A description in a few words; console.log of Node shows it. */
    toString(): string;
}

/** A file that a resolver gives. `name`: messages show it, and includes in the file are relative to it. */
export interface ResolvedFile {
    data: string | ArrayBuffer | ArrayBufferView;
    name?: string;
}
export type FileContent = ResolvedFile | string | ArrayBuffer | ArrayBufferView | null | undefined;
/** Finds a file: canonical name of the referring file ("": the caller named the file), reference. null: there is no such file. */
export type Resolver = (from: string, ref: string) => FileContent;

export interface ContextOptions {
    /** By default Node reads files of the file system, and browsers find no file. */
    resolver?: Resolver;
    /** Lists the files of a texture folder (null: there is none), beside a resolver. */
    listFolder?: (from: string, folder: string) => Iterable<string> | null | undefined;
    /** Generation and inspection call it repeatedly, and stop when it returns true. */
    cancel?: () => boolean;
    /**
     * Reads a texture for the estimated errors of budgets: the means of `size` by `size` equal parts, rows from the top, red, green, blue and alpha
     * each, without a change of colour space. null: it cannot be read, and counts as a few fixed colours.
     */
    readTexels?: (from: string, file: string, layer: string, size: number) => ArrayLike<number> | null | undefined;
    /** Limits (include/mxgen/mxgen.h); 0: the default. */
    maxMemory?: number;
    maxFileMib?: number;
    maxElements?: number;
    maxNodes?: number;
    maxOutputMib?: number;
    maxErrors?: number;
    maxDepth?: number;
    maxIncludeDepth?: number;
    maxIncludes?: number;
    /** Changes the severity of diagnostics: "error,no-unused-input". */
    warnings?: string;
    /** Accepts shader source in documents. */
    trust?: boolean;
    /** Folders to search for the source files of implementations. */
    sourcePaths?: string[];
}

/** Files are read in and below the folders of documents, of the workspace, and `includeRoots`, as their paths say: a host with links resolves them itself. */
export interface LanguageServerOptions extends Omit<ContextOptions, "resolver" | "listFolder" | "cancel" | "readTexels"> {
    /** Takes a message for the client. */
    send: (message: object) => void;
    /** Reads a file that the client has not open, by its absolute path (null: there is none). The server asks again after a document was opened or saved, and after `workspace/didChangeWatchedFiles`. */
    readFile?: (path: string) => FileContent | Promise<FileContent>;
    /** Lists a folder (null: there is none); the names of folders end with '/'. */
    listFolder?: (path: string) => FolderContent | Promise<FolderContent>;
    /** By default the one that is built in. */
    library?: Library;
    /** Folders that documents may read besides their own and those of the workspace. */
    includeRoots?: string[];
    /** The page with the explanations of messages, to which their codes link. */
    messagesUrl?: string;
}
export type FolderContent = Iterable<string> | null | undefined;

/** A session of the Language Server Protocol 3.17 with one client (docs/lsp.md). */
export class LanguageServer {
    private constructor();
    /** Takes a message of the client, an object or its text. Returns a promise that ends when nothing waits: no message, and no check of a document. */
    handle(message: object | string): Promise<void>;
    destroy(): void;
    [Symbol.dispose](): void;
}

/** Loads documents and libraries. An exception in a callback ends the call and leaves it unchanged. */
export class Context extends Owner {
    private constructor();
    /** The library that is built in. */
    readonly library: Library;
    /** Makes a library of files or an image (.mxlib), on top of `base` (null: the built-in library), or of nothing. */
    loadLibrary(paths: string[], request?: { base?: Library | null; standalone?: boolean }): Library;
    /** Reads a file by the resolver. Throws DocumentError. */
    load(path: string, request?: { library?: Library | null }): Document;
    /** Reads a document from its text. `name` appears in messages and is the base of includes. Throws DocumentError. */
    parse(text: string | ArrayBuffer | ArrayBufferView, request?: { name?: string; library?: Library | null }): Document;
    /** Reads a file whose includes a server or a database has. Other files come from the resolver. */
    loadAsync(path: string, open: (from: string, ref: string) => Promise<FileContent>, request?: { library?: Library | null }): Promise<Document>;
    /** Begins a new document, or a changed copy of one. */
    edit(document?: Document | null, request?: { name?: string; library?: Library | null }): Edit;
    /** A scene of primitives by their paths, "/set/table", and those above them. Throws DocumentError if a path is none. */
    scene(...paths: string[]): Scene;
    /** Reads a list of paths, or a USD text layer (.usda) with its bindings, by the resolver. `purpose`: "full", "preview", null for all. */
    loadScene(path: string, request?: { purpose?: string | null }): Scene;
    /** Reads a USD text layer from its text. `name` appears in messages, and textures are found from there. Throws DocumentError. */
    parseScene(text: string | ArrayBuffer | ArrayBufferView, request?: { name?: string; purpose?: string | null }): Scene;
    /** The materials in a USD scene as a document. Throws DocumentError. */
    sceneMaterials(scene: Scene, request?: { library?: Library | null }): Document;
    /** The passes of the deferred pipeline that belong to no material, in their order, as far as the options ask for them. Their source is `shader.pixel`. Throws DocumentError. */
    passes(target: string, request?: { options?: Record<string, boolean | number | string | string[]> | null }): { name: string; shader: Shader }[];
    /** The module with functions of the library that shaders import with the option `mdl-module`; its source is `shader.pixel`. Throws DocumentError. */
    module(target: string, request?: { library?: Library | null; options?: Record<string, boolean | number | string | string[]> | null }): Shader;
    /** Reads a document and writes it again. `text` null: reads the file `name`. */
    rewrite(rewriting: Rewriting, name: string, text?: string | ArrayBuffer | ArrayBufferView | null): { text: string; diagnostics: Diagnostics };
    /** The text of a document in one layout; comments stay. */
    format(text: string, request?: { name?: string }): string;
    /** A document of an older version as version 1.39. */
    upgrade(text: string, request?: { name?: string }): { text: string; diagnostics: Diagnostics };
}

// ---- Libraries ----

/** The data of an input for a user interface, in the words of its attributes. */
export interface UserInterface {
    uiname: string;
    uifolder: string;
    uimin: string;
    uimax: string;
    uisoftmin: string;
    uisoftmax: string;
    uistep: string;
    doc: string;
    /** the attribute enum */
    enumNames: string;
    enumValues: string;
    /** uiadvanced */
    advanced: boolean;
}

/** An input or output of a definition. A text that the definition does not have is "". */
export interface Port extends UserInterface {
    name: string;
    type: string;
    value: string;
    defaultgeomprop: string;
    unit: string;
    uniform: boolean;
    unittype: string;
}

/** A node definition. A text that the definition does not have is "". */
export interface NodeDef {
    name: string;
    /** the category of its nodes */
    node: string;
    version: string;
    group: string;
    doc: string;
    file: string;
    hasImplementation: boolean;
    isDefaultVersion: boolean;
    inputs: Port[];
    outputs: Port[];
    /** those of a document or of a library above the definition's come first */
    implementations: Implementation[];
}

/** An implementation gives a definition its meaning: an <implementation>, or a nodegraph with a `nodedef`. A text that it does not have is "". */
export interface Implementation {
    name: string;
    /** MaterialX's name: "genosl"; "": every target */
    target: string;
    nodegraph: string;
    file: string;
    function: string;
    sourcecode: string;
}

/** Node definitions; immutable. */
export class Library extends Owner {
    private constructor();
    readonly diagnostics: Diagnostics;
    readonly files: string[];
    readonly nodedefNames: string[];
    nodedef(name: string): NodeDef | null;
    /** Whether a definition has an implementation for a target. */
    supports(name: string, target: string): boolean;
    /** The library image, for `Context.loadLibrary(…, { standalone: true })`. The library must be standalone. */
    image(): Uint8Array;
    /** The library as a plain MaterialX document with all templates expanded. */
    expand(): string;
    readonly losses: Diagnostics;
}

// ---- Documents ----

/** An element that mxgen can generate. */
export interface Renderable {
    /** "Gold", "NG_marble1/out" */
    path: string;
    type: string;
    category: string;
}

/** The stages and the reflection that a generation makes. */
export interface GenerateRequest {
    /** A material, shader, node or output, a graph with one output, or a look with one material; null: the first renderable. */
    element?: string | Element | null;
    /** A stack of bindings of the document, in the place of an element. */
    stack?: Stack | null;
    /** Keys of `Mxgen.options`; an array gives several values of a list. */
    options?: Record<string, boolean | number | string | string[]> | null;
    /** Leaves out the source. */
    withoutSource?: boolean;
    /** Only checks that the element can be generated. */
    onlyDiagnostics?: boolean;
}

/** A document; immutable. */
export class Document extends Owner {
    private constructor();
    readonly context: Context;
    readonly library: Library;
    readonly diagnostics: Diagnostics;
    /** The files of the document, itself first. */
    readonly files: string[];
    readonly root: Element;
    /** An element by path: "NG_marble1/out". */
    find(path: string): Element | null;
    walk(): IterableIterator<Element>;
    readonly renderables: Renderable[];
    /** The materials that a look or a look group assigns; empty if `look` is not the path of a look. */
    lookMaterials(look: string): Renderable[];
    /** The definitions that the document adds to its library. */
    readonly nodedefs: NodeDef[];
    /** The elements of the root. */
    [Symbol.iterator](): IterableIterator<Element>;
    xml(): string;
    edit(): Edit;
    /** A copy with the materials of a USD scene that the document lacks. Throws DocumentError. */
    withMaterials(scene: Scene): Document;
    /**
     * Finds the layers of each primitive of a scene. `look` null: the only look, or just the bindings of the scene. `solo` has the slots that
     * alone count, `mute` those that do not. `previous` are bindings of the scene before it or the document changed: only primitives at or
     * below a difference are resolved again. Throws DocumentError.
     */
    bind(scene: Scene, look?: string | null, request?: { solo?: string[]; mute?: string[]; previous?: Bindings | null }): Bindings;
    /**
     * The document with its surfaces as another shading model, "gltf_pbr"; the diagnostics tell what is lost. With `joined` a surface that is
     * made of others, such as their <mix>, becomes one. Throws DocumentError.
     */
    translate(model: string, request?: { joined?: boolean }): { text: string; diagnostics: Diagnostics };
    /** Checks every node, connection and value against the library, without generating. */
    validate(): Diagnostics;
    /** Makes a shader. Throws DocumentError. */
    generate(target: string, request?: GenerateRequest): Shader;
    /** A text for people. Throws DocumentError. */
    inspect(view: View, request?: GenerateRequest & { target?: string }): string;
}

export type Value = boolean | number | string | number[];

/** A connection of the graph: `element` reads its `input`, or an <output>, from `upstream`. */
export interface Edge {
    element: Element;
    input: Element;
    upstream: Element;
}

export interface Connection {
    source: Element | null;
    output: string;
    interfacename: string;
}

/** An element of a document. */
export class Element {
    constructor(document: Document, number: number);
    readonly document: Document;
    readonly number: number;
    readonly category: string;
    readonly name: string;
    readonly type: string;
    readonly path: string;
    /** null after an edit */
    readonly place: { file: string; line: number; column: number } | null;
    readonly parent: Element | null;
    readonly children: Element[];
    /** The elements directly below. */
    [Symbol.iterator](): IterableIterator<Element>;
    childrenOf(category: string): Element[];
    /** The inputs that the document writes. */
    readonly inputs: Element[];
    readonly outputs: Element[];
    input(name: string): Element | null;
    /** The connections that the element depends on, the nearest first. Goes into nodegraphs. */
    readonly edges: Edge[];
    /** The nodes and nodegraphs that the element depends on, each once, the nearest first. */
    readonly upstream: Element[];
    child(name: string): Element | null;
    walk(): IterableIterator<Element>;
    get(attribute: string): string | null;
    readonly attributes: Map<string, string>;
    readonly value: Value | null;
    readonly connection: Connection | null;
    readonly definition: NodeDef | null;
    equals(other: unknown): boolean;
}

/** An element of an edit. Its methods change the edit and throw EditError. */
export class Draft {
    private constructor();
    readonly edit: Edit;
    readonly number: number;
    add(category: string, name?: string | null, type?: string | null): Draft;
    child(name: string): Draft | null;
    /** A name that is new below the element: this one, or the same with a number. */
    uniqueName(name: string): string;
    set(attribute: string, value: string | null): this;
    rename(name: string): this;
    /** `type` null: the type of the input, or that of the definition. */
    value(input: string, value: Value | ArrayLike<number>, type?: string | null): this;
    connect(input: string | null, source: Draft | Element, output?: string | null): this;
    remove(): void;
    move(parent?: Draft | Element | null, before?: Draft | Element | null): this;
    flatten(): void;
    copy(element: Element, name?: string | null): Draft;
}

/** A document under construction. */
export class Edit extends Owner {
    private constructor();
    readonly root: Draft;
    find(path: string | Element): Draft | null;
    add(category: string, name?: string | null, type?: string | null): Draft;
    copy(element: Element, name?: string | null): Draft;
    /** Moves nodes of the root into a new nodegraph, in this order. */
    group(nodes: Iterable<Draft | Element>, name: string): Draft;
    /** The definition of a kind of node, which the nodegraph then implements; where elements read it, a node takes its place. */
    define(nodegraph: Draft | Element, name: string, node: string): Draft;
    /** Makes the document. The edit is over, also after an error. Throws DocumentError. */
    end(): Document;
    cancel(): void;
}

// ---- Scenes ----

/** A property of USD. Its texts are those of the file. */
export interface Property {
    name: string;
    /** "point3f[]"; "rel" of a relationship */
    type: string;
    /** "faceVarying"; "": the file does not say it */
    interpolation: string;
    /** of time samples the first; "": none */
    value: string;
    file: string;
    line: number;
    column: number;
}

/** A primitive of a scene. */
export class Primitive {
    constructor(scene: Scene, number: number);
    readonly scene: Scene;
    readonly number: number;
    readonly name: string;
    /** of USD: "Mesh"; "": unknown */
    readonly type: string;
    readonly path: string;
    readonly parent: Primitive | null;
    readonly children: Primitive[];
    readonly properties: Map<string, Property>;
    property(name: string): Property | null;
    /** The numbers of a property in a row; true is 1. */
    numbers(name: string): number[];
    /** The strings, tokens or paths of a property. */
    words(name: string): string[];
    /** The primitives that a relationship names. */
    targets(name: string): (Primitive | null)[];
    equals(other: unknown): boolean;
}

/** A primitive for `Scene.addEach`. */
export interface NewPrimitive {
    /** a name, or a path below the parent: "b/c" */
    name: string;
    /** of the scene, or an object that came before */
    parent?: Primitive | NewPrimitive | null;
    /** as in USD: "Mesh" */
    type?: string;
}

/** A binding of a scene itself. */
export interface SlotBinding {
    /** the whole name: "050::010" */
    slot: string;
    /** the material or the nodegraph; "": a removal */
    material: string;
    /** it is for the members of a collection */
    isCollection: boolean;
    /** it beats the bindings of the scene below it */
    isStrong: boolean;
    /** it is for the purpose of `Context.loadScene` */
    isPurpose: boolean;
    /** its place; "" if it comes from `Scene.bind` */
    file: string;
    line: number;
}

/** The primitives of a scene, each after its parent. */
export class Scene extends Owner implements Iterable<Primitive> {
    private constructor();
    readonly diagnostics: Diagnostics;
    /** Adds primitives and those above them. After a change of a scene its bindings say nothing: call `Document.bind` with `previous`. */
    add(...paths: string[]): void;
    /** Adds primitives with parents and types, and gives them; null for a faulty one. */
    addEach(primitives: Iterable<NewPrimitive>): (Primitive | null)[];
    /** Removes primitives, all below them, and their bindings. */
    remove(...primitives: (Primitive | string)[]): void;
    /** Binds a material to a slot of a primitive (null: the whole scene); "" removes what it would inherit. */
    bind(primitive: Primitive | string | null, slot: string, material: string): void;
    unbind(primitive: Primitive | string | null, slot: string): void;
    /** The bindings of the scene itself that stand at a primitive; null: the whole scene. */
    bindingsOf(primitive: Primitive | string | null): SlotBinding[];
    find(path: string): Primitive | null;
    readonly length: number;
    [Symbol.iterator](): Iterator<Primitive>;
    readonly upAxis: string;
    /** 0 for a list of paths */
    readonly metersPerUnit: number;
}

export type LayerKind = "layer" | "layerProduct" | "layerOverride" | "layerVertical" | "layerVolume" | "layerLight";

export type FactKind = "geomprop" | "token" | "property" | "visibility";

/** The properties that the document gives a primitive beside its layers. */
export interface Fact {
    kind: FactKind;
    /** as in the document; of a visibility the vistype, "" for all */
    name: string;
    type: string;
    value: string;
    /** the renderer that a property is for; the geometry that sees a visibility; "": all */
    target: string;
    /** the primitive where it stands; null: the whole scene */
    source: Primitive | null;
    file: string;
    line: number;
}

/** A resource of the deferred pipeline, in descriptor set binding-set + 1. */
export interface PassResource {
    name: string;
    kind: "image2D" | "image2DArray" | "sampler2D" | "buffer" | "uniform";
    /** "r32ui"; "any": every format of floats; "std430", "std140": of buffers; "": of samplers */
    format: string;
    doc: string;
    /** of "image2DArray"; 0 of "words": as many as the materials need */
    numLayers: number;
    /** of a buffer, without its arrays per tile or pixel */
    byteSize: number;
    /** of a buffer */
    members: PassMember[];
}

/** A member of a buffer of the deferred pipeline. */
export interface PassMember {
    /** as in the source: "mx_to_world" */
    name: string;
    /** "mat4", or the name of a struct */
    type: string;
    /** the words of its numbers, from 0, separated by '|'; "": any number */
    values: string;
    doc: string;
    /** the array is as long for each of them; "": one array */
    per: "tile" | "pixel" | "";
    /** in bytes, from the buffer or the struct */
    offset: number;
    /** 0: no array */
    arrayLength: number;
    arrayStride: number;
    /** 0: no matrix */
    matrixStride: number;
    /** in the struct that is the type of the last member before that is not nested */
    isNested: boolean;
}

/** How a pass of the deferred pipeline runs. */
export interface PassInfo {
    name: string;
    /** invocations of a group, which covers a tile of as many pixels */
    groupSize: [number, number, number];
    /** the buffer "tiles" has the command of its dispatch; else a group per tile */
    isIndirect: boolean;
    /** of that command, in bytes */
    dispatchOffset: number;
    /** bits of resources, by their place in `passResources` */
    reads: number;
    writes: number;
}

/** A layer of a primitive (docs/slots.md). */
export interface Layer {
    kind: LayerKind;
    /** the whole name: "050::010" */
    slot: string;
    material: string;
    isNodegraph: boolean;
    /** of a product: "mask" */
    product: string;
    /** the primitive where the assignment stands; null: the whole scene */
    source: Primitive | null;
    look: string;
    assign: string;
    file: string;
    line: number;
}

/** The layers that several primitives share. */
export interface Stack {
    bindings: Bindings;
    number: number;
    /** follows from the content */
    name: string;
}

/** The layers of each primitive of a scene under a look. */
export class Bindings extends Owner {
    private constructor();
    readonly document: Document;
    readonly scene: Scene;
    readonly diagnostics: Diagnostics;
    /** The number of primitives whose assignments were found: all, or with `previous` those at or below a difference. */
    readonly numResolved: number;
    /** The layers of a primitive, base first; a product, override or vertical layer follows its layer. */
    layers(primitive: Primitive | string): Layer[];
    /** Properties, tokens and visibility of a primitive: the strongest of each kind, name and target. */
    facts(primitive: Primitive | string): Fact[];
    readonly stacks: Stack[];
    stack(primitive: Primitive | string): Stack | null;
    text(format?: "table" | "tableColour" | "json" | "usda"): string;
    /** The reasons of a primitive's layers. */
    explain(primitive: Primitive | string): string;
}

// ---- Shaders ----

export interface Tile {
    file: string;
    u: number;
    v: number;
}

/** A uniform, attribute, texture or output of a shader (docs/reflection.md). */
export interface Variable extends UserInterface {
    index: number;
    name: string;
    block: Block;
    stages: Stage[];
    type: string;
    documentType: string;
    /** of the sampler beside a texture; equal to `binding` where both have one */
    samplerBinding: number;
    /** textures: the document, the include or the library that names `file`, which is relative to the folder of this one */
    origin: string;
    path: string;
    /** in the shader of a stack: "050::010"; otherwise "" */
    slot: string;
    semantic: string;
    colorspace: string;
    unit: string;
    arrayLength: number;
    set: number;
    binding: number;
    location: number;
    offset: number;
    byteSize: number;
    arrayStride: number;
    matrixStride: number;
    values: number[];
    file: string;
    uaddressmode: string;
    vaddressmode: string;
    filtertype: string;
    layer: string;
    framerange: string;
    frameendaction: string;
    frameoffset: number;
    unittype: string;
    flat: boolean;
    integer: number;
    tiles: Tile[];
}

export interface ShaderInfo {
    name: string;
    path: string;
    target: string;
    /** equal for shaders that differ only in names and uniform values */
    topology: bigint;
    numClosures: number;
    numTextures: number;
    numLights: number;
    transparent: boolean;
    lit: boolean;
    displaced: boolean;
    alpha: Alpha;
    /** with role=function: the names of the function and of the struct that it returns; with role=scatter the name of the function alone; otherwise "" */
    function: string;
    functionType: string;
    /** features that the device must have, with commas between: "shader-f16" with precision=mediump, "dual-source-blending" with transparency=dual */
    deviceFeatures: string;
}

/** The images that a shader stores for the passes of the deferred pipeline, or that a pass reads. */
export interface Storage {
    /** of 32 bits per pixel, at most, or of the payload; 0: the shader lights itself */
    words: number;
    /** equal in all materials and passes that fit together */
    layout: number;
    /** classes of pixels, as bits, that a material may store or a lighting pass lights */
    classes: number;
}

/** An input whose value is compiled in. */
export interface CompiledInput extends UserInterface {
    path: string;
    type: string;
    value: string;
    authored: boolean;
}

export interface BlockInfo {
    name: string;
    firstVariable: number;
    numVariables: number;
    byteSize: number;
    set: number;
    binding: number;
    arrayLength: number;
    arrayStride: number;
}

export interface LightType {
    type: number;
    name: string;
    isShader: boolean;
    members: (Variable | null)[];
}

export interface Part {
    name: string;
    source: string;
    nodedef: string;
}

/** The result of a generation; immutable. */
export class Shader extends Owner {
    private constructor();
    readonly vertex: string | null;
    readonly pixel: string | null;
    /** The shaders of an OSL network. */
    readonly parts: Part[];
    sourcePlace(stage: Stage, line: number): { file: string | null; line: number; column: number; path: string } | null;
    sourcePath(stage: Stage, line: number): string | null;
    readonly closurePaths: string[];
    readonly files: string[];
    /** The functions that the source calls and the host writes: "mxg_light" (docs/hosts.md). */
    readonly hostFunctions: string[];
    readonly diagnostics: Diagnostics;
    readonly info: ShaderInfo;
    readonly storage: Storage | null;
    readonly passInfo: PassInfo | null;
    readonly variables: Variable[];
    findVariable(path: string): Variable | null;
    textureFile(variable: Pick<Variable, "index">, request?: { tile?: number; frame?: number }): string | null;
    readonly compiledInputs: CompiledInput[];
    inputState(path: string): InputState;
    change(after: Shader): { kind: ChangeKind; variables: Variable[] };
    block(block: Block): BlockInfo;
    pack(block: Block): Uint8Array;
    /** The block with the values of another document: after an edit of inputs that are uniforms. Generates nothing. */
    packFrom(document: Document, block: Block): Uint8Array;
    packValue(data: Uint8Array, variable: Pick<Variable, "index" | "name">, values: number | ArrayLike<number>, element?: number): void;
    readonly lightTypes: LightType[];
    readonly reflectionJson: string;
    reflection(): any;
}

// ---- Diagnostics and exceptions ----

export interface Diagnostic {
    severity: Severity;
    /** stable, for example "type-mismatch" */
    id: string;
    message: string;
    file: string | null;
    line: number;
    column: number;
    length: number;
    /** for a note: the index of its error or warning; otherwise its own index */
    parent: number;
    /** what the format of the kind leaves open, as texts in its order */
    arguments: string[];
    path: string;
}

/** Diagnostics in order of discovery. Notes follow the diagnostic that they explain. */
export class Diagnostics implements Iterable<Diagnostic> {
    private constructor();
    readonly items: readonly Diagnostic[];
    readonly length: number;
    readonly errors: number;
    readonly warnings: number;
    [Symbol.iterator](): IterableIterator<Diagnostic>;
    formatOne(index: number, request?: { source?: string | null; colour?: boolean }): string;
    format(request?: { source?: string | null; colour?: boolean }): string;
}

export class MxgenError extends Error {}
export class ArgumentError extends MxgenError {}
export class EditError extends ArgumentError {}
export class OutOfMemoryError extends MxgenError {}
export class CancelledError extends MxgenError {}
export class InternalError extends MxgenError {}
export class DocumentError extends MxgenError {
    constructor(diagnostics: Diagnostics, document?: Document | null);
    readonly diagnostics: Diagnostics;
    readonly document: Document | null;
}
