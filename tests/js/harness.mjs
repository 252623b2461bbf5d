// SPDX-License-Identifier: Apache-2.0
// Tests of the npm package: `test` registers one, `run` runs all and prints the line that script/test sums up.

const tests = [];

export function test(name, work) {
    tests.push({ name, work });
}

export async function run(title) {
    let failed = 0;
    for (const { name, work } of tests) {
        try {
            await work();
        } catch (error) {
            failed++;
            console.log(`failed: ${name}\n${error.stack.replace(/^/gm, "    ")}`);
        }
    }
    console.log(`${title}: ${tests.length - failed} passed, ${failed} failed, 0 skipped`);
    process.exitCode = failed ? 1 : 0;
}
