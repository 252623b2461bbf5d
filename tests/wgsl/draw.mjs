// SPDX-License-Identifier: Apache-2.0
// Draws modules of WGSL with Dawn, on the Vulkan device of SwiftShader. The argument is a file of draws, and the answers go to the
// standard output: tests/conformance/draws.h says their form.
//
// MXGEN_DAWN names index.js of the package "webgpu". SwiftShader is the one of Debian's package "chromium", or that whose ICD file
// MXGEN_SWIFTSHADER names.
import {createReadStream, existsSync, readFileSync, writeSync} from 'node:fs';
import {createInterface} from 'node:readline';
import {pathToFileURL} from 'node:url';

const answer = value => writeSync(1, JSON.stringify(value) + '\n');
const absent = reason => {
    answer({absent: reason});
    process.exit(0);
};
const bytesOf = hex => Buffer.from(hex, 'hex');

/* ---- The device ---- */

async function openDevice() {
    const icd = process.env.MXGEN_SWIFTSHADER || '/usr/lib/chromium/vk_swiftshader_icd.json';
    if (!existsSync(icd))
        absent(`there is no ${icd}: Dawn has no device to draw with`);
    if (!existsSync(process.env.MXGEN_DAWN ?? ''))
        absent('MXGEN_DAWN does not name index.js of the package "webgpu"');
    process.env.VK_ICD_FILENAMES = icd;
    const dawn = await import(pathToFileURL(process.env.MXGEN_DAWN));
    Object.assign(globalThis, dawn.globals);
    globalThis.gpu = dawn.create(['backend=vulkan']); // Dawn crashes if it is collected before its device
    const adapter = await gpu.requestAdapter() ?? absent('Dawn finds no device');
    const {maxVertexAttributes, maxVertexBufferArrayStride} = adapter.limits;
    return adapter.requestDevice({
        requiredFeatures: ['float32-filterable', 'float32-blendable'].filter(name => adapter.features.has(name)),
        requiredLimits: {maxVertexAttributes, maxVertexBufferArrayStride}
    });
}

/* ---- Resources ---- */

const temporary = []; // what is destroyed after a draw

function forNow(resource) {
    temporary.push(resource);
    return resource;
}

function makeBuffer(device, bytes, usage) {
    const buffer = forNow(device.createBuffer({size: Math.max(Math.ceil(bytes.length / 4) * 4, 4), usage: usage | GPUBufferUsage.COPY_DST}));
    device.queue.writeBuffer(buffer, 0, bytes);
    return buffer;
}

function makeTexture(device, texture) {
    const layers = texture.layers || 1, bytes = readFileSync(texture.file);
    const made = device.createTexture({
        size: [texture.width, texture.height, layers], mipLevelCount: texture.levels, format: 'rgba32float',
        usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST
    });
    for (let level = 0, offset = 0; level < texture.levels; level++) {
        const width = Math.max(texture.width >> level, 1), height = Math.max(texture.height >> level, 1);
        device.queue.writeTexture({texture: made, mipLevel: level}, bytes, {offset, bytesPerRow: 16 * width, rowsPerImage: height}, [width, height, layers]);
        offset += 16 * width * height * layers;
    }
    return made;
}

const kept = new Map(); // textures by their files, which many draws share

function textureOf(device, texture) {
    if (!kept.has(texture.file))
        kept.set(texture.file, makeTexture(device, texture));
    return kept.get(texture.file);
}

/* ---- Bindings: a layout and a group for each set, as a host makes them from the reflection ---- */

function entriesOf(device, draw) {
    const visibility = GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT, sets = [];
    const add = (set, binding, layout, resource) =>
        (sets[set] ??= []).push({layout: {binding, visibility, ...layout}, group: {binding, resource}});
    for (const block of draw.blocks)
        add(block.set, block.binding, {buffer: {type: 'uniform'}}, {buffer: makeBuffer(device, bytesOf(block.bytes), GPUBufferUsage.UNIFORM)});
    for (const texture of draw.textures) {
        const viewDimension = texture.layers ? '2d-array' : '2d';
        const sampler = device.createSampler({
            addressModeU: texture.u, addressModeV: texture.v, magFilter: texture.filter, minFilter: texture.filter,
            mipmapFilter: 'linear', lodMaxClamp: texture.levels > 1 ? 32 : 0
        });
        add(texture.set, texture.binding, {texture: {viewDimension}}, textureOf(device, texture).createView({dimension: viewDimension}));
        add(texture.set, texture.samplerBinding, {sampler: {}}, sampler);
    }
    return Array.from(sets, entries => entries ?? []);
}

