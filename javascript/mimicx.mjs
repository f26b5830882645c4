// mimicx in browsers and Node: noisy human motion in, motion of a simulated body and its forces out.
//
//     import {clean} from 'mimicx';
//     const result = await clean({name: 'clip.bvh', bytes}, {write: ['.bvh', '.glb']}, (doing) => console.log(doing));
//
// The work is done by the program, compiled to WebAssembly, in a worker of its own: a call does not hold up the page.
// Types and meanings: mimicx.d.ts; docs/javascript.md has examples.

const in_node = typeof process === 'object' && Boolean(process.versions?.node);

async function read_program() {
  const address = new URL('./mimicx.wasm', import.meta.url);
  if (in_node) return new Uint8Array(await (await import('node:fs/promises')).readFile(address));
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${address}: ${answer.status} ${answer.statusText}`);
  return new Uint8Array(await answer.arrayBuffer());
}

// A worker, and a function that says who gets its messages and its errors.
async function begin_worker() {
  if (in_node) {
    const {Worker} = await import('node:worker_threads');
    const worker = new Worker(new URL('./worker_in_node.mjs', import.meta.url));
    return [worker, (hear, fail) => worker.on('message', hear).on('error', fail)];
  }
  const worker = new Worker(new URL('./mimicx_worker.js', import.meta.url));
  return [worker, (hear, fail) => {
    worker.onmessage = ({data}) => hear(data);
    worker.onerror = ({message}) => fail(new Error(message || 'the worker cannot be loaded'));
  }];
}

async function bytes_of(file) {
  const bytes = typeof file?.arrayBuffer === 'function' ? await file.arrayBuffer() : file?.bytes;
  const known = typeof file?.name === 'string' && (bytes instanceof ArrayBuffer || bytes instanceof Uint8Array);
  if (known) return new Uint8Array(bytes);
  throw new TypeError('mimicx: expected a File, or {name, bytes}, where the suffix of the name says the format');
}

// Asks a new worker, which is ended whatever comes of it.
async function ask(what, file, {signal, write = [], ...options}, on_progress) {
  signal?.throwIfAborted();
  const [bytes, wasm] = await Promise.all([bytes_of(file), read_program()]), [worker, listen] = await begin_worker();
  let stop;
  try {
    return await new Promise((done, fail) => {
      stop = () => fail(signal.reason);
      signal?.addEventListener('abort', stop);
      if (signal?.aborted) stop();
      listen(({told, ask: answered, answer}) => {
        if (told !== undefined) { try { on_progress?.(told); } catch (error) { fail(error); } }
        else if (answer.error !== undefined) fail(new Error(answer.error));
        else if (answered === 'begin') worker.postMessage({ask: what, name: file.name, bytes, options, write});
        else done(answer);
      }, fail);
      worker.postMessage({ask: 'begin', wasm});
    });
  } finally {
    signal?.removeEventListener('abort', stop);
    worker.terminate();
  }
}

export const clean = (file, options = {}, on_progress = undefined) => ask('clean', file, options, on_progress);
export const audit = (file, options = {}) => ask('audit', file, options);
