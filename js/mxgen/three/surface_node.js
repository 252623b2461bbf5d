// SPDX-License-Identifier: Apache-2.0
// The surface of a document as a node of three: the function that mxgen generates (docs/hosts.md), with the functions of the host that it calls.
// Their bodies are what three's own nodes of lights and environments make, built for other normals than that of the surface.

import { LightsNode, Node } from "three/webgpu";
import { cameraPosition, cameraProjectionMatrix, cameraViewMatrix, cameraWorldMatrix, diffuseColor, expression, Fn, inverse, lights, normalView,
         normalWorld, normalWorldGeometry, overrideNodes, positionViewDirection, positionWorld, roughness, select, transpose, vec3, wgsl, wgslFn } from "three/tsl";

import { attributesOf, hostOf } from "./following.js";
import { attributeOf, frameOf, normalObject, positionObject, toWorldOf, TYPES } from "./geometry_nodes.js";

// The parameters of the function that every geometry has.
const PARAMETERS = {
    "position:world": () => positionWorld, "position:object": () => positionObject,
    "normal:world": () => normalWorldGeometry, "normal:object": () => normalObject,
    "tangent:world": frame => frame()[0], "bitangent:world": frame => frame()[1],
    "tangent:object": (frame, builder) => frame()[0].transformDirection(inverse(toWorldOf(builder))),
    "bitangent:object": (frame, builder) => frame()[1].transformDirection(inverse(toWorldOf(builder))),
    "texcoord:0": (frame, builder) => attributeOf(builder, "uv", "vec2", [0, 0]), "color:0": () => diffuseColor,
};

const axis = z => vec3(0, 0, z).transformDirection(cameraWorldMatrix);

function hostNodes(builder) {
    const world = toWorldOf(builder), viewProjection = cameraProjectionMatrix.mul(cameraViewMatrix);
    return hostOf({
        // An orthographic camera sees from afar.
        viewPosition: builder.camera.isOrthographicCamera ? positionWorld.add(axis(1).mul(1e5)) : cameraPosition,
        viewDirection: axis(-1),
        matrices: {
            world, view: cameraViewMatrix, projection: cameraProjectionMatrix, worldView: cameraViewMatrix.mul(world), viewProjection,
            worldViewProjection: viewProjection.mul(world),
        },
        inverse, transpose,
    });
}

/** The add-ons of three draw lights in loops; the surface has a loop of its own. */
const plain = lightsNode => lightsNode.constructor === LightsNode ? lightsNode : lights(lightsNode.getLights());

// What a light adds to, where nothing asks for it.
const SINK = { addAssign() {}, mulAssign() {} };

/** Builds lights in a context of their own: by default those of the scene, with those of `materialLightings`. */
function buildLights(builder, context, nodes = null) {
    const previous = builder.addContext({ lightingModel: { direct() {}, directRectArea() {} }, reflectedLight: {}, materialLightings: [],
                                          irradiance: SINK, iblIrradiance: SINK, radiance: SINK, ambientOcclusion: SINK, ...context });
    builder.lightsNode.setupLights(builder, nodes ?? builder.lightsNode.setupLightsNode(builder));
    builder.setContext(previous);
}

/** The body of a function that returns the sum of lights, where other values stand for some of three's. `build` gets the sum. */
function bodyOf(builder, overrides, build) {
    const sum = Fn(builder => {
        const sum = vec3(0).toVar();
        build(builder, sum);
        return sum;
    })();
    const { vars, code, result } = builder.flowStagesNode(overrideNodes(overrides, sum), "vec3");
    return `${vars}${code}\n\tlet sum: vec3f = ${result};`;
}

const irradianceBody = (builder, environment) => bodyOf(builder, [[normalWorld, expression("N", "vec3")]], (builder, sum) =>
    buildLights(builder, { irradiance: sum, iblIrradiance: sum, materialLightings: environment ? [environment] : [] }));

/** three bends rough reflections towards the normal, which lies between L and the eye, unless L went through the surface. */
function radianceBody(builder, environment) {
    const toView = name => expression(name, "vec3").transformDirection(cameraViewMatrix), direction = toView("L"), normal = toView("mxg_normal");
    const eye = builder.camera.isOrthographicCamera ? vec3(0, 0, 1) : cameraPosition.sub(expression("P", "vec3")).transformDirection(cameraViewMatrix);
    const isReflected = normal.dot(direction).mul(normal.dot(eye)).greaterThan(0);
    return bodyOf(builder, [
        [positionViewDirection, select(isReflected, eye, direction)], [normalView, select(isReflected, direction.add(eye).normalize(), direction)],
        [roughness, expression("roughness", "float")],
    ], (builder, sum) => buildLights(builder, { radiance: sum }, [environment]));
}

