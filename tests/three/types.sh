#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The entries mxgen/three and mxgen/three/webgpu without a browser: its modules parse, the package has them, and its types are right. Argument: the root of the project.
root=$1 packages=$1/tests/npm/node_modules
. "$(dirname "$0")/../programs/common.sh"
command -v node >/dev/null || { echo "skip: Node is not installed"; exit 77; }

(cd "$root/js/mxgen" && ls three/*.js three/*.d.ts) >expected
sed -n "/^foreach file/,/]/p" "$root/js/mxgen/three/meson.build" | grep -o "[a-z_.]*\.\(js\|ts\)" | sed 's|^|three/|' >files
check "the package has its modules" diff expected files
for module in $(grep 'js$' expected); do
    check "the module $module parses" exits 0 node --check "$root/js/mxgen/$module"
done
node -e 'const { exports } = require(process.argv[1]); for (const file of Object.values(exports["./three"])) console.log(file.slice(2))' \
    "$root/js/mxgen/package.json" >named
node -e 'const { exports } = require(process.argv[1]); for (const file of Object.values(exports["./three/webgpu"])) console.log(file.slice(2))' \
    "$root/js/mxgen/package.json" >>named
check "package.json names both entries and their types, which exist" test "$(grep -cxf expected named)" -eq 4

if [ -d "$packages/three" ] && [ -d "$packages/@types/three" ] && [ -f "$packages/typescript/bin/tsc" ]; then
    mkdir -p app/node_modules/mxgen && cd app || exit 1
    cp -r "$root/js/mxgen/package.json" "$root/js/mxgen/index.d.ts" "$root/js/mxgen/three" node_modules/mxgen
    ln -s "$packages/three" "$packages/@types" node_modules
    echo '{ "type": "module" }' >package.json
    cat >program.ts <<'END'
import { Color, DoubleSide, LoadingManager, Mesh, SphereGeometry } from "three";
import { load } from "mxgen";
import { MaterialXLoader, MaterialXMaterial } from "mxgen/three";
const document = (await load()).createContext().parse("");
const material = new MaterialXMaterial(document, { element: "Gold", side: DoubleSide, options: { interface: "reduced" }, manager: new LoadingManager() });
const mesh: Mesh<SphereGeometry, MaterialXMaterial> = new Mesh(new SphereGeometry(), material);
const isUniform: boolean = material.setInput("SR/base_color", new Color()) || material.setInput("SR/base", 1);
material.document = document.edit().end();
material.uniforms.u_time.value = isUniform ? 5 : 6;
const { materials } = await new MaterialXLoader().setPath("a/").setParameters({ side: DoubleSide }).loadAsync("gold.mtlx");
mesh.material = materials.Gold;
export const name: string = material.clone().shader.info.name;
// @ts-expect-error: a text in place of a document
new MaterialXMaterial("<materialx/>");
// @ts-expect-error: an unknown parameter
new MaterialXLoader().setParameters({ sides: 2 });
// @ts-expect-error: the material sets its shader
material.shader = material.shader;
END
    cat >webgpu.ts <<'END'
import { Color, DoubleSide, Mesh, SphereGeometry } from "three/webgpu";
import { vec4 } from "three/tsl";
import { load } from "mxgen";
import { MaterialXLoader, MaterialXNodeMaterial, type MaterialXResult } from "mxgen/three/webgpu";
const document = (await load()).createContext().parse("");
const material = new MaterialXNodeMaterial(document, { element: "Gold", side: DoubleSide });
const mesh: Mesh<SphereGeometry, MaterialXNodeMaterial> = new Mesh(new SphereGeometry(), material);
const isUniform: boolean = material.setInput("SR/base_color", new Color());
material.document = document.edit().end();
material.uniforms.u_time.value = isUniform ? 5 : 6;
material.outputNode = vec4(material.surfaceNode.rgb, 1);
const result: MaterialXResult = await new MaterialXLoader().setPath("a/").loadAsync("gold.mtlx");
mesh.material = result.materials.Gold;
export const name: string = material.clone().shader.info.name;
// @ts-expect-error: it has no stages in GLSL
material.vertexShader;
END
    check "the types of a program are right, and those of its faults wrong" exits 0 node "$packages/typescript/bin/tsc" --noEmit --strict --skipLibCheck \
        --module node16 --moduleResolution node16 --target es2022 --lib es2022,dom program.ts webgpu.ts
else
    skip "three, its types or TypeScript is not installed (npm ci --prefix tests/npm): the types were not checked"
fi
finish three-types
