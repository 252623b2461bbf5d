// SPDX-License-Identifier: Apache-2.0
// The page's side of the worker.

import workerSource from "worker.bundle.js";

const TOO_LONG = 20_000; // milliseconds

export class Compiler {
    #worker = null;
    #waiting = new Map();
    #next = 1;
    #files = new Map();

    #start() {
        this.#worker = new Worker(URL.createObjectURL(new Blob([workerSource], { type: "text/javascript" })));
        this.#worker.onmessage = ({ data: { id, answer, error } }) => {
            const { resolve, reject, timer } = this.#waiting.get(id);
            clearTimeout(timer);
            this.#waiting.delete(id);
            if (error === undefined)
                resolve(answer);
            else
                reject(new Error(error));
        };
        this.#worker.onerror = event => this.#stop(event.message || "the compiler does not start");
        if (this.#files.size)
            this.ask("addFiles", { added: [...this.#files] });
    }

    /** Ends the worker with all that waits for it; the next request starts another one. */
    #stop(reason) {
        this.#worker.terminate();
        this.#worker = null;
        for (const { reject, timer } of this.#waiting.values()) {
            clearTimeout(timer);
            reject(new Error(reason));
        }
        this.#waiting.clear();
    }

    /** The answer of the worker to a request (worker.js). */
    ask(kind, request = {}) {
        if (!this.#worker)
            this.#start();
        const id = this.#next++;
        return new Promise((resolve, reject) => {
            const timer = setTimeout(() => this.#stop("The document takes longer than 20 seconds; the compiler was stopped."), TOO_LONG);
            this.#waiting.set(id, { resolve, reject, timer });
            this.#worker.postMessage({ id, kind, ...request });
        });
    }

    /** Files that documents include, by name. */
    addFiles(added) {
        for (const [name, text] of added)
            this.#files.set(name, text);
        return this.ask("addFiles", { added });
    }
}
