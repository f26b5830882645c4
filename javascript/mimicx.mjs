// mimicx in browsers and Node: noisy human motion in, motion of a simulated body and its forces out.
//
//     import {clean} from 'mimicx';
//     const result = await clean({name: 'clip.bvh', bytes}, {write: ['.bvh', '.glb']}, (doing) => console.log(doing));
//
// The work is done by the program, compiled to WebAssembly, in a worker of its own: a call does not hold up the page.
// Types and meanings: mimicx.d.ts; docs/javascript.md has examples.

import {connect} from './connection.mjs';

const SUFFIXES = ['.npz', '.npy', '.bvh', '.glb', '.mot', '.sto', '.csv'];
const in_node = typeof process === 'object' && Boolean(process.versions?.node);

async function read_program() {
  const address = new URL('./mimicx.wasm', import.meta.url);
  if (in_node) return new Uint8Array(await (await import('node:fs/promises')).readFile(address));
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${address}: ${answer.status} ${answer.statusText}`);
  return new Uint8Array(await answer.arrayBuffer());
}

async function new_worker() {
  if (!in_node) return new Worker(new URL('./mimicx_worker.js', import.meta.url));
  const threads = await import('node:worker_threads');
  return new threads.Worker(new URL('./worker_in_node.mjs', import.meta.url));
}

async function bytes_of(file) {
  const bytes = typeof file?.arrayBuffer === 'function' ? await file.arrayBuffer() : file?.bytes;
  const known = typeof file?.name === 'string' && (bytes instanceof ArrayBuffer || bytes instanceof Uint8Array);
  if (known) return new Uint8Array(bytes);
  throw new TypeError('mimicx: expected a File, or {name, bytes}, where the suffix of the name says the format');
}

// Asks a new worker, which is ended whatever comes of it.
async function ask(what, file, {signal, write = [], ...options}, on_progress) {
  const unknown = Array.isArray(write) ? write.find((suffix) => !SUFFIXES.includes(suffix)) : write;
  if (unknown !== undefined) throw new TypeError(`mimicx: write: expected a list of ${SUFFIXES.join(', ')}, found ${unknown}`);
  signal?.throwIfAborted();
  const [bytes, wasm] = await Promise.all([bytes_of(file), read_program()]);
  const program = connect(await new_worker(), wasm, (doing) => on_progress?.(doing)), stop = () => program.end(signal.reason);
  try {
    signal?.addEventListener('abort', stop);
    if (signal?.aborted) stop();
    return (await program.ask({ask: what, name: file.name, bytes, options, write})).answer;
  } finally {
    signal?.removeEventListener('abort', stop);
    program.end();
  }
}

export const clean = (file, options = {}, on_progress = undefined) => ask('clean', file, options, on_progress);
export const audit = (file, options = {}) => ask('audit', file, options);
