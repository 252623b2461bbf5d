// SPDX-License-Identifier: Apache-2.0
// Khronos' validator (npm gltf-validator, tests/npm) finds no error and no warning in files of glTF. Arguments: the files.
const fs = require("fs"), path = require("path");
const validator = require("gltf-validator");

async function validate(file) {
    const beside = uri => path.join(path.dirname(file), decodeURIComponent(uri));
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
        uri: path.basename(file),
        externalResourceFunction: async uri => new Uint8Array(fs.readFileSync(beside(uri))),
    });
    const faults = report.issues.messages.filter(message => message.severity < 2);
    for (const fault of faults)
        console.log(`${file}${fault.pointer || ""}: ${fault.message} [${fault.code}]`);
    return report.issues.numErrors + report.issues.numWarnings === 0;
}

Promise.all(process.argv.slice(2).map(validate)).then(good => process.exit(good.length && good.every(Boolean) ? 0 : 1));