/** The functions that the surface calls; `count` lights are gathered before. */
const hostText = (count, irradiance, radiance) => `
struct MxgLight { L: vec3f, radiance: vec3f }
var<private> mxg_lights: array<MxgLight, ${count + 1}>;
var<private> mxg_normal: vec3f;

fn mxg_light_count() -> i32
{
    return ${count};
}

// three's shadows and distances are those of the point that is drawn.
fn mxg_light(i: i32, P: vec3f, L: ptr<function, vec3f>, radiance: ptr<function, vec3f>)
{
    *L = mxg_lights[i].L;
    *radiance = mxg_lights[i].radiance;
}

fn mxg_irradiance(P: vec3f, N: vec3f) -> vec3f
{
    ${irradiance}
    return sum / 3.14159265;
}

fn mxg_radiance(P: vec3f, L: vec3f, roughness: f32) -> vec3f
{
    ${radiance}
    return sum;
}
`;

export class SurfaceNode extends Node {
    static get type() {
        return "MaterialXSurfaceNode";
    }

    /** Uniforms by their names. */
    constructor(shader, uniforms) {
        super("vec4");
        this.uniforms = uniforms;
        this._source = shader.pixel.replace(/^@group.*\n/gm, ""); // three declares what is bound
        this._info = shader.info;
        this._attributes = attributesOf(shader, PARAMETERS);
        this._variables = shader.variables.filter(({ block }) => block === "vertexData");
    }

    /** Does it read the matrix from object space to the world? */
    get readsWorld() {
        return /\bhost_world/.test(this._source) || this._variables.some(({ semantic }) => /tangent:object/.test(semantic));
    }

    setup(builder) {
        if (!builder.renderer.backend.isWebGPUBackend)
            throw new Error("MaterialXNodeMaterial needs WebGPU, but WebGPURenderer draws by WebGL 2 here; for WebGLRenderer there is MaterialXMaterial of mxgen/three");
        const { lightsNode, material } = builder, environment = material.setupEnvironment(builder), direct = [];
        builder.lightsNode = plain(material.lightsNode ?? lightsNode);
        buildLights(builder, { lightingModel: {
            direct({ lightDirection, lightColor }) {
                direct.push([lightDirection.transformDirection(cameraWorldMatrix), lightColor]);
            },
            directRectArea({ lightNode }) {
                console.warn(`MaterialXNodeMaterial: area lights have no effect (${lightNode.light.name || "RectAreaLight"})`);
            },
        } });
        const host = hostText(direct.length, irradianceBody(builder, environment), environment ? radianceBody(builder, environment) : "let sum = vec3f(0.0);");
        builder.lightsNode = lightsNode;
        const parameters = this.#parameters(builder), read = Object.entries(hostNodes(builder)).filter(([name]) => this._source.includes(`host_${name}`));
        const all = [
            ...parameters.map((node, i) => [`p_${i}`, this._variables[i].type, node]),
            ...direct.flatMap(([L, radiance], i) => [[`L_${i}`, "vec3f", L], [`E_${i}`, "vec3f", radiance]]),
            ...read.map(([name, node]) => [`h_${name}`, name.endsWith("Matrix") ? "mat4x4f" : "vec3f", node]), ["N", "vec3f", normalWorldGeometry],
        ];
        const globals = read.map(([name]) => `var<private> host_${name}: ${name.endsWith("Matrix") ? "mat4x4f" : "vec3f"};\n`).join("");
        const shade = wgslFn(`fn mxg_shade(${all.map(([name, type]) => `${name}: ${type}`).join(", ")}) -> vec4f
{
    ${direct.map((_, i) => `mxg_lights[${i}] = MxgLight(L_${i}, E_${i});\n`).join("")}
    ${read.map(([name]) => `host_${name} = h_${name};\n`).join("")}
    mxg_normal = N;
    let shaded = ${this._info.function}(${parameters.map((_, i) => `p_${i}`).join(", ")});
    return vec4f(shaded.color, shaded.alpha);
}`, [wgsl(globals + this.#named(builder) + host)]);
        return shade(...all.map(([, , node]) => node));
    }

    #parameters(builder) {
        let frame;
        const given = () => frame ??= frameOf(builder);
        return this._variables.map(({ semantic, ...variable }) => {
            if (semantic in PARAMETERS)
                return PARAMETERS[semantic](given, builder);
            const { name } = this._attributes.find(attribute => attribute.variable.name === variable.name);
            return attributeOf(builder, name, TYPES[variable.type], variable.values, variable.flat);
        });
    }

    /** The source with three's names of uniforms and textures. */
    #named(builder) {
        const names = Object.fromEntries(Object.entries(this.uniforms).map(([name, node]) => [name, builder.flowStagesNode(node, "property").result]));
        return this._source.replace(/\bu_(?:pub|prv)\.(\w+)/g, (_, name) => names[name]).replace(/\bt_\d+(?=_sampler\b|\b)/g, name => names[name]);
    }
}
