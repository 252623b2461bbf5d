// SPDX-License-Identifier: Apache-2.0
// The page's side of a worker.

const TOO_LONG = 20_000; // milliseconds

export class Compiler {
    #worker = null; // its promise, so requests arrive in their order
    #waiting = new Map();
    #next = 1;
    #remembered = new Map();
    #source;
    #complaint;
    onSaid = () => {}; // what the worker says by itself
    onStop = () => {};

    /** `source` is the text of the worker, or its promise, `complaint` a sentence for work that takes too long. */
    constructor(source, complaint = "The document takes longer than 20 seconds; the compiler was stopped.") {
        this.#source = Promise.resolve(source);
        this.#complaint = complaint;
    }

    #start() {
        this.#worker = this.#source.then(source => this.#listen(new Worker(URL.createObjectURL(new Blob([source], { type: "text/javascript" })))));
        for (const [kind, request] of this.#remembered.values())
            this.ask(kind, request).catch(() => {});
    }

    #listen(worker) {
        worker.onmessage = ({ data: { id, answer, error, said } }) => {
            if (id === undefined) {
                this.onSaid(said);
                return;
            }
            const { resolve, reject, timer } = this.#waiting.get(id);
            clearTimeout(timer);
            this.#waiting.delete(id);
            if (error === undefined)
                resolve(answer);
            else
                reject(new Error(error));
        };
        worker.onerror = event => this.#stop(event.message || "the compiler does not start");
        return worker;
    }

    /** Ends the worker with all that waits for it; the next request starts another one. */
    #stop(reason) {
        this.#worker.then(worker => worker.terminate());
        this.#worker = null;
        for (const { reject, timer } of this.#waiting.values()) {
            clearTimeout(timer);
            reject(new Error(reason));
        }
        this.#waiting.clear();
        this.onStop(reason);
    }

    /** The answer of the worker to a request (worker.js). */
    ask(kind, request = {}) {
        if (!this.#worker)
            this.#start();
        const id = this.#next++;
        return new Promise((resolve, reject) => {
            const timer = setTimeout(() => this.#stop(this.#complaint), TOO_LONG);
            this.#waiting.set(id, { resolve, reject, timer });
            this.#worker.then(worker => worker.postMessage({ id, kind, ...request }));
        });
    }

    /** Asks now, and again whenever another worker starts; of requests with the same kind and name only the last one. */
    remember(kind, request) {
        const answer = this.ask(kind, request);
        this.#remembered.set(`${kind} ${request.name}`, [kind, request]);
        return answer;
    }
}
