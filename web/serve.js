// SPDX-License-Identifier: Apache-2.0
// How a worker answers.

/** Answers messages { id, kind, … } by the function of their kind; the answer has the same id. */
export function serve(kinds) {
    addEventListener("message", async ({ data: { id, kind, ...request } }) => {
        try {
            postMessage({ id, answer: await kinds[kind](request) });
        } catch (error) {
            postMessage({ id, error: String(error?.message ?? error) });
        }
    });
}
