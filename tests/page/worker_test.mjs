// The page's worker (src/page/web/worker.js) with a program that has no memory left: the answer says so, and no function
// of the program is called with a pointer to nothing.
//   node worker_test.mjs src/page/web/worker.js
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {runInThisContext} from 'node:vm';

const told = [], freed = [], memory = {};  // what the program's functions return: 0 where there is none
globalThis.postMessage = (message) => told.push(message);
globalThis.load_program = (module) => {
  Object.assign(module, {
    HEAPU8: new Uint8Array(64), FS: {mkdir() {}, chdir() {}}, _malloc: () => memory.block, _free() {},
    _mimicx_motion_new: () => memory.motion, _mimicx_motion_free: (motion) => freed.push(motion),
  });
  module.onRuntimeInitialized();
};
runInThisContext(readFileSync(process.argv[2], 'utf8'), 'worker.js');

const answer_to = async (what) => {
  await globalThis.onmessage({data: what});
  return told.pop();
};
const audit = {ask: 'audit', name: 'a.npz', bytes: new Uint8Array(3), options: {}};
const no_memory = {answer: {error: 'there is not enough memory'}};

await answer_to({ask: 'begin'});
Object.assign(memory, {block: 8, motion: 0});
assert.deepEqual(await answer_to(audit), no_memory);
assert.deepEqual(freed, [], 'there was no motion');
Object.assign(memory, {block: 0, motion: 16});
assert.deepEqual(await answer_to(audit), no_memory);
assert.deepEqual(freed, [16], 'the motion is freed');
