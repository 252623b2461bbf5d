// SPDX-License-Identifier: Apache-2.0
// The entry mxgen/three: materials for three.js. docs/three.md explains it.

import type { IUniform, Loader, LoadingManager, MeshStandardMaterial, MeshStandardMaterialParameters, Texture } from "three";
import type { Document, Element, GenerateRequest, Mxgen, Shader, Variable } from "mxgen";

/** Besides these keys, parameters of three such as `side`. */
export interface MaterialXParameters extends MeshStandardMaterialParameters {
    /** A material, shader, node or output; null: the first renderable. */
    element?: string | Element | null;
    /** Options of generation (docs/javascript.md): { interface: "reduced" }. */
    options?: NonNullable<GenerateRequest["options"]>;
    /** The address of the folder of textures, "" or with "/" at its end. */
    path?: string;
    /** Loads textures; its handlers read other formats. */
    manager?: LoadingManager;
    /** In place of `path` and `manager`: textures that materials share. */
    textures?: MaterialXTextures;
}

/** The members that materials for both renderers have. */
export interface MaterialXMembers {
    readonly isMaterialXMaterial: true;
    /** A new document, after an edit, changes uniforms or, where it must, the program. Throws DocumentError, and then nothing changes. */
    document: Document;
    /** The generated function with its reflection, until the next document. */
    readonly shader: Shader;
    /** By names of variables of `shader`; also those of the host, such as `u_time`. */
    readonly uniforms: Record<string, IUniform>;
    readonly textures: MaterialXTextures;
    /** Sets a uniform by the path of its input ("SR_gold/base_color"), or the file of a texture. false: the input is no uniform; edit the document. */
    setInput(path: string, value: number | boolean | string | ArrayLike<number> | { toArray(): number[] }): boolean;
}

export interface MaterialXMaterial extends MaterialXMembers {}

/** A material of a document for WebGLRenderer. The inputs of a standard material (`color`, `roughness`, `map`…) have no effect. */
export class MaterialXMaterial extends MeshStandardMaterial {
    /** Throws DocumentError. */
    constructor(document: Document, parameters?: MaterialXParameters);
    readonly vertexShader: string;
    readonly fragmentShader: string;
}

/** Textures of files. `dispose` of a material leaves them. */
export class MaterialXTextures {
    constructor(path: string, manager?: LoadingManager);
    /** The texture of a file, or of the tiles of the variable; null: one texel of the default colour. */
    get(file: string | null, variable: Pick<Variable, "values" | "tiles" | "uaddressmode" | "vaddressmode" | "filtertype">): Texture;
    /** Resolves when all files are there or have failed. */
    readonly ready: Promise<unknown>;
    /** Frees the memory of the device. */
    dispose(): void;
}

export interface MaterialXResult<Material = MaterialXMaterial> {
    document: Document;
    /** By path: `materials.Gold`. */
    materials: Record<string, Material>;
    /** Those of all materials. `load` waits for them. */
    textures: MaterialXTextures;
}

/** Loads a document and what it includes. Errors are those of three for files, and DocumentError. */
export class MaterialXLoader<Material = MaterialXMaterial> extends Loader<MaterialXResult<Material>> {
    /** Uses a compiler that is there already; otherwise the first `load` of any loader loads one. */
    setCompiler(mxgen: Mxgen): this;
    /** Each material gets these: options of generation, and parameters of three such as `side`. */
    setParameters(parameters: Omit<MaterialXParameters, "element" | "path" | "manager" | "textures">): this;
    load(url: string, onLoad: (result: MaterialXResult<Material>) => void, onProgress?: (event: ProgressEvent) => void, onError?: (error: unknown) => void): void;
    /** The materials of a text, after `setCompiler`. `path` is that of the textures. */
    parse(text: string, path?: string): MaterialXResult<Material>;
}
