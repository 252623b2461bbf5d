// SPDX-License-Identifier: Apache-2.0
// Builds the extension. Arguments: the built npm package `mxgen`, an empty folder, the .vsix file.

import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

import esbuild from "esbuild";

const here = path.dirname(fileURLToPath(import.meta.url)), root = path.join(here, "../..");
const [library, folder, output] = process.argv.slice(2).map(name => path.resolve(name)), dist = path.join(folder, "dist");
const modules = new Set(); // packages whose code is in the bundles

/** Modules of the page stand on the built library, which has generated files beside those of the source. */
const sources = {
    name: "sources",
    setup(build) {
        build.onResolve({ filter: /js\/mxgen\/mxgen\.js$|^mxgen$/ }, () => ({ path: path.join(library, "mxgen.js") }));
        build.onResolve({ filter: /^@web\// }, ({ path: name }) => ({ path: path.join(root, "web", name.slice("@web/".length)) }));
        build.onResolve({ filter: /^worker\.bundle\.js$/ }, () => ({ path: path.join(folder, "worker.bundle.js") }));
    },
};

async function bundle(entry, outfile, options) {
    const { metafile } = await esbuild.build({ entryPoints: [path.join(here, entry)], outfile, bundle: true, minify: true, target: "es2022", metafile: true,
        legalComments: "none", absWorkingDir: here, plugins: [sources], logLevel: "warning", loader: { ".bundle.js": "text" }, ...options });
    for (const name of Object.keys(metafile.inputs)) {
        const [, found] = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(name.slice(name.lastIndexOf("node_modules"))) ?? [];
        if (found)
            modules.add(path.join(here, name.slice(0, name.lastIndexOf("node_modules")), "node_modules", found));
    }
}

/** The licences of the packages in the bundles. */
function notices() {
    return [...modules].sort().map(module => {
        const { name, version } = JSON.parse(fs.readFileSync(path.join(module, "package.json"), "utf8")), file = fs.readdirSync(module).find(one => /^licen[cs]e/i.test(one));
        if (!file)
            throw new Error(`${module} has no licence`);
        return `${name} ${version}\n\n${fs.readFileSync(path.join(module, file), "utf8").trim()}\n`;
    }).join(`\n${"-".repeat(80)}\n\n`);
}

fs.rmSync(folder, { recursive: true, force: true });
fs.mkdirSync(dist, { recursive: true });
await bundle("src/desktop.ts", path.join(dist, "desktop.js"), { platform: "node", format: "cjs", external: ["vscode"] });
await bundle("src/browser.ts", path.join(dist, "browser.js"), { platform: "browser", format: "cjs", external: ["vscode"] });
await bundle("src/worker.ts", path.join(dist, "worker.js"), { format: "iife" });
await bundle("view/worker.ts", path.join(folder, "worker.bundle.js"), { format: "iife" });
await bundle("view/view.ts", path.join(dist, "view.js"), { format: "iife" });
fs.rmSync(path.join(folder, "worker.bundle.js"));
fs.copyFileSync(path.join(here, "view/view.css"), path.join(dist, "view.css"));
fs.copyFileSync(path.join(library, "mxgen.wasm"), path.join(dist, "mxgen.wasm"));
for (const name of ["README.md", "language-configuration.json", "media", "syntaxes"])
    fs.cpSync(path.join(here, name), path.join(folder, name), { recursive: true });
fs.copyFileSync(path.join(root, "LICENSE"), path.join(folder, "LICENSE"));
fs.writeFileSync(path.join(folder, "ThirdPartyNotices.txt"), `${notices()}\n${"-".repeat(80)}\n\nmxgen.wasm\n\n${fs.readFileSync(path.join(library, "NOTICES.txt"), "utf8")}`);
const { private: _, devDependencies: __, ...manifest } = JSON.parse(fs.readFileSync(path.join(here, "package.json"), "utf8"));
fs.writeFileSync(path.join(folder, "package.json"), JSON.stringify(manifest, null, 2));
execFileSync(process.execPath, [path.join(here, "node_modules/@vscode/vsce/vsce"), "package", "--no-dependencies", "--allow-missing-repository", "--skip-license",
    "--no-rewrite-relative-links", "--out", output], { cwd: folder, stdio: ["ignore", "ignore", "inherit"] });
