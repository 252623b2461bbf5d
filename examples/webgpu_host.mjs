// SPDX-License-Identifier: Apache-2.0
// The part that hosts in WebGPU share: a device, a lit ball, and the bindings that the reflection of a shader asks for.
// MXGEN_DAWN names index.js of the package "webgpu". In a browser the device is that of navigator.gpu.
import {readFileSync, writeFileSync} from 'node:fs';
import {pathToFileURL} from 'node:url';

export const size = 256;
const rings = 64, eye = [0, 0, 4];
const {create, globals} = await import(pathToFileURL(process.env.MXGEN_DAWN));
Object.assign(globalThis, globals);
const gpu = globalThis.gpu = create(['backend=vulkan']); // lives as long as its device
export const device = await (await gpu.requestAdapter()).requestDevice();
export const read = (path) => readFileSync(path, 'utf8');
export const moduleOf = (path) => device.createShaderModule({code: read(path)});
export const variablesOf = ({blocks}, name) => blocks?.find((block) => block.name === name)?.variables ?? [];
export const make = (data, usage) => {
    const buffer = device.createBuffer({size: data.byteLength, usage: usage | GPUBufferUsage.COPY_DST});
    device.queue.writeBuffer(buffer, 0, data);
    return buffer;
};

// The host has matrices by column, a light, grey surroundings, and a ball.
export const near = 1, far = 10, a = far / (near - far), b = near * a, zoom = 3.5, distance = eye[2];
const uniforms = {
    viewPosition: eye, numActiveLightSources: [1],
    viewProjectionMatrix: [zoom, 0, 0, 0, 0, zoom, 0, 0, 0, 0, a, -1, 0, 0, b - a * distance, distance]
};
const vertices = Array.from({length: 2 * rings * (rings + 1)}, (_, i) => {
    const u = i % (2 * rings) / (2 * rings - 1), v = Math.floor(i / (2 * rings)) / rings;
    const r = Math.sin(Math.PI * v), angle = 2 * Math.PI * u;
    const at = [r * Math.sin(angle), -Math.cos(Math.PI * v), r * Math.cos(angle)];
    return {'position:object': at, 'normal:object': at, 'tangent:object': [Math.cos(angle), 0, -Math.sin(angle)], 'texcoord:0': [u, v]};
});
const indices = vertices.slice(2 * rings + 1).flatMap((_, i) => [i, i + 1, i + 2 * rings, i + 1, i + 2 * rings + 1, i + 2 * rings]);

// Entries of layouts and groups, by set.
export class Bindings {
    sets = [];
    constructor(visibility) { this.visibility = visibility; }
    add(set, binding, layout, resource) {
        (this.sets[set] ??= []).push({layout: {binding, visibility: this.visibility, ...layout}, group: {binding, resource}});
    }
    // Blocks of uniforms, with the value by semantic, otherwise the default; textures, all of them grey.
    addOf(reflection) {
        const {type: directional = 0} = reflection.lights?.find(({function: name}) => name === 'mx_directional_light') ?? {};
        const light = {type: [directional], direction: [-0.48, -0.6, -0.64], color: [1, 1, 1], intensity: [2]};
        for (const block of (reflection.blocks ?? []).filter(({binding}) => binding !== undefined)) {
            const view = new DataView(new ArrayBuffer(Math.ceil(block.size / 16) * 16));
            for (const {name, type, semantic, offset, matrixStride, default: given} of block.variables) {
                const values = (block.name === 'LightData' ? light[semantic ?? name] : uniforms[semantic]) ?? [given ?? 0].flat();
                const rows = type.startsWith('mat') ? Number(type[3]) : 4, set = /^(float|vec|mat)/.test(type) ? 'setFloat32' : 'setInt32';
                values.forEach((value, i) => view[set](offset + Math.floor(i / rows) * (matrixStride ?? 0) + 4 * (i % rows), value, true));
            }
            this.add(block.set, block.binding, {buffer: {}}, {buffer: make(view.buffer, GPUBufferUsage.UNIFORM)});
        }
        for (const {set, binding, samplerBinding} of variablesOf(reflection, 'Textures')) {
            const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST;
            const texture = device.createTexture({size: [1, 1], format: 'rgba8unorm', usage});
            device.queue.writeTexture({texture}, new Uint8Array([128, 128, 128, 255]), {}, [1, 1]);
            this.add(set, binding, {texture: {}}, texture.createView());
            this.add(set, samplerBinding, {sampler: {}}, device.createSampler({addressModeU: 'repeat', magFilter: 'linear', minFilter: 'linear'}));
        }
    }
    layouts() {
        return this.made ??= Array.from(this.sets, (list) => device.createBindGroupLayout({entries: (list ?? []).map(({layout}) => layout)}));
    }
    layout() { return device.createPipelineLayout({bindGroupLayouts: this.layouts()}); }
    bind(pass) {
        this.layouts().forEach((layout, i) =>
            pass.setBindGroup(i, device.createBindGroup({layout, entries: (this.sets[i] ?? []).map(({group}) => group)})));
    }
}

const streamsOf = (reflection) =>
    variablesOf(reflection, 'AppData').map(({semantic, type, location}) => ({location, width: Number(type[3]) || 1, semantic}));
// The vertex buffers of a pipeline, one for each attribute.
export const buffersOf = (reflection) => streamsOf(reflection).map(({location, width}) =>
    ({arrayStride: 4 * width, attributes: [{shaderLocation: location, offset: 0, format: width > 1 ? `float32x${width}` : 'float32'}]}));

export function drawBall(pass, pipeline, bindings, reflection) {
    pass.setPipeline(pipeline);
    bindings.bind(pass);
    streamsOf(reflection).forEach(({semantic, width}, i) => {
        const values = vertices.flatMap((vertex) => vertex[semantic] ?? Array(width).fill(0));
        pass.setVertexBuffer(i, make(new Float32Array(values), GPUBufferUsage.VERTEX));
    });
    pass.setIndexBuffer(make(new Uint32Array(indices), GPUBufferUsage.INDEX), 'uint32');
    pass.drawIndexed(indices.length);
    pass.end();
}

// Submits the commands and writes the target, of the format rgba8unorm-srgb, as a PPM file.
export async function save(encoder, target, path) {
    const pixels = device.createBuffer({size: 4 * size * size, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ});
    encoder.copyTextureToBuffer({texture: target}, {buffer: pixels, bytesPerRow: 4 * size}, [size, size]);
    device.queue.submit([encoder.finish()]);
    await pixels.mapAsync(GPUMapMode.READ);
    const bytes = new Uint8Array(pixels.getMappedRange()).filter((_, i) => i % 4 < 3); // without alpha
    writeFileSync(path, Buffer.concat([Buffer.from(`P6 ${size} ${size} 255\n`), bytes]));
    device.destroy();
}