function makePipeline(device, draw, layouts) {
    const over = {srcFactor: 'one', dstFactor: 'one-minus-src-alpha'}; // colours are premultiplied
    const attributes = draw.attributes.map(({location, format}, i) => ({shaderLocation: location, format, offset: 16 * i}));
    return device.createRenderPipelineAsync({
        layout: device.createPipelineLayout({bindGroupLayouts: layouts}),
        vertex: {
            module: device.createShaderModule({code: draw.vertex}),
            buffers: attributes.length ? [{arrayStride: 16 * attributes.length, attributes}] : []
        },
        fragment: {
            module: device.createShaderModule({code: draw.pixel}),
            targets: [{format: 'rgba32float', blend: draw.blend ? {color: over, alpha: over} : undefined}]
        },
        depthStencil: {format: 'depth32float', depthCompare: 'less', depthWriteEnabled: !draw.blend}
    });
}

/* ---- Drawing ---- */

async function read(device, encoder, target, width, height) {
    const row = Math.ceil(16 * width / 256) * 256;
    const buffer = forNow(device.createBuffer({size: row * height, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ}));
    encoder.copyTextureToBuffer({texture: target}, {buffer, bytesPerRow: row}, [width, height]);
    device.queue.submit([encoder.finish()]);
    await buffer.mapAsync(GPUMapMode.READ);
    const bytes = Buffer.from(buffer.getMappedRange().slice(0));
    buffer.unmap();
    return Array.from({length: height}, (_, y) => bytes.toString('hex', y * row, y * row + 16 * width)).join('');
}

async function drawTo(device, draw) {
    const size = [draw.width, draw.height], sets = entriesOf(device, draw);
    const layouts = sets.map(entries => device.createBindGroupLayout({entries: entries.map(entry => entry.layout)}));
    const pipeline = await makePipeline(device, draw, layouts);
    const target = forNow(device.createTexture({size, format: 'rgba32float', usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC}));
    const depth = forNow(device.createTexture({size, format: 'depth32float', usage: GPUTextureUsage.RENDER_ATTACHMENT}));
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginRenderPass({
        colorAttachments: [{view: target.createView(), loadOp: 'clear', storeOp: 'store', clearValue: [0, 0, 0, 0]}],
        depthStencilAttachment: {view: depth.createView(), depthLoadOp: 'clear', depthStoreOp: 'store', depthClearValue: 1}
    });
    const indices = bytesOf(draw.indices);
    pass.setPipeline(pipeline);
    sets.forEach((entries, set) => pass.setBindGroup(set, device.createBindGroup({layout: layouts[set], entries: entries.map(entry => entry.group)})));
    if (draw.attributes.length)
        pass.setVertexBuffer(0, makeBuffer(device, bytesOf(draw.vertices), GPUBufferUsage.VERTEX));
    pass.setIndexBuffer(makeBuffer(device, indices, GPUBufferUsage.INDEX), 'uint32');
    pass.drawIndexed(indices.length / 4);
    pass.end();
    return read(device, encoder, target, ...size);
}

// WGSL lets sines be wrong by 2^-11 (section "Floating point accuracy"), and SwiftShader's are wrong by 2e-4. Turned coordinates of an
// image carry that to its values, which change by up to 5 per unit in the grid's image; a normal map doubles it.
function accuracyOf(draw) {
    const calls = functions => new RegExp(`\\b(${functions})\\(`).test(draw.vertex + draw.pixel);
    return calls('sin|cos|tan') ? calls('textureSample|textureSampleLevel|textureSampleGrad') ? 2 ** -8 : 2 ** -11 : undefined;
}

async function answerTo(device, draw) {
    device.pushErrorScope('validation');
    const outcome = await drawTo(device, draw).then(pixels => ({pixels, accuracy: accuracyOf(draw)}), error => ({error: error.message}));
    const fault = await device.popErrorScope();
    temporary.splice(0).forEach(resource => resource.destroy());
    return fault ? {error: fault.message} : outcome;
}

const device = await openDevice();
for await (const line of createInterface({input: createReadStream(process.argv[2])}))
    answer(await answerTo(device, JSON.parse(line)));
device.destroy();
