// SPDX-License-Identifier: Apache-2.0
// A ball in WebGPU: the reflection alone says what a GPUBindGroupLayout, the buffers and the attributes need.
//     mxgen marble.mtlx --target wgsl --reflect -o out && MXGEN_DAWN=node_modules/webgpu/index.js node webgpu.mjs out/Marble ball.ppm
// In a browser the device is that of navigator.gpu, and the target a canvas.
import {readFileSync, writeFileSync} from 'node:fs';
import {pathToFileURL} from 'node:url';

const [stem, picture] = process.argv.slice(2), size = 256, rings = 64, eye = [0, 0, 4];
const {create, globals} = await import(pathToFileURL(process.env.MXGEN_DAWN));
Object.assign(globalThis, globals);
const gpu = globalThis.gpu = create(['backend=vulkan']); // lives as long as its device
const device = await (await gpu.requestAdapter()).requestDevice();
const read = (ending) => readFileSync(`${stem}.${ending}`, 'utf8');
const {blocks, lights} = JSON.parse(read('json'));
const variablesOf = (name) => blocks.find((block) => block.name === name)?.variables ?? [];
const make = (data, usage) => {
    const buffer = device.createBuffer({size: data.byteLength, usage: usage | GPUBufferUsage.COPY_DST});
    device.queue.writeBuffer(buffer, 0, data);
    return buffer;
};

// What the host has: matrices by column, a light, grey surroundings, a ball.
const near = 1, far = 10, a = far / (near - far), b = near * a, zoom = 3.5;
const uniforms = {
    viewPosition: eye, numActiveLightSources: [1],
    viewProjectionMatrix: [zoom, 0, 0, 0, 0, zoom, 0, 0, 0, 0, a, -1, 0, 0, b - a * eye[2], eye[2]]
};
const {type: directional = 0} = lights?.find(({function: name}) => name === 'mx_directional_light') ?? {};
const light = {type: [directional], direction: [-0.5, -0.6, -0.6], color: [1, 1, 1], intensity: [2]};
const vertices = Array.from({length: 2 * rings * (rings + 1)}, (_, i) => {
    const u = i % (2 * rings) / (2 * rings - 1), v = Math.floor(i / (2 * rings)) / rings;
    const r = Math.sin(Math.PI * v), angle = 2 * Math.PI * u;
    const at = [r * Math.sin(angle), -Math.cos(Math.PI * v), r * Math.cos(angle)];
    return {'position:object': at, 'normal:object': at, 'tangent:object': [Math.cos(angle), 0, -Math.sin(angle)], 'texcoord:0': [u, v]};
});
const indices = vertices.slice(2 * rings + 1).flatMap((_, i) => [i, i + 1, i + 2 * rings, i + 1, i + 2 * rings + 1, i + 2 * rings]);

// Blocks of uniforms: the value by semantic, otherwise the default.
const entries = [], visibility = GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT;
const add = (set, binding, layout, resource) =>
    (entries[set] ??= []).push({layout: {binding, visibility, ...layout}, group: {binding, resource}});
for (const block of blocks.filter(({binding}) => binding !== undefined)) {
    const view = new DataView(new ArrayBuffer(Math.ceil(block.size / 16) * 16));
    for (const {name, type, semantic, offset, matrixStride, default: given} of block.variables) {
        const values = (block.name === 'LightData' ? light[semantic ?? name] : uniforms[semantic]) ?? [given ?? 0].flat();
        const rows = type.startsWith('mat') ? Number(type[3]) : 4, set = /^(float|vec|mat)/.test(type) ? 'setFloat32' : 'setInt32';
        values.forEach((value, i) => view[set](offset + Math.floor(i / rows) * (matrixStride ?? 0) + 4 * (i % rows), value, true));
    }
    add(block.set, block.binding, {buffer: {}}, {buffer: make(view.buffer, GPUBufferUsage.UNIFORM)});
}
for (const {set, binding, samplerBinding} of variablesOf('Textures')) { // all of them grey
    const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST;
    const texture = device.createTexture({size: [1, 1], format: 'rgba8unorm', usage});
    device.queue.writeTexture({texture}, new Uint8Array([128, 128, 128, 255]), {}, [1, 1]);
    add(set, binding, {texture: {}}, texture.createView());
    add(set, samplerBinding, {sampler: {}}, device.createSampler({addressModeU: 'repeat', magFilter: 'linear', minFilter: 'linear'}));
}

const sets = Array.from(entries, (list) => list ?? []);
const layouts = sets.map((list) => device.createBindGroupLayout({entries: list.map(({layout}) => layout)}));
const streams = variablesOf('AppData').map(({semantic, type, location}) => ({location, width: Number(type[3]) || 1, semantic}));
const buffers = streams.map(({location, width}) =>
    ({arrayStride: 4 * width, attributes: [{shaderLocation: location, offset: 0, format: width > 1 ? `float32x${width}` : 'float32'}]}));
const pipeline = device.createRenderPipeline({
    layout: device.createPipelineLayout({bindGroupLayouts: layouts}),
    vertex: {module: device.createShaderModule({code: read('vert.wgsl')}), buffers},
    fragment: {module: device.createShaderModule({code: read('frag.wgsl')}), targets: [{format: 'rgba8unorm-srgb'}]},
    primitive: {cullMode: 'back'}
});
const usage = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC;
const target = device.createTexture({size: [size, size], format: 'rgba8unorm-srgb', usage});
const pixels = device.createBuffer({size: 4 * size * size, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ});
const encoder = device.createCommandEncoder();
const pass = encoder.beginRenderPass({colorAttachments: [{view: target.createView(), loadOp: 'clear', storeOp: 'store'}]});
pass.setPipeline(pipeline);
sets.forEach((list, i) =>
    pass.setBindGroup(i, device.createBindGroup({layout: layouts[i], entries: list.map(({group}) => group)})));
streams.forEach(({semantic, width}, i) => {
    const values = vertices.flatMap((vertex) => vertex[semantic] ?? Array(width).fill(0));
    pass.setVertexBuffer(i, make(new Float32Array(values), GPUBufferUsage.VERTEX));
});
pass.setIndexBuffer(make(new Uint32Array(indices), GPUBufferUsage.INDEX), 'uint32');
pass.drawIndexed(indices.length);
pass.end();
encoder.copyTextureToBuffer({texture: target}, {buffer: pixels, bytesPerRow: 4 * size}, [size, size]);
device.queue.submit([encoder.finish()]);
await pixels.mapAsync(GPUMapMode.READ);
const bytes = new Uint8Array(pixels.getMappedRange()).filter((_, i) => i % 4 < 3); // without alpha
writeFileSync(picture, Buffer.concat([Buffer.from(`P6 ${size} ${size} 255\n`), bytes]));
device.destroy();
