// The page's worker: it runs the program, compiled to WebAssembly, and passes messages between it and the page. Every
// answer is the program's own.
//
// The page asks {ask, …}, an answer is {ask, answer} or {ask, bytes}; while the program works it tells {told, urgent}.

let program = null;

function mimicx_told(line, urgent) { postMessage({told: line, urgent}); }

const answer_bytes = () => program.HEAPU8.slice(program._mimicx_answer(), program._mimicx_answer() + program._mimicx_answer_size());
const answer = () => JSON.parse(new TextDecoder().decode(answer_bytes()));

// Copies a text or doubles into the program's memory and calls f(pointer).
function with_memory(bytes, f) {
  const at = program._malloc(bytes.length);
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

async function begin(wasm) {
  program = await new Promise((ready, failed) => {
    const module = {wasmBinary: wasm, onRuntimeInitialized: () => ready(module), onAbort: failed};
    load_program(module);
  });
  program.FS.mkdir('/motions');
  program.FS.chdir('/motions');
  return {};
}

onmessage = async ({data: {ask, ...what}}) => {
  try {
    if (ask === 'begin') postMessage({ask, answer: await begin(what.wasm)});
    else if (ask === 'save') postMessage({ask, ...save(what)});
    else if (ask === 'plan') postMessage({ask, ...plan(what)});
    else { calls[ask](what); postMessage({ask, answer: answer()}); }
  } catch (error) {  // a trap: the program has ended
    postMessage({ask, answer: {error: `the program has stopped: ${error && error.message || error}`}, ended: true});
  }
};
