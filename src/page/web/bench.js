// The page that cleans motions: it passes files to the program in a worker and adds the results to the report's tables
// and player.

// `worker` is the connection to the program, made by `connect` of the JavaScript module (javascript/connection.mjs);
// `motions` are the dropped files that wait: [{name, read}], where read() returns the bytes.
const bench = {connect: null, worker: null, cleaned: 0, kept: [], motions: [], busy: false, stops: 0};
const worker_address = URL.createObjectURL(new Blob([$('worker').textContent], {type: 'text/javascript'}));

// Starts a worker and restores in it the motions of earlier workers, with the same numbers.
function begin_worker() {
  bench.worker?.end(new Error('stopped'));
  bench.worker = bench.connect(new Worker(worker_address), unpacked('program'), show_told);
  bench.kept.forEach((run) => ask({ask: 'take_up', ...run}));
}

// @return what the worker sends back: {answer}, where a failure is {error}, and for some requests bytes or files
function ask(what) {
  if (bench.worker.ended()) begin_worker();
  return bench.worker.ask(what).catch(({message}) => ({answer: {error: message}}));
}

// ---- messages -------------------------------------------------------------------------------------

function show_told(line, urgent) {
  if (urgent) { $('told').append(...line.split('\n').filter(Boolean).map((text) => make('li', {}, text))); return; }
  $('work-line').textContent = line;
  const share = /(\d+) %/.exec(line);
  if (share) $('work-bar').value = Number(share[1]);
}

function show_working(name) {
  $('work').hidden = false;
  $('work-bar').removeAttribute('value');
  $('work-line').textContent = `${name}: read, fitted, prepared …`;
  show_more();
}

function show_more() {
  const more = bench.motions.length;
  $('work-more').textContent = more ? `${more} more to come` : '';
}

// @param name  of the motion, added where the text does not begin with it
function show_failure(text, name = '') {
  $('told').append(make('li', {className: 'failed'}, text.startsWith(name) ? text : `${name}: ${text}`));
}

// ---- motions --------------------------------------------------------------------------------------

function add_clip(made) {
  const index = data.rows.length;
  data.rows.push({...made.row, number: made.number});
  arrived.set(index, [made.clip, made.bodies]);
  $('clip').append(new Option(`${made.row.ok ? '' : '✗ '}${made.row.name}`, index));
  document.body.classList.remove('empty');
  $('filter').hidden = data.rows.length < 8;
  show_overview();
  return index;
}

// @return index of the new clip, null for a failure
async function clean({name, read}) {
  const {stops} = bench;
  show_working(name);
  const bytes = await read().catch(() => null);
  if (!bytes) { show_failure('cannot be read', name); return null; }
  const {answer, files} = stops === bench.stops ? await ask({ask: 'plan', name, bytes}) : {answer: {error: 'stopped'}};
  if (answer.error) { show_failure(answer.error, stops === bench.stops ? name : ''); return null; }
  bench.kept[answer.number] = {name, files};
  if (!answer.clip.motions.length) { show_failure(answer.row.reason, name); return null; }
  return add_clip(answer);
}

// Cleans motions one after the other, including those dropped meanwhile. The first success is shown; the others can be
// selected.
async function take_motions(motions) {
  bench.motions.push(...motions);
  show_more();
  if (bench.busy || !bench.motions.length) return;
  stop_playing();
  $('told').replaceChildren();
  bench.busy = true;
  show_after();
  let shown = false;
  while (bench.motions.length) {
    const clip = await clean(bench.motions.shift());
    ++bench.cleaned;
    if (clip === null || shown) continue;
    shown = true;
    location.hash = `#${clip}`;
  }
  bench.busy = false;
  $('work').hidden = true;
  show_after();
}

const take_files = (files) => take_motions([...files].map((file) =>
    ({name: file.name, read: async () => new Uint8Array(await file.arrayBuffer())})));

function stop_all() {
  bench.motions = [];
  ++bench.stops;
  begin_worker();
}

// ---- saving ---------------------------------------------------------------------------------------

const row_shown = () => data.rows[player.index];

async function save_as(suffix) {
  const {name, number} = row_shown();
  if (bench.busy) $('save-message').textContent = 'saved as soon as the motion in work is done';
  const {bytes, answer} = await ask({ask: 'save', number, suffix});
  $('save-message').textContent = bytes ? '' : answer.error;
  if (!bytes) return;
  const address = URL.createObjectURL(new Blob([bytes]));
  make('a', {href: address, download: `${name}.clean${suffix}`}).click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

// Updates the buttons. Playing needs the worker, so it is disabled while motions are cleaned.
function show_after() {
  for (const button of $('after').querySelectorAll('[data-suffix]')) button.disabled = !row_shown();
  $('begin-play').disabled = !row_shown() || bench.busy;
  $('save-message').textContent = '';
}

// Called by the page's last script, which has `connect`.
function begin_bench(connect) {
  document.title = 'mimicx';
  document.querySelector('h1').textContent = 'mimicx';
  document.body.classList.add('empty');
  $('status').after($('after'));
  $('after').hidden = false;
  const drop = $('drop');
  const over = (e) => { e.preventDefault(); drop.classList.add('over'); };
  addEventListener('dragover', over);
  addEventListener('dragleave', () => drop.classList.remove('over'));
  addEventListener('drop', () => drop.classList.remove('over'));
  dropped.others = take_files;
  $('choose').onclick = () => $('file').click();
  $('file').onchange = () => { take_files($('file').files); $('file').value = ''; };
  $('example').onclick = () => take_motions([{name: $('example-motion').dataset.name, read: () => unpacked('example-motion')}]);
  $('stop').onclick = stop_all;
  for (const button of $('after').querySelectorAll('[data-suffix]')) button.onclick = () => save_as(button.dataset.suffix);
  addEventListener('hashchange', () => { stop_playing(); show_after(); });
  bench.connect = connect;
  begin_worker();
}
