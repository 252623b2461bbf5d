// SPDX-License-Identifier: Apache-2.0
// The text around a surface, in the languages of three's backends: WGSL for WebGPU, GLSL for WebGL 2. Types are named as in GLSL; parameters are
// [type, name].

import { glsl, glslFn, wgsl, wgslFn } from "three/tsl";

const WGSL_TYPES = { float: "f32", int: "i32", vec2: "vec2f", vec3: "vec3f", vec4: "vec4f", mat4: "mat4x4f" };

const WGSL = {
    target: "wgsl", code: wgsl, native: wgslFn, bound: /^@group.*\n/gm,
    named: (source, names) => source.replace(/\bu_(?:pub|prv)\.(\w+)/g, (_, name) => names[name]).replace(/\bt_\d+(?=_sampler\b|\b)/g, name => names[name]),
    type: name => WGSL_TYPES[name],
    global: (type, name, count) => `var<private> ${name}: ${count ? `array<${WGSL_TYPES[type]}, ${count}>` : WGSL_TYPES[type]};\n`,
    signature: (type, name, parameters) => `fn ${name}(${parameters.map(([type, name]) => `${name}: ${WGSL_TYPES[type]}`).join(", ")}) -> ${WGSL_TYPES[type]}`,
    light: "fn mxg_light(i: i32, P: vec3f, L: ptr<function, vec3f>, radiance: ptr<function, vec3f>)",
    pointee: name => `*${name}`, local: (type, name) => `let ${name}`,
};

const GLSL = {
    target: "essl", code: glsl, native: glslFn, bound: /^uniform .*\n/gm,
    // three keeps what is true or false in integers.
    named: (source, names, flags) => source.replace(/\b[ut]_\w+/g, name => flags.has(name) ? `bool(${names[name]})` : names[name] ?? name),
    type: name => name,
    global: (type, name, count) => `${type} ${name}${count ? `[${count}]` : ""};\n`,
    signature: (type, name, parameters) => `${type} ${name}(${parameters.map(([type, name]) => `${type} ${name}`).join(", ")})`,
    light: "void mxg_light(int i, vec3 P, out vec3 L, out vec3 radiance)",
    pointee: name => name, local: (type, name) => `${type} ${name}`,
};

export const languageOf = builder => builder.renderer.backend.isWebGPUBackend ? WGSL : GLSL;

/** The functions of the host (docs/hosts.md); `count` lights are gathered before. */
export const hostText = ({ global, signature, light, pointee }, count, irradiance, radiance) => `
${global("vec3", "mxg_directions", count + 1)}${global("vec3", "mxg_radiances", count + 1)}${global("vec3", "mxg_normal")}
${signature("int", "mxg_light_count", [])}
{
    return ${count};
}

// three's shadows and distances are those of the point that is drawn.
${light}
{
    ${pointee("L")} = mxg_directions[i];
    ${pointee("radiance")} = mxg_radiances[i];
}

${signature("vec3", "mxg_irradiance", [["vec3", "P"], ["vec3", "N"]])}
{${irradiance}
}

${signature("vec3", "mxg_radiance", [["vec3", "P"], ["vec3", "L"], ["float", "roughness"]])}
{${radiance}
}
`;

/** The function that three calls. It writes parameters to variables, [type, name, variable], and hands the others to the surface. */
export const shadeText = ({ signature, local, type }, info, parameters) => `${signature("vec4", "mxg_shade", parameters)}
{
${parameters.map(([, name, variable]) => variable ? `    ${variable} = ${name};\n` : "").join("")}
    ${local(info.functionType, "shaded")} = ${info.function}(${parameters.filter(([, , variable]) => !variable).map(([, name]) => name).join(", ")});
    return ${type("vec4")}(shaded.color, shaded.alpha);
}`;
