// SPDX-License-Identifier: Apache-2.0
// Both stages of a material: the function that mxgen generates (docs/hosts.md), among the chunks of three, which move the vertices and have
// the lights, shadows, environment, fog and tone mapping.

import { ShaderChunk } from "three";

import { hostOf } from "./following.js";

const chunks = names => names.split(" ").map(name => `#include <${name}>`).join("\n");

// Names of the host that the function reads, in GLSL. v_toWorld is in place of three's modelMatrix, which knows no instances.
const HOST = hostOf({
    // An orthographic camera sees from afar.
    viewPosition: "(isOrthographic ? v_position + 1e5 * vec3(viewMatrix[0].z, viewMatrix[1].z, viewMatrix[2].z) : cameraPosition)",
    viewDirection: "(-vec3(viewMatrix[0].z, viewMatrix[1].z, viewMatrix[2].z))",
    matrices: {
        world: "v_toWorld", view: "viewMatrix", projection: "projectionMatrix", worldView: "(viewMatrix * v_toWorld)",
        viewProjection: "(projectionMatrix * viewMatrix)", worldViewProjection: "(projectionMatrix * viewMatrix * v_toWorld)",
    },
    inverse: matrix => `inverse(${matrix})`, transpose: matrix => `transpose(${matrix})`,
});

// The parameters of the function that every geometry has.
export const PARAMETERS = {
    "position:world": "v_position", "position:object": "v_positionObject", "normal:world": "N", "normal:object": "v_normalObject",
    "tangent:world": "frame[0]", "bitangent:world": "frame[1]", "tangent:object": "inverse(mat3(v_toWorld)) * frame[0]",
    "bitangent:object": "inverse(mat3(v_toWorld)) * frame[1]", "texcoord:0": "v_uv", "color:0": "v_color",
};

// Several variables can read one attribute, as different types. What three declares has its own type.
const DECLARED = { position: "vec4(position, 1.0)", normal: "vec4(normal, 0.0)", uv: "vec4(uv, 0.0, 1.0)", uv1: "vec4(uv1, 0.0, 1.0)",
                   uv2: "vec4(uv2, 0.0, 1.0)", uv3: "vec4(uv3, 0.0, 1.0)" };
const PARTS = { float: ".x", vec2: ".xy", vec3: ".xyz", vec4: "" };

function declarationsOf(attributes) {
    const types = new Map(attributes.filter(({ name }) => !(name in DECLARED)).map(({ name, variable: { type } }) => [name, type in PARTS ? "vec4" : type]));
    return Array.from(types, ([name, type]) => `attribute ${type} ${name};\n`).join("");
}

const VARYINGS = `
varying vec3 vViewPosition;
varying vec3 v_position;
varying vec3 v_positionObject;
varying vec3 v_normal;
varying vec3 v_normalObject;
varying vec4 v_tangent;
varying vec2 v_uv;
varying vec4 v_color;
flat varying mat4 v_toWorld;
`;

const varyingOf = ({ variable: { name, type, flat } }) => `${flat ? "flat " : ""}varying ${type} v_${name};\n`;

function vertexShader(attributes) {
    return `${VARYINGS}${attributes.map(varyingOf).join("")}${declarationsOf(attributes)}
${chunks("common batching_pars_vertex color_pars_vertex fog_pars_vertex morphtarget_pars_vertex skinning_pars_vertex shadowmap_pars_vertex "
       + "logdepthbuf_pars_vertex clipping_planes_pars_vertex")}
void main()
{
    ${chunks("color_vertex morphinstance_vertex morphcolor_vertex batching_vertex beginnormal_vertex morphnormal_vertex skinbase_vertex "
           + "skinnormal_vertex defaultnormal_vertex begin_vertex morphtarget_vertex skinning_vertex project_vertex logdepthbuf_vertex "
           + "clipping_planes_vertex")}
    vViewPosition = -mvPosition.xyz;
    ${chunks("worldpos_vertex shadowmap_vertex fog_vertex")}
    v_toWorld = modelMatrix;
#ifdef USE_INSTANCING
    v_toWorld *= instanceMatrix;
#endif
#ifdef USE_BATCHING
    v_toWorld *= batchingMatrix;
#endif
    v_position = (v_toWorld * vec4(transformed, 1.0)).xyz;
    v_positionObject = transformed;
    v_normal = normalize((vec4(transformedNormal, 0.0) * viewMatrix).xyz);
    v_normalObject = objectNormal;
    v_uv = uv;
    v_color = vec4(1.0);
#if defined(USE_COLOR) || defined(USE_COLOR_ALPHA) || defined(USE_INSTANCING_COLOR) || defined(USE_BATCHING_COLOR)
    v_color = vColor;
#endif
#ifdef USE_TANGENT
    v_tangent = vec4((vec4(transformedTangent, 0.0) * viewMatrix).xyz, tangent.w);
#endif
    ${attributes.map(({ name, variable }) => `v_${variable.name} = ${DECLARED[name] ?? name}${PARTS[variable.type] ?? ""};`).join("\n    ")}
}
`;
}

