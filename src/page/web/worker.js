// The worker of the page and of the JavaScript module: it runs the program, compiled to WebAssembly, and passes messages
// between it and javascript/connection.mjs. Every answer is the program's own.
//
// A request is {ask, …}, an answer {answer} or {bytes}; while the program works it tells {told, urgent}.

let program = null;

function mimicx_told(line, urgent) { postMessage({told: line, urgent}); }

const answer_bytes = () => program.HEAPU8.slice(program._mimicx_answer(), program._mimicx_answer() + program._mimicx_answer_size());
const answer = () => JSON.parse(new TextDecoder().decode(answer_bytes()));

// What the program made room for; it returns 0 where there is no memory.
function there(pointer) {
  if (!pointer) throw new Error('there is not enough memory');
  return pointer;
}

// Copies a text or doubles into the program's memory and calls f(pointer).
function with_memory(bytes, f) {
  const at = there(program._malloc(Math.max(bytes.length, 1)));
  program.HEAPU8.set(bytes, at);
  try { return f(at); } finally { program._free(at); }
}
const with_text = (text, f) => with_memory(new TextEncoder().encode(text + '\0'), f);
const with_numbers = (numbers, f) => with_memory(new Uint8Array(Float64Array.from(numbers).buffer), f);

// All files below a folder, by path.
function files_below(folder) {
  return program.FS.readdir(folder).filter((name) => !name.startsWith('.')).flatMap((name) => {
    const path = `${folder}/${name}`;
    return program.FS.isDir(program.FS.stat(path).mode) ? files_below(path) : [[path, program.FS.readFile(path)]];
  });
}

// The program's files for a motion. The page keeps them, because a stopped worker loses its files.
function plan({name, bytes}) {
  program.FS.writeFile(name, bytes);
  with_text(name, (file) => program._mimicx_plan(file));
  program.FS.unlink(name);
  const made = answer();
  return {answer: made, files: made.error ? [] : files_below(`/cleaned/${made.number}`)};
}

const calls = {
  take_up({name, files}) {
    for (const [path, bytes] of files) {
      program.FS.mkdirTree(path.slice(0, path.lastIndexOf('/')));
      program.FS.writeFile(path, bytes);
    }
    with_text(name, (file) => program._mimicx_take_up(file));
  },
  play({number}) { program._mimicx_play(number); },
  step() { program._mimicx_step(); },
  restart() { program._mimicx_restart(); },
  push({change}) { program._mimicx_push(...change); },
  controller({which}) { program._mimicx_controller(which); },
  friction({friction}) { program._mimicx_friction(friction); },
  shape({betas}) { if (betas) with_numbers(betas, (at) => program._mimicx_shape(at)); else program._mimicx_shape(0); },
};

function save({number, suffix}) {
  const good = with_text(suffix, (at) => program._mimicx_saved(number, at));
  return good ? {bytes: answer_bytes()} : {answer: answer()};
}

// ---- the C interface (include/mimicx.h), for the JavaScript module --------------------------------

const OK = 0, NOT_FOLLOWED = 2;
const ARRAYS = {'<f8': Float64Array, '<f4': Float32Array, '<i8': BigInt64Array, '<i4': Int32Array, '|u1': Uint8Array,
                '|b1': Uint8Array};
const text_at = (pointer) => pointer ? program.UTF8ToString(pointer) : '';

function setting_text(value) {
  if (typeof value === 'boolean') return String(Number(value));
  return typeof value === 'object' ? JSON.stringify(value) : String(value);
}

// Reads a motion from its file and calls f(motion, check), where check throws the motion's error.
function with_motion({name, bytes, options}, f) {
  const motion = there(program._mimicx_motion_new());
  const check = (good) => { if (!good) throw new Error(text_at(program._mimicx_motion_error(motion))); };
  try {
    for (const [key, value] of Object.entries(options).filter(([, value]) => value !== undefined)) {
      check(with_text(key, (k) => with_text(setting_text(value), (v) => program._mimicx_motion_set(motion, k, v))) === OK);
    }
    check(with_text(name, (n) => with_memory(bytes, (at) => program._mimicx_motion_read(motion, at, bytes.length, n))) === OK);
    return f(motion, check);
  } finally {
    program._mimicx_motion_free(motion);
  }
}

// An array of a motion as {shape, data}; null where it has texts. mimicx_array has its data at 0, its type at 4, the
// number of its dimensions at 12 and its shape at 16.
const array_of = (motion, member) => with_text(member, (name) => with_memory(new Uint8Array(48), (view) => {
  if (program._mimicx_motion_array(motion, name, view) !== OK) return null;
  const memory = new DataView(program.HEAPU8.buffer), Numbers = ARRAYS[text_at(view + 4)];
  const shape = Array.from({length: memory.getInt32(view + 12, true)}, (_, k) => Number(memory.getBigInt64(view + 16 + 8 * k, true)));
  const data = memory.getUint32(view, true), size = shape.reduce((product, n) => product * n, Numbers.BYTES_PER_ELEMENT);
  return {shape, data: new Numbers(program.HEAPU8.slice(data, data + size).buffer)};
}));

const file_of = (motion, suffix, check) => with_text(suffix, (text) => with_memory(new Uint8Array(8), (places) => {
  check(program._mimicx_motion_write(motion, text, places, places + 4) === OK);
  const [at, size] = new Uint32Array(program.HEAPU8.buffer, places, 2);
  return program.HEAPU8.slice(at, at + size);
}));

const clean = ({write, ...what}) => with_motion(what, (motion, check) => {
  const status = program._mimicx_clean(motion);
  check(status === OK || status === NOT_FOLLOWED);
  const record = JSON.parse(text_at(program._mimicx_motion_record(motion)));
  const members = text_at(program._mimicx_motion_members(motion)).split('\n').filter(Boolean);
  const arrays = members.map((member) => [member, array_of(motion, member)]).filter(([, array]) => array);
  const files = write.map((suffix) => [suffix, file_of(motion, suffix, check)]);
  return {followed: status === OK, reason: record.reason ?? '', metrics: record.metrics ?? {}, record,
          arrays: Object.fromEntries(arrays), files: Object.fromEntries(files)};
});

const audit = (what) => with_motion(what, (motion, check) => {
  const text = text_at(program._mimicx_motion_audit(motion));
  check(text);
  return JSON.parse(text).files[0].audits;
});

// Errors of the motion are answers.
function answered(work, what) {
  try { return work(what); } catch (error) {
    if (error instanceof WebAssembly.RuntimeError) throw error;
    return {error: error.message};
  }
}

async function begin(wasm) {
  program = await new Promise((ready, failed) => {
    const module = {wasmBinary: wasm, onRuntimeInitialized: () => ready(module), onAbort: failed};
    load_program(module);
  });
  program.FS.mkdir('/motions');
  program.FS.chdir('/motions');
  return {};
}

globalThis.onmessage = async ({data: {ask, ...what}}) => {
  try {
    if (ask === 'begin') postMessage({answer: await begin(what.wasm)});
    else if (ask === 'save') postMessage(save(what));
    else if (ask === 'plan') postMessage(plan(what));
    else if (ask === 'clean') postMessage({answer: answered(clean, what)});
    else if (ask === 'audit') postMessage({answer: answered(audit, what)});
    else { calls[ask](what); postMessage({answer: answer()}); }
  } catch (error) {  // a trap: the program has ended
    postMessage({answer: {error: `the program has stopped: ${error && error.message || error}`}, ended: true});
  }
};
