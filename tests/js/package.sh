#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The npm package as its users get it: packed, installed in an empty folder, its types, and the example. Arguments: a folder with the
# package, the root of the project, the program.
package=$(realpath "$1") root=$2 program=$(realpath "$3")
. "$(dirname "$0")/../programs/common.sh"
command -v npm >/dev/null || { echo "skip: npm is not installed"; exit 77; }
export npm_config_cache=$work/cache npm_config_offline=true npm_config_update_notifier=false npm_config_fund=false npm_config_audit=false

check "npm packs the package" exits 0 npm pack "$package"
tar -tzf mxgen-*.tgz | sort >files
(cd "$package" && find . -type f | sed 's|^\.|package|' | sort) >expected
check "the package has its files and no other" diff expected files
check "the package has at most 1.4 MB" test "$(stat -c %s mxgen-*.tgz)" -le 1400000
mkdir app && cd app || exit 1
echo '{ "type": "module" }' >package.json
check "npm installs the package" exits 0 npm install --no-save ../mxgen-*.tgz
check "the tests pass with the installed package" node "$root/tests/js/run.mjs" node_modules/mxgen "$root" "$program"
cp "$root/examples/shader.mjs" .
check "the example runs" exits 0 node shader.mjs "$root/examples/marble.mtlx" essl
check "the example writes a shader" grep -q '^void main' out
check "the example lists uniforms" grep -q '^// NG_marble/stone: vec3 ' out
check "the example fails without a document" exits 1 node shader.mjs none.mtlx essl
check "the example reports errors" grep -q 'error: .*file-missing' err

# TypeScript
if command -v tsc >/dev/null; then
    types() {
        tsc --noEmit --strict --module node16 --moduleResolution node16 --target es2022 --lib es2022,dom "$@"
    }
    cat >right.ts <<'END'
import { load, DocumentError, type Variable, type Shader } from "mxgen";
const mxgen = await load(new Uint8Array());
const context = mxgen.createContext({ resolver: (from: string, ref: string) => ({ name: ref, data: from }), maxMemory: 5 });
const shader: Shader = context.parse("", { name: "x" }).generate("glsl", { options: { uniform: ["a"], interface: "reduced" } });
const variable: Variable | null = shader.findVariable("a");
if (variable) shader.packValue(shader.pack("publicUniforms"), variable, [1]);
const edit = context.edit();
edit.add("noise2d", "n", "float").value("amplitude", 1, "float");
export const text: string = edit.end().xml();
export const server = mxgen.createLanguageServer({ send: (message: object) => void message, readFile: async (path: string) => path });
export const idle: Promise<void> = server.handle({ method: "exit" });
export const first = (error: DocumentError): string => error.diagnostics.items[0].id;
END
    check "the types of a program are right" exits 0 types right.ts
    check "so they are in a project without the types of browsers" exits 0 types --lib es2022 right.ts
    printf 'import { load } from "mxgen";\nusing context = (await load()).createContext();\nexport const version: string = context.toString();\n' >using.ts
    if tsc --version | grep -q 'Version \(5\.[2-9]\|[6-9]\)'; then
        check "a declaration with 'using' compiles" exits 0 types --lib es2022,esnext.disposable using.ts
    else
        skip "this tsc does not know 'using'"
    fi
    # wrong LINE: what the compiler says to a line of TypeScript
    wrong() {
        printf 'import { load } from "mxgen";\nconst m = await load();\nexport const x = %s;\n' "$2" >wrong.ts
        check "$1 is an error" exits 2 types wrong.ts
    }
    wrong "a wrong target" 'm.createContext().parse("").generate(5)'
    wrong "an unknown member" 'm.createContext().parse("").generate("glsl").fragment'
    wrong "an unknown limit" 'm.createContext({ maxWords: 5 })'
    wrong "a block that does not exist" 'm.createContext().parse("").generate("glsl").pack("uniforms")'
else
    skip "tsc is not installed (Debian: node-typescript): the types were not checked"
fi
finish npm-package