// RE_Direct is what three's loops over the lights call for each light.
const LIGHTS = () => `
vec3 lightDirections[${["SUN", "DIR", "POINT", "SPOT"].map(kind => `NUM_${kind}_LIGHTS`).filter(name => ShaderChunk.lights_pars_begin.includes(name)).join(" + ")} + 1];
vec3 lightColors[lightDirections.length()];
int numLights = 0;

#define RE_Direct(light, position, normal, view, coat, material, sum) \\
    lightDirections[numLights] = (vec4(light.direction, 0.0) * viewMatrix).xyz; \\
    lightColors[numLights++] = light.color
void gatherLights()
{
    vec3 normal = vec3(0.0);
    ${chunks("lights_fragment_begin")}
}
#undef RE_Direct

int mxg_light_count()
{
    return numLights;
}

// three's shadows and distances are those of the point that is drawn.
void mxg_light(int i, vec3 P, out vec3 L, out vec3 radiance)
{
    L = lightDirections[i];
    radiance = lightColors[i];
}

#define RE_IndirectDiffuse
vec3 mxg_irradiance(vec3 P, vec3 N)
{
    vec3 normal = (viewMatrix * vec4(N, 0.0)).xyz;
    ${chunks("lights_fragment_begin")}
#ifdef USE_ENVMAP
    irradiance += getIBLIrradiance(normal);
#endif
    return irradiance * RECIPROCAL_PI;
}
#undef RE_IndirectDiffuse

// three bends rough reflections towards the normal, which lies between L and the eye, unless L went through the surface.
vec3 mxg_radiance(vec3 P, vec3 L, float roughness)
{
#ifdef USE_ENVMAP
    vec3 direction = (viewMatrix * vec4(L, 0.0)).xyz, normal = (viewMatrix * vec4(v_normal, 0.0)).xyz;
    vec3 eye = isOrthographic ? vec3(0.0, 0.0, 1.0) : normalize(vViewPosition);
    if (dot(normal, direction) * dot(normal, eye) > 0.0)
        return getIBLRadiance(eye, normalize(direction + eye), roughness);
    return getIBLRadiance(direction, direction, roughness);
#else
    return vec3(0.0);
#endif
}
`;

// Without tangents of the geometry: the derivatives of the position by u and v, from those by x and y of the screen (Cramer's rule).
const FRAME = `
mat2x3 frameOf(vec3 N)
{
#ifdef USE_TANGENT
    vec3 T = normalize(v_tangent.xyz);
    return mat2x3(T, cross(N, T) * (v_tangent.w < 0.0 ? -1.0 : 1.0));
#else
    vec3 Px = dFdx(v_position), Py = dFdy(v_position);
    vec2 x = dFdx(v_uv), y = dFdy(v_uv);
    float determinant = x.x * y.y - x.y * y.x;
    vec3 T = (Px * y.y - Py * x.y) * sign(determinant), B = (Py * x.x - Px * y.x) * sign(determinant);
    T -= N * dot(N, T);
    if (dot(T, T) == 0.0)
        T = cross(abs(N.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), N);
    T = normalize(T);
    vec3 across = cross(N, T);
    return mat2x3(T, dot(across, B) < 0.0 ? -across : across);
#endif
}
`;

function fragmentShader(shader, attributes) {
    const { function: surface, functionType } = shader.info;
    const parameters = shader.variables.filter(({ block }) => block === "vertexData").map(({ name, semantic }) => PARAMETERS[semantic] ?? `v_${name}`);
    return `${VARYINGS}${attributes.map(varyingOf).join("")}
uniform mat4 projectionMatrix;
${Object.entries(HOST).map(([name, text]) => `#define host_${name} ${text}`).join("\n")}
${shader.pixel}
${chunks("common dithering_pars_fragment" + (ShaderChunk.cube_uv_reflection_fragment ? " cube_uv_reflection_fragment" : ""))}
${chunks("envmap_common_pars_fragment envmap_physical_pars_fragment fog_pars_fragment lights_pars_begin shadowmap_pars_fragment "
       + "logdepthbuf_pars_fragment clipping_planes_pars_fragment")}
${LIGHTS()}${FRAME}
void main()
{
    ${chunks("clipping_planes_fragment logdepthbuf_fragment")}
#ifdef FLAT_SHADED
    vec3 N = normalize(cross(dFdx(v_position), dFdy(v_position)));
#else
    vec3 N = normalize(v_normal);
#endif
    mat2x3 frame = frameOf(N);
    gatherLights();
    ${functionType} shaded = ${surface}(${parameters.join(", ")});
    // The colour is premultiplied; three maps and encodes colours that are not. Light beyond what is covered covers as much as it is bright.
    float covered = clamp(max(shaded.alpha, max(shaded.color.r, max(shaded.color.g, shaded.color.b))), 1e-6, 1.0);
    gl_FragColor = vec4(shaded.color / covered, shaded.alpha);
    ${chunks("tonemapping_fragment colorspace_fragment")}
    gl_FragColor.rgb *= covered;
    #define fogColor (fogColor * gl_FragColor.a)
    ${chunks("fog_fragment dithering_fragment")}
}
`;
}

/** The stages for three, which adds its own prefix. */
export function stagesOf(shader, attributes) {
    return { vertexShader: vertexShader(attributes), fragmentShader: fragmentShader(shader, attributes) };
}
