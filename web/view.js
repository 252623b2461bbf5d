// SPDX-License-Identifier: Apache-2.0
// The picture: a shader of the target essl on a shape, bound from its reflection, by WebGL 2.

import { Develop } from "./develop.js";
import { faultOf, link } from "./programs.js";
import { attributeOf, backToFront, CAMERA, lightValue, makeMesh, makeSky, uniformOf } from "./scene.js";

const MAX_LIGHTS = 3;
const OVERSAMPLING = 2; // samples of a pixel in each direction, when the picture rests
const IDLE = 150; // milliseconds until it does
const TILE = 512; // pixels of a part of a picture to keep, so that no draw holds up the device
const COARSENESS = 4; // pixels of the first picture for one of its samples, in each direction

const pause = milliseconds => new Promise(resolve => setTimeout(resolve, milliseconds));

/** A fault that a person can read. */
export class ViewError extends Error {}

export class View {
    #canvas;
    #gl;
    #parallel;
    #pending = null; // a program that the driver compiles
    #drawn = null; // the program that is drawn
    #pinned = null; // another one, which is drawn left of an edge
    #edge = 0.5; // as a part of the width
    #isPreview = false; // that is pending or drawn: its picture is coarse
    #complete = null; // the shader that follows the preview
    #meshes = new Map();
    #makers = new Map(); // of shapes that were added
    #buffers = new Map();
    #textures = new Map(); // by file
    #sky = null;
    #ownLight = null;
    #target = null;
    #frame = 0;
    #isBusy = false; // the device draws a frame
    #rest = 0;
    #numChanges = 0; // since the view was opened
    #shape = "ball";
    camera = { ...CAMERA };
    hasMoved = false; // an input has another value than the document of the shader
    onChange = () => {}; // the picture is out of date
    onPicture = () => {}; // the picture is drawn; the argument tells whether with all samples and changes
    onError = () => {};

    constructor(canvas) {
        this.#canvas = canvas;
        this.#gl = canvas.getContext("webgl2", { alpha: false, antialias: false, preserveDrawingBuffer: true });
        if (!this.#gl)
            throw new ViewError("This browser has no WebGL 2, so there is no picture. Everything else works.");
        if (!this.#gl.getExtension("EXT_color_buffer_float"))
            throw new ViewError("This device cannot draw to textures of floating point, so there is no picture. Everything else works.");
        this.#open();
        canvas.addEventListener("webglcontextlost", event => event.preventDefault());
        canvas.addEventListener("webglcontextrestored", () => this.#open());
        new ResizeObserver(() => this.draw()).observe(canvas);
        this.#listen();
    }

    /** Makes what does not depend on a document, also after the device lost everything. */
    #open() {
        const gl = this.#gl;
        this.#meshes.clear();
        this.#buffers.clear();
        this.#target = null;
        gl.getExtension("EXT_color_buffer_float");
        this.#parallel = gl.getExtension("KHR_parallel_shader_compile");
        this.#maps = null;
        for (const [file, { image }] of this.#textures)
            this.setTexture(file, image);
        const shader = this.#complete ?? (this.#pending ?? this.#drawn)?.shader;
        this.#drawn = this.#pending = this.#complete = null;
        this.#isPreview = this.#isBusy = false;
        if (this.#pinned)
            this.#pinned = { shader: this.#pinned.shader, program: link(gl, this.#pinned.shader.vertex, this.#pinned.shader.pixel), locations: new Map() };
        if (shader)
            this.setShader(shader);
    }

    /** Makes what a picture needs beside its shader, while the driver compiles that. */
    #prepare() {
        if (this.#maps)
            return;
        this.#develop = new Develop(this.#gl, this.#tone);
        this.#makeMaps();
        this.#missing = this.#checker();
        this.#mesh(1);
    }

    get #light() {
        return this.#ownLight ?? (this.#sky ??= makeSky());
    }

    #makeMaps() {
        this.#maps = Object.fromEntries(Object.entries(this.#light).map(([name, levels]) => [name, this.#upload(levels)]));
    }

    #develop = null;
    #tone;
    #maps = null;
    #missing;

    // ---- Programs ----

    /** Before the first picture: a smaller shader, whose coarse picture comes first. */
    showPreview(shader) {
        if (this.#drawn || this.#pending)
            return;
        this.#isPreview = true;
        this.#drop({ shader, program: link(this.#gl, shader.vertex, shader.pixel) });
        this.#prepare();
        this.draw();
    }

    #endPreview() {
        const shader = this.#complete;
        this.#isPreview = false;
        this.#complete = null;
        if (shader)
            this.setShader(shader);
    }

    /** Draws with another shader as soon as the driver has compiled it. `shader` has the sources, the info and the variables. */
    setShader(shader) {
        this.hasMoved = false;
        if (this.#isPreview) {
            this.#complete = shader;
            return;
        }
        if (this.#drawn && shader.vertex === this.#drawn.shader.vertex && shader.pixel === this.#drawn.shader.pixel) {
            this.#drawn.shader = shader;
            this.#drop(null);
            this.draw();
            return;
        }
        this.#drop({ shader, program: link(this.#gl, shader.vertex, shader.pixel) });
        this.#prepare();
        this.draw();
    }

    #drop(pending) {
        if (this.#pending)
            this.#gl.deleteProgram(this.#pending.program);
        this.#pending = pending;
    }

    /** Takes the pending program if it is ready; true: it is not. */
    #wait() {
        const gl = this.#gl, pending = this.#pending;
        if (!pending)
            return false;
        if (this.#parallel && !gl.getProgramParameter(pending.program, this.#parallel.COMPLETION_STATUS_KHR))
            return true;
        const fault = faultOf(gl, pending.program);
        if (fault) {
            this.onError(fault);
            this.#drop(null);
            this.#endPreview();
            return false;
        }
        if (this.#drawn && this.#drawn.program !== this.#pinned?.program)
            gl.deleteProgram(this.#drawn.program);
        this.#drawn = { ...pending, locations: new Map() };
        this.#pending = null;
        return false;
    }

    // ---- Textures ----

    #upload(levels) {
        const gl = this.#gl, texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, false);
        levels.forEach(({ width, height, pixels }, level) => gl.texImage2D(gl.TEXTURE_2D, level, gl.RGBA16F, width, height, 0, gl.RGBA, gl.FLOAT, pixels));
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAX_LEVEL, levels.length - 1);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, levels.length > 1 ? gl.LINEAR_MIPMAP_LINEAR : gl.LINEAR);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
        return texture;
    }

    /** Stands in for a missing texture. */
    #checker() {
        const gl = this.#gl, texture = gl.createTexture(), size = 16;
        const pixels = Uint8Array.from({ length: size * size * 4 }, (_, i) => i % 4 === 3 || ((i >> 2) + (i >> 6)) % 2 && i % 4 !== 1 ? 255 : 0);
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, size, size, 0, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        return texture;
    }

