// SPDX-License-Identifier: Apache-2.0
// Pictures of the test by three, in the browser: run.mjs calls the functions of `draws` and looks at the numbers and pictures that they return.
// `kit` is webgl.js or webgpu.js.

import * as THREE from "three";
import { HDRLoader } from "three/addons/loaders/HDRLoader.js";
import { load } from "mxgen";
import * as kit from "kit";

import { CAMERA, cameraAt, encode, pixelsOf, SIZE, SKY, sphere } from "./studio.js";

const { Material, MaterialXLoader, programOf, renderer, uncover } = kit, compiler = load();
renderer.setSize(SIZE, SIZE);
renderer.setClearColor(0, 0);
document.body.append(renderer.domElement);

function shoot(scene, camera = CAMERA) {
    renderer.render(scene, camera);
    return pixelsOf(renderer.domElement);
}

/** Red, green and blue at a place, from -1 to 1. */
function at(picture, x = 0, y = 0) {
    const i = 4 * (Math.round((0.5 - y / 2) * (SIZE - 1)) * SIZE + Math.round((0.5 + x / 2) * (SIZE - 1)));
    return Array.from(picture.data.subarray(i, i + 4));
}

function sceneOf(material, { environment = SKY, geometry = sphere() } = {}) {
    const scene = new THREE.Scene(), mesh = new THREE.Mesh(geometry, material);
    scene.environment = environment;
    scene.add(mesh);
    return { scene, mesh };
}

async function documentOf(text) {
    return (await compiler).createContext().parse(text, { name: "test.mtlx" });
}

const surface = (inputs, rest = "") => `<materialx version="1.39">${rest}<standard_surface name="SR" type="surfaceshader">${inputs}</standard_surface>
    <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial></materialx>`;
const input = (name, type, value) => `<input name="${name}" type="${type}" value="${value}"/>`;
const MATTE = surface(input("base_color", "color3", "0.8, 0.4, 0.2") + input("base", "float", 1) + input("specular", "float", 0));
const matte = async parameters => new Material(await documentOf(MATTE), parameters);

/** Loads an example with its textures. */
async function example(name) {
    const { materials } = await new MaterialXLoader().setPath("examples/").loadAsync(name);
    return Object.values(materials)[0];
}

const directional = (x, y, z, intensity = Math.PI) => {
    const light = new THREE.DirectionalLight(0xffffff, intensity);
    light.position.set(x, y, z);
    return light;
};

