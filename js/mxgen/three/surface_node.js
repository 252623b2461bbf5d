// SPDX-License-Identifier: Apache-2.0
// The surface of a document as a node of three: the function that mxgen generates (docs/hosts.md), with the functions of the host that it calls.
// Their bodies are what three's own nodes of lights and environments make, built for other normals than that of the surface.

import { LightsNode, Node } from "three/webgpu";
import { cameraPosition, cameraProjectionMatrix, cameraViewMatrix, cameraWorldMatrix, diffuseColor, expression, Fn, inverse, lights, normalView,
         normalWorld, normalWorldGeometry, overrideNodes, positionViewDirection, positionWorld, roughness, select, transpose, vec3 } from "three/tsl";

import { attributesOf, hostOf } from "./following.js";
import { attributeOf, frameOf, normalObject, positionObject, toWorldOf, TYPES } from "./geometry_nodes.js";
import { hostText, languageOf, shadeText } from "./surface_text.js";

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

// A light adds to this where nothing asks for it.
const SINK = { addAssign() {}, mulAssign() {} };

/** Builds lights in a context of their own: by default those of the scene, with those of `materialLightings`. */
function buildLights(builder, context, nodes = null) {
    const previous = builder.addContext({ lightingModel: { direct() {}, directRectArea() {} }, reflectedLight: {}, materialLightings: [],
                                          irradiance: SINK, iblIrradiance: SINK, radiance: SINK, ambientOcclusion: SINK, ...context });
    builder.lightsNode.setupLights(builder, nodes ?? builder.lightsNode.setupLightsNode(builder));
    builder.setContext(previous);
}

/** The body of a function that returns the sum of lights, where other values stand for some of three's. `build` gets the sum. */
function bodyOf(builder, overrides, build, scale = 1) {
    const sum = Fn(builder => {
        const sum = vec3(0).toVar();
        build(builder, sum);
        return sum.mul(scale);
    })();
    const { vars, code, result } = builder.flowStagesNode(overrideNodes(overrides, sum), "vec3");
    return `${vars}${code}\n\treturn ${result};`;
}

const irradianceBody = (builder, environment) => bodyOf(builder, [[normalWorld, expression("N", "vec3")]], (builder, sum) =>
    buildLights(builder, { irradiance: sum, iblIrradiance: sum, materialLightings: environment }), 1 / Math.PI);

/** three bends rough reflections towards the normal, which lies between L and the eye, unless L went through the surface. */
function radianceBody(builder, environment) {
    const toView = name => expression(name, "vec3").transformDirection(cameraViewMatrix), direction = toView("L"), normal = toView("mxg_normal");
    const eye = builder.camera.isOrthographicCamera ? vec3(0, 0, 1) : cameraPosition.sub(expression("P", "vec3")).transformDirection(cameraViewMatrix);
    const isReflected = normal.dot(direction).mul(normal.dot(eye)).greaterThan(0);
    return bodyOf(builder, [
        [positionViewDirection, select(isReflected, eye, direction)], [normalView, select(isReflected, direction.add(eye).normalize(), direction)],
        [roughness, expression("roughness", "float")],
    ], (builder, sum) => buildLights(builder, { radiance: sum }, environment));
}

export class SurfaceNode extends Node {
    static get type() {
        return "MaterialXSurfaceNode";
    }

    /** Uniforms by their names. `sourceOf` gives the source for another target. */
    constructor(shader, uniforms, sourceOf) {
        super("vec4");
        this.uniforms = uniforms;
        this._sourceOf = sourceOf;
        this._sources = { wgsl: shader.pixel };
        this._info = shader.info;
        this._attributes = attributesOf(shader, PARAMETERS);
        this._variables = shader.variables.filter(({ block }) => block === "vertexData");
        this._flags = new Set(shader.variables.filter(({ type }) => type === "u32").map(({ name }) => name));
    }

    /** Does it read the matrix from object space to the world? */
    get readsWorld() {
        return /\bhost_world/.test(this._sources.wgsl) || this._variables.some(({ semantic }) => /tangent:object/.test(semantic));
    }

    setup(builder) {
        const language = languageOf(builder), direct = [], host = this.#host(builder, language, direct), surface = this.#parameters(builder);
        const read = Object.entries(hostNodes(builder)).filter(([name]) => this._sources.wgsl.includes(`host_${name}`)).map(
            ([name, node]) => [name.endsWith("Matrix") ? "mat4" : "vec3", `h_${name}`, `host_${name}`, node]);
        const parameters = [
            ...surface.map((node, i) => [TYPES[this._variables[i].type], `p_${i}`, null, node]),
            ...direct.flatMap(({ L, radiance }, i) => [["vec3", `L_${i}`, `mxg_directions[${i}]`, L], ["vec3", `E_${i}`, `mxg_radiances[${i}]`, radiance]]),
            ["vec3", "N", "mxg_normal", normalWorldGeometry], ...read,
        ];
        const globals = read.map(([type, , variable]) => language.global(type, variable)).join("");
        const shade = language.native(shadeText(language, this._info, parameters), [language.code(globals + this.#named(builder, language) + host)]);
        return shade(...parameters.map(([, , , node]) => node));
    }

    /** The functions of the host. The lights go to `direct`. */
    #host(builder, language, direct) {
        const { lightsNode, material } = builder, environment = [material.setupEnvironment(builder)].filter(node => node);
        builder.lightsNode = plain(material.lightsNode ?? lightsNode);
        buildLights(builder, { lightingModel: {
            direct({ lightDirection, lightColor }) {
                direct.push({ L: lightDirection.transformDirection(cameraWorldMatrix), radiance: lightColor });
            },
            directRectArea({ lightNode }) {
                console.warn(`MaterialXNodeMaterial: area lights have no effect (${lightNode.light.name || "RectAreaLight"})`);
            },
        } });
        const text = hostText(language, direct.length, irradianceBody(builder, environment), radianceBody(builder, environment));
        builder.lightsNode = lightsNode;
        return text;
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

    /** The source with three's names of uniforms and textures, which three declares. */
    #named(builder, { target, bound, named }) {
        const names = Object.fromEntries(Object.entries(this.uniforms).map(([name, node]) => [name, builder.flowStagesNode(node, "property").result]));
        return named((this._sources[target] ??= this._sourceOf(target)).replace(bound, ""), names, this._flags);
    }
}
