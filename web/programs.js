// SPDX-License-Identifier: Apache-2.0
// Programs of WebGL from their sources.

/** Starts to compile; the driver may need a while. */
export function link(gl, vertex, pixel) {
    const program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, pixel]]) {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, source);
        gl.compileShader(shader);
        gl.attachShader(program, shader);
        gl.deleteShader(shader);
    }
    gl.linkProgram(program);
    return program;
}

/** Why the driver refuses a program; null: it does not. */
export function faultOf(gl, program) {
    if (gl.getProgramParameter(program, gl.LINK_STATUS) || gl.isContextLost())
        return null;
    const logs = gl.getAttachedShaders(program).map(shader => gl.getShaderInfoLog(shader)).filter(Boolean);
    return logs.join("\n") || gl.getProgramInfoLog(program) || "the driver refuses the shader";
}