const draws = {
    /** Colours, roughness and a relief for textured.mtlx, and tiles, as files. */
    async textures() {
        const files = {}, canvas = new OffscreenCanvas(64, 64), context = canvas.getContext("2d");
        for (const [name, colorAt] of Object.entries({
            wood_color: (x, y) => [80 + 2 * x, 40 + 3 * y, 30], wood_roughness: x => Array(3).fill(60 + 2 * x),
            wood_normal: (x, y) => [128 + 50 * Math.sin(x / 4), 128 + 50 * Math.cos(y / 6), 230],
        })) {
            const image = new ImageData(64, 64);
            for (let i = 0; i < 64 * 64; i++)
                image.data.set([...colorAt(i % 64, i >> 6), 255], 4 * i);
            context.putImageData(image, 0, 0);
            files[`examples/textures/${name}.png`] = [...new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer())];
        }
        for (const [number, color] of Object.entries({ 1001: "red", 1002: "lime", 1011: "blue", 1012: "yellow" })) {
            context.fillStyle = color;
            context.fillRect(0, 0, 64, 64);
            files[`documents/tile.${number}.png`] = [...new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer())];
        }
        return files;
    },

    /** A document under the sky, with the exposure of `mxgen render`. */
    async example(name) {
        const { scene } = sceneOf(await example(name));
        Object.assign(renderer, { toneMapping: THREE.LinearToneMapping, toneMappingExposure: 0.6 });
        renderer.setPixelRatio(2); // smooths edges
        const picture = shoot(scene);
        renderer.setPixelRatio(1);
        renderer.toneMapping = THREE.NoToneMapping;
        return encode(picture);
    },

    /** A light on three's own matte material and on ours. */
    async standard(kind) {
        const lights = {
            directional: () => directional(1, 1, 2),
            point: () => new THREE.PointLight(0xffddaa, 8, 0, 2).translateX(1).translateZ(2),
            spot: () => new THREE.SpotLight(0xaaddff, 30, 0, 0.3, 0.5, 2).translateX(0.5).translateZ(3),
            ambient: () => new THREE.AmbientLight(0x8899aa, 2),
            hemisphere: () => new THREE.HemisphereLight(0x88aaff, 0x664422, 2),
            probe: () => Object.assign(new THREE.LightProbe(), { sh: new THREE.SphericalHarmonics3().set(Array.from({ length: 9 }, (_, i) => new THREE.Vector3(0.5, 0.4, 0.3).multiplyScalar(1 / (i + 1)))) }),
            environment: () => new THREE.Object3D(),
            transparent: () => directional(1, 1, 2),
        };
        const material = await matte(), opacity = kind === "transparent" ? 0.5 : 1, transparent = opacity < 1;
        material.setInput("SR/opacity", Array(3).fill(opacity));
        material.transparent = transparent;
        const { scene, mesh } = sceneOf(material, { environment: kind === "environment" ? SKY : null });
        scene.environmentRotation.set(0.3, 0.7, 0);
        scene.environmentIntensity = 0.8;
        scene.add(lights[kind]());
        const ours = shoot(scene);
        mesh.material = new THREE.MeshPhysicalMaterial({ color: new THREE.Color(0.8, 0.4, 0.2), roughness: 1, specularIntensity: 0, opacity, transparent });
        const theirs = shoot(scene);
        return { ours: at(ours, 0.1, 0.1), theirs: at(theirs, 0.1, 0.1), difference: ours.data.reduce((sum, x, i) => sum + Math.abs(x - theirs.data[i]), 0) / ours.data.length };
    },

    /** The light that a flame of no coverage adds to black, with its alpha. */
    async glow() {
        const text = surface(input("base", "float", 0) + input("specular", "float", 0) + input("emission", "float", 1) + input("emission_color", "color3", "1, 1, 0"));
        const { scene, mesh } = sceneOf(new Material(await documentOf(text)), { environment: null });
        uncover(mesh.material);
        mesh.material.transparent = true;
        scene.background = new THREE.Color(0);
        const color = at(shoot(scene));
        return [...color.slice(0, 3), 255 - color[3]];
    },

    async lightMoves() {
        const { scene } = sceneOf(await matte(), { environment: null }), light = directional(-1, 0, 0.2);
        scene.add(light);
        const front = cameraAt(0, 0, 5, 30), left = shoot(scene, front);
        light.position.x = 1;
        const right = shoot(scene, front);
        return [at(left, -0.4), at(left, 0.4), at(right, -0.4), at(right, 0.4)];
    },

    async shadow() {
        renderer.shadowMap.enabled = true;
        const material = await matte(), { scene, mesh } = sceneOf(material, { environment: null, geometry: new THREE.PlaneGeometry(4, 4) });
        const light = directional(0, 0, 3), blocker = new THREE.Mesh(new THREE.SphereGeometry(0.3), material);
        light.castShadow = true;
        blocker.castShadow = true;
        blocker.position.set(0, 0, 1.5);
        blocker.material = material;
        mesh.receiveShadow = true;
        scene.add(light, blocker);
        const camera = cameraAt(50, 0, 5, 30), picture = shoot(scene, camera);
        const result = [at(picture, 0, 0), at(picture, 0, 0.6)];
        mesh.receiveShadow = false;
        result.push(at(shoot(scene, camera), 0, 0));
        renderer.shadowMap.enabled = false;
        return result;
    },

    async fog() {
        const { scene } = sceneOf(await matte());
        scene.fog = new THREE.Fog(0x004000, 4, 4.0001);
        const opaque = at(shoot(scene)), faded = await matte();
        faded.setInput("SR/opacity", [0.5, 0.5, 0.5]);
        faded.transparent = true;
        scene.children[0].material = faded;
        return [opaque, at(shoot(scene))];
    },

    async toneMapping() {
        const { scene } = sceneOf(await matte()), plain = at(shoot(scene));
        const mapped = [];
        for (const toneMapping of [THREE.LinearToneMapping, THREE.AgXToneMapping]) {
            Object.assign(renderer, { toneMapping, toneMappingExposure: 0.25 });
            mapped.push(at(shoot(scene)));
        }
        renderer.toneMapping = THREE.NoToneMapping;
        return [plain, ...mapped];
    },

    /** Red, green, blue and alpha where instances, bones and morphs move the mesh, and where it was. */
    async moves() {
        const material = await matte(), small = new THREE.SphereGeometry(0.3), found = {};
        const look = object => {
            const { scene, mesh } = sceneOf(material);
            scene.remove(mesh);
            scene.add(object);
            const picture = shoot(scene, cameraAt(0, 0, 5, 30));
            return [at(picture, 0.6), at(picture)].map(([, , , alpha]) => alpha);
        };
        const instances = new THREE.InstancedMesh(small, material, 1);
        instances.setMatrixAt(0, new THREE.Matrix4().makeTranslation(0.8, 0, 0));
        found.instanced = look(instances);
        const batch = new THREE.BatchedMesh(1, 1000, 3000, material);
        batch.setMatrixAt(batch.addInstance(batch.addGeometry(small)), new THREE.Matrix4().makeTranslation(0.8, 0, 0));
        found.batched = look(batch);
        const morphed = new THREE.Mesh(small.clone(), material), { position } = small.attributes;
        morphed.geometry.morphAttributes.position = [new THREE.Float32BufferAttribute(Array.from(position.array, (x, i) => i % 3 ? x : x + 0.8), 3)];
        morphed.updateMorphTargets();
        morphed.morphTargetInfluences[0] = 1;
        found.morphed = look(morphed);
        const skinned = small.clone(), count = position.count;
        skinned.setAttribute("skinIndex", new THREE.Uint16BufferAttribute(new Array(4 * count).fill(0), 4));
        skinned.setAttribute("skinWeight", new THREE.Float32BufferAttribute(Array.from({ length: 4 * count }, (_, i) => i % 4 ? 0 : 1), 4));
        const person = new THREE.SkinnedMesh(skinned, material), bone = new THREE.Bone();
        person.add(bone);
        person.bind(new THREE.Skeleton([bone]));
        bone.position.x = 0.8;
        found.skinned = look(person);
        return found;
    },

    /** An edit of a uniform, then one that needs another program. */
    async edit() {
        const material = await matte(), { scene } = sceneOf(material), steps = [];
        const look = () => {
            const color = at(shoot(scene));
            steps.push({ color, program: programOf(material) });
        };
        const change = work => {
            const edit = material.document.edit();
            work(edit);
            material.document = edit.end();
            look();
        };
        look();
        change(edit => edit.find("SR").value("base_color", [0.1, 0.2, 0.9]));
        material.setInput("SR/base_color", new THREE.Color(0, 1, 0));
        look();
        change(edit => edit.find("SR").value("opacity", [0.5, 0.5, 0.5])); // base_color is again that of the document
        steps.at(-1).transparent = material.transparent;
        change(edit => {
            const noise = edit.add("noise3d", "Noise", "color3");
            edit.find("SR").connect("base_color", noise);
        });
        try {
            material.document = await documentOf("<materialx version='1.39'/>");
        } catch (error) {
            steps.push(error.name);
        }
        look();
        return steps;
    },

    /** Materials that differ in values share a program; a clone has its own values. */
    async share() {
        const text = MATTE.replace("0.8, 0.4, 0.2", "0, 0, 1"), one = await matte(), other = new Material(await documentOf(text)), clone = other.clone();
        clone.setInput("SR/base_color", [0, 1, 0]);
        const colors = [], programs = [];
        for (const material of [one, other, clone]) {
            colors.push(at(shoot(sceneOf(material).scene)));
            programs.push(programOf(material));
        }
        return { colors, programs };
    },

    /** Attributes, spaces and constants that a document reads. */
    async streams() {
        const emit = (nodes, type = "color3") => surface(input("base", "float", 0) + input("specular", "float", 0) + input("emission", "float", 1)
            + `<input name="emission_color" type="${type}" nodename="n"/>`, nodes);
        const plane = new THREE.PlaneGeometry(2, 2), count = plane.attributes.position.count, constant = (...values) => new THREE.Float32BufferAttribute(Array(count).fill(values).flat(), values.length);
        plane.setAttribute("color", constant(1, 0.5, 0));
        plane.setAttribute("uv1", constant(0.25, 0.75));
        plane.setAttribute("wear", constant(0.2, 0.4, 0.6));
        const front = cameraAt(0, 0, 5, 30), found = {};
        const look = async (name, nodes, { geometry = plane, move = mesh => mesh, instance = null } = {}) => {
            const material = new Material(await documentOf(emit(nodes))), { scene, mesh } = sceneOf(material, { geometry, environment: null });
            if (instance) {
                scene.remove(mesh);
                const instances = new THREE.InstancedMesh(geometry, material, 1);
                instances.setMatrixAt(0, instance);
                scene.add(instances);
            }
            move(mesh);
            const encoded = at(shoot(scene, front), 0.2, 0.1);
            found[name] = encoded.slice(0, 3).map(x => new THREE.Color().setRGB(x / 255, 0, 0, THREE.SRGBColorSpace).r);
        };
        const vector = (category, rest = "") => `<${category} name="v" type="vector3">${rest}</${category}><convert name="n" type="color3"><input name="in" type="vector3" nodename="v"/></convert>`;
        const space = name => input("space", "string", name);
        const TRANSFORMED = `<constant name="p" type="vector3">${input("value", "vector3", "0.1, 0.2, 0.3")}</constant>
            <transformpoint name="v" type="vector3"><input name="in" type="vector3" nodename="p"/>${input("fromspace", "string", "object")}${input("tospace", "string", "world")}
            </transformpoint><convert name="n" type="color3"><input name="in" type="vector3" nodename="v"/></convert>`;
        await look("color", `<geomcolor name="n" type="color3"/>`);
        await look("noColor", `<geomcolor name="n" type="color3"/>`, { geometry: new THREE.PlaneGeometry(2, 2) });
        await look("uv1", `<texcoord name="t" type="vector2">${input("index", "integer", 1)}</texcoord><convert name="v" type="vector3"><input name="in" type="vector2" nodename="t"/></convert><convert name="n" type="color3"><input name="in" type="vector3" nodename="v"/></convert>`);
        await look("wear", `<geompropvalue name="n" type="color3">${input("geomprop", "string", "wear")}${input("default", "color3", "0.5, 0.6, 0.7")}</geompropvalue>`);
        await look("noWear", `<geompropvalue name="n" type="color3">${input("geomprop", "string", "wear")}${input("default", "color3", "0.5, 0.6, 0.7")}</geompropvalue>`, { geometry: new THREE.PlaneGeometry(2, 2) });
        if (!renderer.isWebGLRenderer) // which gives no integers where a geometry has none
            await look("noCount", `<geompropvalue name="c" type="integer">${input("geomprop", "string", "count")}${input("default", "integer", 1)}</geompropvalue>
                <convert name="f" type="float"><input name="in" type="integer" nodename="c"/></convert><convert name="n" type="color3"><input name="in" type="float" nodename="f"/></convert>`);
        const read = (node, type, property) => `<geompropvalue name="${node}" type="${type}">${input("geomprop", "string", property)}</geompropvalue>`;
        const toColor = name => `<convert name="n" type="color3"><input name="in" type="vector3" nodename="${name}"/></convert>`;
        await look("uvProperty", `${read("p", "vector2", "uv")}<convert name="v" type="vector3"><input name="in" type="vector2" nodename="p"/></convert>${toColor("v")}`);
        await look("stOfUsd", `${read("p", "vector2", "st1")}<convert name="v" type="vector3"><input name="in" type="vector2" nodename="p"/></convert>${toColor("v")}`);
        await look("twoTypes", `${read("p", "vector3", "wear")}${read("f", "float", "wear")}<multiply name="v" type="vector3"><input name="in1" type="vector3" nodename="p"/>
            <input name="in2" type="float" nodename="f"/></multiply>${toColor("v")}`);
        const lift = mesh => mesh.position.set(0, 0, 0.5);
        await look("positionWorld", vector("position", space("world")), { move: lift });
        await look("positionObject", vector("position", space("object")), { move: lift });
        await look("instanced", vector("position", space("world")), { geometry: plane, instance: new THREE.Matrix4().makeTranslation(0, 0, 0.5) });
        await look("transformedInstance", TRANSFORMED, { instance: new THREE.Matrix4().makeTranslation(0, 0, 0.5) });
        await look("normalWorld", vector("normal", space("world")));
        await look("tangentWorld", vector("tangent", space("world")));
        await look("bitangentWorld", vector("bitangent", space("world")));
        await look("transformed", TRANSFORMED, { move: lift });
        const turned = plane.clone(); // the tangent is +y, and the texture is mirrored
        turned.setAttribute("tangent", constant(0, 1, 0, -1));
        await look("tangentAttribute", vector("tangent", space("world")), { geometry: turned });
        await look("bitangentAttribute", vector("bitangent", space("world")), { geometry: turned });
        return found;
    },

    /** Tiles in four quarters, the colour outside them, and a texture of another loader, which repeats. */
    async images() {
        const manager = new THREE.LoadingManager().addHandler(/\.hdr$/, new HDRLoader()), front = cameraAt(0, 0, 5, 30), found = {};
        const { materials } = await new MaterialXLoader(manager).setPath("documents/").loadAsync("images.mtlx");
        const plane = new THREE.PlaneGeometry(2, 2);
        plane.setAttribute("uv", new THREE.Float32BufferAttribute(Array.from(plane.attributes.uv.array, x => 2.4 * x), 2)); // the tiles cover 2 by 2
        for (const [name, material] of Object.entries(materials)) {
            const picture = shoot(sceneOf(material, { geometry: plane, environment: null }).scene, front);
            found[name] = [[-0.4, -0.4], [0.1, -0.4], [-0.4, 0.1], [0.1, 0.1], [0.7, 0.7]].map(([x, y]) => at(picture, x, y).slice(0, 3).map(x => Math.round(x / 255)).join(""));
        }
        const { type, image } = new kit.MaterialXTextures("").get(null, { values: [0.5, 0.25], tiles: [] });
        found.texel = [type === THREE.HalfFloatType, ...Array.from(image.data, THREE.DataUtils.fromHalfFloat)];
        return found;
    },

    /** The loader: an include, a missing file, `parse`. */
    async loader() {
        const loader = new MaterialXLoader().setPath("documents/"), found = {};
        const { materials } = await loader.loadAsync("main.mtlx");
        found.names = Object.keys(materials);
        found.color = at(shoot(sceneOf(materials.M).scene));
        found.missing = await loader.loadAsync("none.mtlx").then(() => "no error", error => error.message);
        found.broken = await loader.loadAsync("broken.mtlx").then(() => "no error", error => `${error.name}: ${error.message}`);
        try {
            new MaterialXLoader().parse(MATTE);
        } catch (error) {
            found.noCompiler = error.message;
        }
        const parsed = new MaterialXLoader().setCompiler(await compiler).setParameters({ side: THREE.DoubleSide }).parse(MATTE);
        found.side = parsed.materials.M.side === THREE.DoubleSide;
        try {
            await matte({ options: { role: "path" } });
        } catch (error) {
            found.option = `${error.name}: ${error.message}`;
        }
        return found;
    },

    /** With nodes of three. */
    async nodes() {
        const found = {};
        for (const [name, nodes] of Object.entries(kit.nodes)) {
            const { scene } = sceneOf(Object.assign(await matte(), nodes), { environment: null });
            scene.add(directional(0, 0, 1));
            found[name] = at(shoot(scene, cameraAt(0, 0, 5, 30)));
        }
        return found;
    },

    /** Two point lights, with three's add-ons and without. */
    async lightings() {
        const material = await matte(), found = {}, { lighting } = renderer;
        for (const [name, other] of [["plain", lighting], ...Object.entries(kit.lightings)]) {
            renderer.lighting = other;
            const { scene } = sceneOf(material.clone(), { environment: null });
            scene.add(new THREE.PointLight(0xffffff, 8).translateX(2).translateZ(2), new THREE.PointLight(0xffffff, 4).translateY(2).translateZ(2));
            found[name] = at(shoot(scene), 0.1, 0.1);
        }
        renderer.lighting = lighting;
        return found;
    },

    async isWebGpu() {
        return Boolean(renderer.backend?.isWebGPUBackend);
    },

    async misuse() {
        return kit.misuse(sceneOf(await matte()).scene, CAMERA);
    },

    /** The sky as the map of a material. */
    async envMap() {
        const material = await matte({ envMap: SKY, envMapIntensity: 0.5 }), own = at(shoot(sceneOf(material, { environment: null }).scene));
        const { scene } = sceneOf(await matte());
        scene.environmentIntensity = 0.5;
        return [own, at(shoot(scene))];
    },

    /** An orthographic camera sees all points of a mirror plane from one direction. */
    async orthographic() {
        const text = surface(input("base", "float", 0) + input("specular", "float", 0) + input("emission", "float", 1) + `<input name="emission_color" type="color3" nodename="n"/>`,
            `<viewdirection name="v" type="vector3">${input("space", "string", "world")}</viewdirection><absval name="a" type="vector3"><input name="in" type="vector3" nodename="v"/></absval><convert name="n" type="color3"><input name="in" type="vector3" nodename="a"/></convert>`);
        const { scene } = sceneOf(new Material(await documentOf(text)), { geometry: new THREE.PlaneGeometry(4, 4), environment: null });
        const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 10);
        camera.position.z = 3;
        const flat = shoot(scene, camera);
        return [at(flat, -0.9), at(flat, 0.9), at(shoot(scene, cameraAt(0, 0, 3, 30)), 0.9)];
    },
};

window.draws = draws;
