// SPDX-License-Identifier: Apache-2.0
// A ball in WebGPU: the reflection alone says what a GPUBindGroupLayout, the buffers and the attributes need.
//     mxgen marble.mtlx --target wgsl --reflect -o out && MXGEN_DAWN=node_modules/webgpu/index.js node webgpu.mjs out/Marble ball.ppm
import {Bindings, buffersOf, device, drawBall, moduleOf, read, save, size} from './webgpu_host.mjs';

const [stem, picture] = process.argv.slice(2), format = 'rgba8unorm-srgb';
const reflection = JSON.parse(read(`${stem}.json`)), bindings = new Bindings(GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT);
bindings.addOf(reflection);
const pipeline = device.createRenderPipeline({
    layout: bindings.layout(),
    vertex: {module: moduleOf(`${stem}.vert.wgsl`), buffers: buffersOf(reflection)},
    fragment: {module: moduleOf(`${stem}.frag.wgsl`), targets: [{format}]},
    primitive: {cullMode: 'back'}
});
const target = device.createTexture({size: [size, size], format, usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC});
const encoder = device.createCommandEncoder();
const pass = encoder.beginRenderPass({colorAttachments: [{view: target.createView(), loadOp: 'clear', storeOp: 'store'}]});
drawBall(pass, pipeline, bindings, reflection);
await save(encoder, target, picture);
