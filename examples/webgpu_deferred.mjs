// SPDX-License-Identifier: Apache-2.0
// The ball of webgpu.mjs through the deferred pipeline: a depth pass, a material pass, the passes that belong to no material.
//     mxgen deferred.mtlx -e Lacquered --role deferred --target wgsl --reflect -o out && mxgen pipeline passes --target wgsl
//     MXGEN_DAWN=node_modules/webgpu/index.js node webgpu_deferred.mjs out/Lacquered passes ball.ppm
import {a, b, Bindings, buffersOf, device, distance, drawBall, make, moduleOf, read, save, size, zoom} from './webgpu_host.mjs';

const [stem, folder, picture] = process.argv.slice(2), tiles = Math.ceil(size / 8);
const material = JSON.parse(read(`${stem}.json`));
const passes = ['classify', 'compose', 'light_simple', 'light_single', 'light_complex', 'light_special'].map((name) =>
    ({reflection: JSON.parse(read(`${folder}/${name}.json`)), module: moduleOf(`${folder}/${name}.comp.wgsl`)}));
if (passes.some(({reflection}) => reflection.deferred.layout !== material.deferred.layout))
    throw Error('the material and the passes have different layouts of the storage');

// Images and buffers that materials and passes share, by name.
const formats = {r32ui: 'r32uint', rgba16f: 'rgba16float'}, ofSamplers = {depth: 'depth32float', color: 'rgba16float'};
const {TEXTURE_BINDING, STORAGE_BINDING, RENDER_ATTACHMENT, COPY_SRC} = GPUTextureUsage;
const images = {}, buffers = {};
function imageOf({name, kind, format, layers}) {
    const depth = kind !== 'image2DArray' ? 1 : layers ?? Math.max(material.deferred.words - 3, 1);
    const usage = TEXTURE_BINDING | RENDER_ATTACHMENT | (format ? STORAGE_BINDING : 0);
    images[name] ??= device.createTexture({size: [size, size, depth], format: ofSamplers[name] ?? formats[format], usage});
    return images[name].createView({dimension: kind === 'image2DArray' ? '2d-array' : '2d'});
}

// (x, y, depth, 1) in pixels to the world: the inverse of the camera, y downwards.
const toWorld = [2 / size / zoom, 0, 0, 0, 0, -2 / size / zoom, 0, 0, 0, 0, distance / b, 1 / b, -1 / zoom, 1 / zoom, a * distance / b - 1, a / b];
const ofFrame = {mx_to_world: toWorld, mx_size: [size, size], mx_tiles_per_row: [tiles], mx_num_tiles: [tiles * tiles], mx_show: [0]};
function bufferOf({name, size: bytes, members}) {
    if (name === 'tiles')
        return buffers[name] ??= make(new Uint32Array(bytes / 4 + 5 * tiles * tiles).fill(0).map((_, i) => Number(i < 20 && (i % 4 === 1 || i % 4 === 2))),
                                      GPUBufferUsage.STORAGE | GPUBufferUsage.INDIRECT);
    const view = new DataView(new ArrayBuffer(bytes));
    for (const {name: member, type, offset} of members)
        ofFrame[member].forEach((value, i) => view[type.startsWith('u') ? 'setUint32' : 'setFloat32'](offset + 4 * i, value, true));
    return buffers[name] ??= make(view.buffer, GPUBufferUsage.UNIFORM);
}

// How a resource of the reflection is bound (docs/deferred.md).
function addResources(bindings, {deferred: {resources}}) {
    for (const resource of resources) {
        const {kind, format, access, set, binding} = resource, viewDimension = kind === 'image2DArray' ? '2d-array' : '2d';
        const sampleType = format === 'r32ui' ? 'uint' : 'unfilterable-float';
        if (kind === 'buffer' || kind === 'uniform')
            bindings.add(set, binding, {buffer: {type: kind === 'uniform' ? kind : access === 'read' ? 'read-only-storage' : 'storage'}},
                         {buffer: bufferOf(resource)});
        else if (access === 'read')
            bindings.add(set, binding, {texture: {sampleType, viewDimension}}, imageOf(resource));
        else
            bindings.add(set, binding, {visibility: bindings.visibility & ~GPUShaderStage.VERTEX,
                                        storageTexture: {access: `${access}-only`, format: formats[format], viewDimension}}, imageOf(resource));
    }
}