    /** The picture of a texture file. Its numbers go to the shader as they are: the shader knows its colour space. */
    setTexture(file, image) {
        const gl = this.#gl, texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, false); // the ImageBitmap is flipped
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, image);
        gl.generateMipmap(gl.TEXTURE_2D);
        this.#textures.set(file, { image, texture });
        this.draw();
    }

    /** Maps (lightOf of scene.js) in the place of the sky and its three lights; null: these. */
    set light(maps) {
        this.#ownLight = maps;
        for (const texture of Object.values(this.#maps ?? {}))
            this.#gl.deleteTexture(texture);
        if (this.#maps)
            this.#makeMaps();
        this.draw();
    }

    // ---- Drawing ----

    get shape() {
        return this.#shape;
    }

    set shape(name) {
        this.#shape = name;
        this.draw();
    }

    /** The source of a function that maps tones (develop.js); none by default. */
    set tone(source) {
        this.#tone = source;
        this.#develop?.finish();
        this.#develop = new Develop(this.#gl, source);
        this.draw();
    }

    /** Asks for a frame: now with one sample for each pixel, and with all when the picture rests. */
    draw() {
        this.#numChanges++;
        this.onChange();
        clearTimeout(this.#rest);
        this.#rest = setTimeout(() => this.#request(OVERSAMPLING), IDLE);
        this.#request(1);
    }

    #request(oversampling) {
        cancelAnimationFrame(this.#frame);
        this.#frame = requestAnimationFrame(() => {
            if (this.#gl.isContextLost())
                return;
            if (this.#isBusy || this.#wait())
                this.#request(oversampling);
            else if (this.#drawn)
                this.#drawFrame(oversampling);
        });
    }

    #bindTarget(width, height) {
        const gl = this.#gl;
        if (this.#target?.width !== width || this.#target?.height !== height) {
            if (this.#target) {
                gl.deleteFramebuffer(this.#target.framebuffer);
                gl.deleteTexture(this.#target.color);
                gl.deleteRenderbuffer(this.#target.depth);
            }
            const framebuffer = gl.createFramebuffer(), color = gl.createTexture(), depth = gl.createRenderbuffer();
            gl.bindTexture(gl.TEXTURE_2D, color);
            gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA16F, width, height);
            for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
                gl.texParameteri(gl.TEXTURE_2D, name, gl.LINEAR);
            gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
            gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
            gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
            gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, color, 0);
            gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
            this.#target = { width, height, framebuffer, color, depth };
        }
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.#target.framebuffer);
        gl.viewport(0, 0, width, height);
    }

    /** With its values of now; an input that moved since may have made it transparent. */
    #isBlended(drawn) {
        const { info } = drawn.shader;
        return info.alpha === "blend" && (info.alphaNow === "blend" || drawn === this.#drawn && this.hasMoved);
    }

    /** Draws the samples of a part of a picture: `first` is the place of its lower left one. Numbers count samples. */
    #drawSamples(extent, first, size) {
        const gl = this.#gl;
        this.#bindTarget(...size);
        gl.viewport(-first[0], -first[1], ...extent);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        const edge = this.#pinned ? Math.max(0, Math.min(size[0], Math.round(this.#edge * extent[0]) - first[0])) : 0;
        gl.enable(gl.SCISSOR_TEST);
        for (const [drawn, from, to] of [[this.#pinned, 0, edge], [this.#drawn, edge, size[0]]])
            if (from < to) {
                gl.scissor(from, 0, to - from, size[1]);
                this.#drawMesh(drawn, extent[0] / extent[1]);
            }
        gl.disable(gl.SCISSOR_TEST);
    }

    #drawMesh(drawn, aspect) {
        const gl = this.#gl;
        gl.useProgram(drawn.program);
        this.#bindUniforms(drawn, aspect);
        const mesh = this.#bindMesh(drawn, drawn.shader.info.displaced ? 4 : 1), blends = this.#isBlended(drawn);
        const capability = (name, on) => on ? gl.enable(name) : gl.disable(name);
        capability(gl.DEPTH_TEST, !blends);
        capability(gl.BLEND, blends);
        gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
        if (blends)
            gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, backToFront(mesh, uniformOf("u_viewDirection", this.camera, aspect, 0)), gl.DYNAMIC_DRAW);
        gl.drawElements(gl.TRIANGLES, mesh.indices.length, gl.UNSIGNED_INT, 0);
    }

    async #drawFrame(oversampling) {
        const gl = this.#gl, canvas = this.#canvas, isPreview = this.#isPreview, numChanges = this.#numChanges;
        const width = Math.max(1, Math.round(canvas.clientWidth * devicePixelRatio)), height = Math.max(1, Math.round(canvas.clientHeight * devicePixelRatio));
        if (canvas.width !== width || canvas.height !== height)
            Object.assign(canvas, { width, height });
        const scale = isPreview ? 1 / COARSENESS : oversampling, extent = [Math.ceil(width * scale), Math.ceil(height * scale)];
        this.#drawSamples(extent, [0, 0], extent);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.viewport(0, 0, width, height);
        this.#develop.draw(this.#target.color, isPreview ? 0 : oversampling, [width, height]);
        this.#isBusy = true;
        if (!await this.#finished())
            return;
        this.#isBusy = false;
        this.onPicture(!isPreview && oversampling === OVERSAMPLING && numChanges === this.#numChanges);
        if (isPreview)
            this.#endPreview();
    }

    /** Waits until the device has done its work; false: it lost it. */
    async #finished() {
        const gl = this.#gl, sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        gl.flush();
        let wait = 0;
        do {
            await pause(wait);
            wait = 4;
            if (gl.isContextLost())
                return false;
        } while (gl.getSyncParameter(sync, gl.SYNC_STATUS) !== gl.SIGNALED);
        gl.deleteSync(sync);
        return true;
    }

    // ---- Comparison ----

    /** Keeps what is drawn, with its values, left of the edge; false: nothing is drawn. */
    pin() {
        if (!this.#drawn || this.#isPreview)
            return false;
        this.unpin();
        const { shader } = this.#drawn, alphaNow = this.#isBlended(this.#drawn) ? "blend" : shader.info.alphaNow;
        const variables = shader.variables.map(variable => ({ ...variable, values: [...variable.values] }));
        this.#pinned = { ...this.#drawn, shader: { ...shader, info: { ...shader.info, alphaNow }, variables } };
        this.draw();
        return true;
    }

    unpin() {
        if (this.#pinned && this.#pinned.program !== this.#drawn?.program)
            this.#gl.deleteProgram(this.#pinned.program);
        this.#pinned = null;
        this.draw();
    }

    /** Where the edge is, as a part of the width. */
    set edge(share) {
        this.#edge = share;
        if (this.#pinned)
            this.draw();
    }

    // ---- Pictures to keep ----

    /** The square picture of a document, with all samples, for a multiple of 512 pixels on each side; null: there is none. */
    async takePicture(size, isTransparent) {
        while (this.#isBusy || this.#wait())
            await pause(4);
        if (!this.#drawn || this.#gl.isContextLost())
            return null;
        this.#isBusy = true; // nothing else is drawn
        try {
            const picture = new ImageData(size, size);
            for (let y = 0; y < size; y += TILE)
                for (let x = 0; x < size; x += TILE)
                    if (!await this.#takeTile(picture, [x, y], isTransparent))
                        return null;
            return picture;
        } finally {
            this.#isBusy = false;
        }
    }

    /** Rows of a picture go down, those of the device up. */
    async #takeTile({ width, height, data }, first, isTransparent) {
        const gl = this.#gl, samples = x => x * OVERSAMPLING, pixels = new Uint8Array(4 * TILE * TILE);
        this.#drawSamples([samples(width), samples(height)], first.map(samples), [samples(TILE), samples(TILE)]);
        const framebuffer = gl.createFramebuffer(), buffer = gl.createRenderbuffer();
        gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
        gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, TILE, TILE);
        gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, buffer);
        gl.viewport(0, 0, TILE, TILE);
        this.#develop.draw(this.#target.color, OVERSAMPLING, [width, height], { first, isTransparent });
        const isDone = await this.#finished();
        gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
        gl.readPixels(0, 0, TILE, TILE, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        gl.deleteFramebuffer(framebuffer);
        gl.deleteRenderbuffer(buffer);
        for (let y = 0; y < TILE; y++)
            data.set(pixels.subarray(4 * TILE * y, 4 * TILE * (y + 1)), 4 * ((height - 1 - first[1] - y) * width + first[0]));
        return isDone;
    }

    /** The name of what is drawn. */
    get title() {
        return this.#drawn?.shader.info.name ?? "";
    }

    // ---- Meshes ----

    /** Adds a shape: `make(detail)` makes its mesh as makeMesh of scene.js does. It takes the place of one with the same name. */
    addShape(name, make) {
        this.#makers.set(name, make);
        for (const key of [...this.#meshes.keys()].filter(key => key.startsWith(`${name} `)))
            this.#meshes.delete(key);
        for (const [key, { buffer }] of [...this.#buffers].filter(([key]) => key.startsWith(`${name} `))) {
            this.#gl.deleteBuffer(buffer);
            this.#buffers.delete(key);
        }
    }

    #mesh(detail) {
        const key = `${this.#shape} ${detail}`, make = this.#makers.get(this.#shape) ?? (cells => makeMesh(this.#shape, cells));
        if (!this.#meshes.has(key))
            this.#meshes.set(key, make(detail));
        return { key, mesh: this.#meshes.get(key) };
    }

    #buffer(key, target, make) {
        const gl = this.#gl;
        if (!this.#buffers.has(key)) {
            const made = make(), buffer = gl.createBuffer();
            gl.bindBuffer(target, buffer);
            gl.bufferData(target, made.values, gl.STATIC_DRAW);
            this.#buffers.set(key, { buffer, components: made.components });
        }
        const found = this.#buffers.get(key);
        gl.bindBuffer(target, found.buffer);
        return found;
    }

    #bindMesh(drawn, detail) {
        const gl = this.#gl, { shader, program } = drawn, { key, mesh } = this.#mesh(detail);
        gl.bindVertexArray(drawn.array ??= gl.createVertexArray());
        for (const { name, type } of shader.variables.filter(({ block }) => block === "appData")) {
            const at = gl.getAttribLocation(program, name);
            if (at < 0)
                continue;
            if (/^(u?int|u?ivec)/.test(type)) {
                gl.disableVertexAttribArray(at);
                gl.vertexAttribI4i(at, 3, 3, 3, 3);
                continue;
            }
            if (!attributeOf({ ...mesh, count: 0 }, name)) {
                gl.disableVertexAttribArray(at);
                continue;
            }
            const { components } = this.#buffer(`${key} ${name}`, gl.ARRAY_BUFFER, () => attributeOf(mesh, name));
            gl.enableVertexAttribArray(at);
            gl.vertexAttribPointer(at, components, gl.FLOAT, false, 0, 0);
        }
        this.#buffer(`${key} ${this.#isBlended(drawn) ? "sorted" : ""}`, gl.ELEMENT_ARRAY_BUFFER, () => ({ values: mesh.indices }));
        return mesh;
    }

    // ---- Uniforms ----

    #setUniform({ program, locations }, name, type, values) {
        const gl = this.#gl;
        if (!locations.has(name))
            locations.set(name, gl.getUniformLocation(program, name));
        const at = locations.get(name);
        if (at === null)
            return;
        const floats = { float: "uniform1fv", vec2: "uniform2fv", vec3: "uniform3fv", vec4: "uniform4fv" };
        const integers = { int: "uniform1iv", bool: "uniform1iv", ivec2: "uniform2iv", ivec3: "uniform3iv", ivec4: "uniform4iv" };
        const matrices = { mat2: "uniformMatrix2fv", mat3: "uniformMatrix3fv", mat4: "uniformMatrix4fv" };
        if (type in floats)
            gl[floats[type]](at, values);
        else if (type in integers)
            gl[integers[type]](at, values.map(Math.trunc));
        else if (type in matrices)
            gl[matrices[type]](at, false, values);
    }

    #bindUniforms(drawn, aspect) {
        const { shader } = drawn, numLevels = this.#light.radiance.length;
        let unit = 0;
        for (const variable of shader.variables) {
            const { name, type, block, values } = variable;
            if (block === "textures")
                this.#bindTexture(drawn, variable, unit++);
            else if (block === "publicUniforms" || block === "privateUniforms") {
                const value = block === "privateUniforms" ? this.#valueOf(name, aspect, numLevels) ?? values : values;
                const count = { float: 1, int: 1, bool: 1, vec2: 2, vec3: 3, vec4: 4, ivec2: 2, ivec3: 3, ivec4: 4, mat2: 4, mat3: 9, mat4: 16 }[type];
                if (value.length >= count)
                    this.#setUniform(drawn, name, type, variable.arrayLength ? value : value.slice(0, count));
            } else if (block === "lightData") {
                for (let light = 0; light < MAX_LIGHTS; light++) {
                    const value = lightValue(light, name) ?? values;
                    if (value.length)
                        this.#setUniform(drawn, `u_lightData[${light}].${name}`, type, value);
                }
            }
        }
    }

    #valueOf(name, aspect, numLevels) {
        return name === "u_numActiveLightSources" && this.#ownLight ? [0] : uniformOf(name, this.camera, aspect, numLevels);
    }

    #bindTexture(drawn, { name, file, uaddressmode, vaddressmode, filtertype }, unit) {
        const gl = this.#gl, modes = { clamp: gl.CLAMP_TO_EDGE, mirror: gl.MIRRORED_REPEAT, constant: gl.CLAMP_TO_EDGE };
        const map = { u_envRadiance: this.#maps.radiance, u_envIrradiance: this.#maps.irradiance }[name];
        const found = map ?? this.#textures.get(file)?.texture;
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, found ?? this.#missing);
        if (found && !map) {
            const closest = filtertype === "closest";
            gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, modes[uaddressmode] ?? gl.REPEAT);
            gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, modes[vaddressmode] ?? gl.REPEAT);
            gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, closest ? gl.NEAREST : gl.LINEAR_MIPMAP_LINEAR);
            gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, closest ? gl.NEAREST : gl.LINEAR);
        }
        this.#setUniform(drawn, name, "int", [unit]);
    }

    // ---- The camera ----

    #turn(right, up) {
        this.camera.azimuth -= right;
        this.camera.elevation = Math.max(-89, Math.min(89, this.camera.elevation + up));
        this.draw();
    }

    #listen() {
        const canvas = this.#canvas;
        canvas.addEventListener("pointerdown", event => canvas.setPointerCapture(event.pointerId));
        canvas.addEventListener("pointermove", event => {
            if (event.buttons & 1)
                this.#turn(event.movementX / 2, event.movementY / 2);
        });
        canvas.addEventListener("wheel", event => {
            event.preventDefault();
            this.camera.zoom = Math.max(0.25, Math.min(4, this.camera.zoom * Math.exp(-event.deltaY / 500)));
            this.draw();
        }, { passive: false });
        canvas.addEventListener("dblclick", () => {
            Object.assign(this.camera, CAMERA);
            this.draw();
        });
        canvas.addEventListener("keydown", event => {
            const [right, up] = { ArrowLeft: [-10, 0], ArrowRight: [10, 0], ArrowUp: [0, 10], ArrowDown: [0, -10] }[event.key] ?? [0, 0];
            if (right || up) {
                event.preventDefault();
                this.#turn(right, up);
            }
        });
    }
}
