// SPDX-License-Identifier: Apache-2.0
// The last step of a picture: it averages the samples of each pixel over a grey background, maps tones, and encodes sRGB (IEC 61966-2-1).
// render/picture.c is the same in C, without tones.

import { link } from "./programs.js";

const VERTEX = `#version 300 es
void main()
{
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = vec4(corner * 4.0 - 1.0, 0.0, 1.0);
}`;
const PIXEL = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D u_samples;
uniform int u_oversampling; // 0: the picture is coarse
uniform vec2 u_extent;
uniform vec2 u_first;
uniform float u_backdrop;
out vec4 color;
TONE
void main()
{
    ivec2 first = ivec2(gl_FragCoord.xy) * u_oversampling;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < u_oversampling; ++y)
        for (int x = 0; x < u_oversampling; ++x)
            sum += texelFetch(u_samples, first + ivec2(x, y), 0);
    sum = u_oversampling > 0 ? sum / float(u_oversampling * u_oversampling) : textureLod(u_samples, gl_FragCoord.xy / u_extent, 0.0);
    float behind = 0.06 + 0.12 * (gl_FragCoord.y + u_first.y + 0.5) / u_extent.y, alpha = min(sum.a, 1.0);
    float shown = mix(alpha, 1.0, u_backdrop);
    vec3 linear = clamp(tone((0.6 * sum.rgb + u_backdrop * (1.0 - alpha) * behind) / max(shown, 1e-6)), 0.0, 1.0);
    color = vec4(mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear)), shown);
}`;

export const PLAIN = "vec3 tone(vec3 linear) { return linear; }";

export class Develop {
    #gl;
    #program;

    /** `tone` is a function of GLSL that maps tones, `vec3 tone(vec3 linear)`. */
    constructor(gl, tone = PLAIN) {
        this.#gl = gl;
        this.#program = link(gl, VERTEX, PIXEL.replace("TONE", tone));
    }

    finish() {
        this.#gl.deleteProgram(this.#program);
    }

    /**
     * Draws pixels to what is bound. `extent` is the size of the whole picture, `first` where the lower left pixel is in it. A transparent
     * picture has no background; its colours are not multiplied by alpha.
     */
    draw(samples, oversampling, extent, { first = [0, 0], isTransparent = false } = {}) {
        const gl = this.#gl, at = name => gl.getUniformLocation(this.#program, name);
        for (const name of [gl.DEPTH_TEST, gl.BLEND, gl.SCISSOR_TEST])
            gl.disable(name);
        gl.useProgram(this.#program);
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D, samples);
        gl.bindSampler(0, null);
        gl.uniform1i(at("u_samples"), 0);
        gl.uniform1i(at("u_oversampling"), oversampling);
        gl.uniform2f(at("u_extent"), ...extent);
        gl.uniform2f(at("u_first"), ...first);
        gl.uniform1f(at("u_backdrop"), isTransparent ? 0 : 1);
        gl.bindVertexArray(null);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
}
