// Node's worker as one of a browser, for mimicx_worker.js.
import {readFileSync} from 'node:fs';
import {runInThisContext} from 'node:vm';
import {parentPort} from 'node:worker_threads';

Object.assign(globalThis, {self: {location: {href: ''}}, importScripts() {}, postMessage: (message) => parentPort.postMessage(message)});
runInThisContext(readFileSync(new URL('./mimicx_worker.js', import.meta.url), 'utf8'), 'mimicx_worker.js');
parentPort.on('message', (data) => globalThis.onmessage({data}));