// ---- The depth pass and the material pass ----

const stages = GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT, encoder = device.createCommandEncoder();
const ofDepth = new Bindings(stages), ofMaterial = new Bindings(stages), targets = material.deferred.targets;
[ofDepth, ofMaterial].forEach((bindings) => bindings.addOf(material));
addResources(ofMaterial, material);
const view = imageOf({name: 'depth', kind: 'sampler2D'}), {depth: format} = ofSamplers;
const vertex = {module: moduleOf(`${stem}.vert.wgsl`), buffers: buffersOf(material)};
const toDepth = device.createRenderPipeline({
    layout: ofDepth.layout(), vertex, depthStencil: {format, depthCompare: 'less', depthWriteEnabled: true}
});
const toWords = device.createRenderPipeline({
    layout: ofMaterial.layout(), vertex, depthStencil: {format, depthCompare: 'equal', depthWriteEnabled: false},
    fragment: {module: moduleOf(`${stem}.frag.wgsl`), targets: targets.map((target) => ({format: ofSamplers[target.name] ?? formats[target.format]}))}
});
drawBall(encoder.beginRenderPass({
    colorAttachments: [], depthStencilAttachment: {view, depthLoadOp: 'clear', depthClearValue: 1, depthStoreOp: 'store'}
}), toDepth, ofDepth, material);
drawBall(encoder.beginRenderPass({
    colorAttachments: targets.map((target) => ({view: imageOf({kind: 'image2D', ...target}), loadOp: 'clear', storeOp: 'store'})),
    depthStencilAttachment: {view, depthReadOnly: true}
}), toWords, ofMaterial, material);

// ---- The passes that belong to no material ----

for (const {reflection, module} of passes) {
    const bindings = new Bindings(GPUShaderStage.COMPUTE), {groupSize, dispatchOffset} = reflection.deferred;
    bindings.addOf(reflection);
    addResources(bindings, reflection);
    const pass = encoder.beginComputePass();
    pass.setPipeline(device.createComputePipeline({layout: bindings.layout(), compute: {module}}));
    bindings.bind(pass);
    if (dispatchOffset === undefined)
        pass.dispatchWorkgroups(Math.ceil(size / groupSize[0]), Math.ceil(size / groupSize[1]));
    else
        pass.dispatchWorkgroupsIndirect(buffers.tiles, dispatchOffset);
    pass.end();
}

// ---- The picture, as a display has it ----

const shown = device.createShaderModule({code: `
@group(0) @binding(0) var lit: texture_2d<f32>;
@vertex fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f { return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i & 2u) * 2.0 - 1.0, 0.0, 1.0); }
@fragment fn shown(@builtin(position) at: vec4f) -> @location(0) vec4f { return textureLoad(lit, vec2i(at.xy), 0); }`});
const display = new Bindings(GPUShaderStage.FRAGMENT), screen = 'rgba8unorm-srgb';
display.add(0, 0, {texture: {sampleType: 'unfilterable-float'}}, images.lit.createView());
const target = device.createTexture({size: [size, size], format: screen, usage: RENDER_ATTACHMENT | COPY_SRC});
const pass = encoder.beginRenderPass({colorAttachments: [{view: target.createView(), loadOp: 'clear', storeOp: 'store'}]});
pass.setPipeline(device.createRenderPipeline({layout: display.layout(), vertex: {module: shown}, fragment: {module: shown, targets: [{format: screen}]}}));
display.bind(pass);
pass.draw(3);
pass.end();
await save(encoder, target, picture);
