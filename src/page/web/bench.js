// A page that cleans motions: files go to the program in a worker, and what it makes of them into the report's tables and
// player.

const bench = {worker: null, waiting: null, queue: [], ready: null, cleaned: 0, kept: []};

// Base64 of gzip, as it stands in an element of this page, as bytes.
async function unpacked(id) {
  const text = atob($(id).textContent.trim()), bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// One question at a time; the next one goes when the answer is there. @return what the worker answers
function ask(what) {
  return new Promise((answered) => {
    bench.queue.push({what, answered});
    send_next();
  });
}

function send_next() {
  if (bench.waiting || !bench.queue.length || !bench.worker) return;
  bench.waiting = bench.queue.shift();
  bench.worker.postMessage(bench.waiting.what);
}

function hear({data: said}) {
  if (said.told !== undefined) { show_told(said.told, said.urgent); return; }
  const {answered} = bench.waiting;
  bench.waiting = null;
  answered(said);
  if (said.ended) begin_worker();
  send_next();
}

// A worker, and in it what earlier ones have made, by the same numbers.
async function begin_worker() {
  if (bench.worker) bench.worker.terminate();
  for (const {answered} of [bench.waiting, ...bench.queue].filter(Boolean)) answered({answer: {error: 'stopped'}});
  Object.assign(bench, {waiting: null, queue: []});
  const address = URL.createObjectURL(new Blob([$('worker').textContent], {type: 'text/javascript'}));
  bench.worker = new Worker(address);
  bench.worker.onmessage = hear;
  bench.ready = unpacked('program').then((wasm) => ask({ask: 'begin', wasm}))
      .then(() => Promise.all(bench.kept.map((run) => ask({ask: 'take_up', ...run}))));
  await bench.ready;
  URL.revokeObjectURL(address);
}

// ---- what it says ---------------------------------------------------------------------------------

function show_told(line, urgent) {
  if (urgent) { $('told').append(...line.split('\n').filter(Boolean).map((text) => make('li', {}, text))); return; }
  $('work-line').textContent = line;
  const share = /(\d+) %/.exec(line);
  if (share) $('work-bar').value = Number(share[1]);
}

function show_working(name) {
  $('told').replaceChildren();
  $('work').hidden = false;
  $('work-bar').removeAttribute('value');
  $('work-line').textContent = `${name}: read, fitted, prepared …`;
}

const show_failure = (text) => $('told').replaceChildren(make('li', {className: 'failed'}, text));

// ---- motions --------------------------------------------------------------------------------------

function add_clip(made) {
  const index = data.rows.length;
  data.rows.push({...made.row, number: made.number});
  arrived.set(index, [made.clip, made.bodies]);
  $('clip').append(new Option(`${made.row.ok ? '' : '✗ '}${made.row.name}`, index));
  document.body.classList.remove('empty');
  $('filter').hidden = data.rows.length < 8;
  show_overview();
  location.hash = `#${index}`;
}

async function clean(name, bytes) {
  if (!$('work').hidden) { show_failure('one motion at a time'); return; }
  stop_playing();
  show_working(name);
  await bench.ready;
  const {answer, files} = await ask({ask: 'plan', name, bytes});
  $('work').hidden = true;
  ++bench.cleaned;
  if (answer.error) { show_failure(answer.error); return; }
  bench.kept[answer.number] = {name, files};
  if (!answer.clip.motions.length) { show_failure(answer.row.reason); return; }
  add_clip(answer);
}

async function take_files(files) {
  for (const file of files) await clean(file.name, new Uint8Array(await file.arrayBuffer()));
}

// ---- saving ---------------------------------------------------------------------------------------

const row_shown = () => data.rows[player.index];

async function saved_bytes(suffix) {
  const {bytes, answer} = await ask({ask: 'save', number: row_shown().number, suffix});
  if (!bytes) throw new Error(answer.error);
  return bytes;
}

async function save_as(suffix) {
  try {
    const bytes = await saved_bytes(suffix), address = URL.createObjectURL(new Blob([bytes]));
    make('a', {href: address, download: `${row_shown().name}.clean${suffix}`}).click();
    setTimeout(() => URL.revokeObjectURL(address), 10000);
    $('save-message').textContent = '';
  } catch (error) {
    $('save-message').textContent = error.message;
  }
}

function show_after() {
  for (const button of $('after').querySelectorAll('[data-suffix], #begin-play')) button.disabled = !row_shown();
  $('save-message').textContent = '';
}

function begin_bench() {
  document.title = 'mimicx';
  document.querySelector('h1').textContent = 'mimicx';
  document.body.classList.add('empty');
  $('status').after($('after'));
  $('after').hidden = false;
  const drop = $('drop');
  const over = (e) => { e.preventDefault(); drop.classList.add('over'); };
  addEventListener('dragover', over);
  addEventListener('dragleave', () => drop.classList.remove('over'));
  addEventListener('drop', (e) => { e.preventDefault(); drop.classList.remove('over'); take_files([...e.dataTransfer.files]); });
  $('choose').onclick = () => $('file').click();
  $('file').onchange = () => take_files([...$('file').files]).then(() => { $('file').value = ''; });
  $('example').onclick = async () => clean($('example-motion').dataset.name, await unpacked('example-motion'));
  $('stop').onclick = () => { begin_worker(); };
  for (const button of $('after').querySelectorAll('[data-suffix]')) button.onclick = () => save_as(button.dataset.suffix);
  addEventListener('hashchange', () => { stop_playing(); show_after(); });
  begin_worker();
}
