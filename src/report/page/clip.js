// One clip: loads its data from the page or from its file, and shows it.

const arrived = new Map();  // data of clip files, by index

// Called by the clip files beside the page.
function mimicx_clip(name, clip, bodies) { arrived.set(data.rows.findIndex((row) => row.name === name), [clip, bodies]); }

// @param take  called with the clip and the bodies of its file @param fail  called with what is wrong with the file
function load_clip(index, take, fail) {
  const row = data.rows[index];
  if (row.embedded) { take(JSON.parse($(`clip-${index}`).textContent)); return; }
  if (arrived.has(index)) { take(...arrived.get(index)); return; }
  const path = `report/${row.name.split('/').map(encodeURIComponent).join('/')}.js`;
  const came = () => {
    if (arrived.has(index)) take(...arrived.get(index));
    else fail(`${path} is broken: it does not have this clip`);
  };
  const missing = () => fail(`${path} is not there: it belongs beside this page`);
  document.head.append(make('script', {src: path, onload: came, onerror: missing}));
}

function metrics_table(row) {
  const trained = row.values.some((v) => v[between] !== null);
  const heads = ['', 'unit', 'input', ...(trained ? ['before training'] : []), 'cleaned'];
  const body = groups.flatMap((group) => [
    make('tr', {}, make('th', {colSpan: heads.length, className: 'group', scope: 'colgroup'}, group)),
    ...data.metrics.map((m, k) => ({...m, values: row.values[k]})).filter((m) => m.group === group && known(m.values).length)
        .map((m) => {
          const better = better_of(m.values[before], m.values[after]);
          const cell = (value, good) => make('td', {className: good ? 'better' : ''}, short(value));
          return make('tr', {title: `${m.key}: ${m.meaning}`}, make('th', {scope: 'row'}, m.words), make('td', {}, m.unit),
                      cell(m.values[before], better < 0), ...(trained ? [cell(m.values[between], false)] : []),
                      cell(m.values[after], better > 0));
        })]);
  return [make('thead', {}, make('tr', {}, ...heads.map((h) => make('th', {scope: 'col'}, h)))), make('tbody', {}, ...body)];
}

function facts_list(facts) {
  return [...new Set(facts.map((f) => f.group))].map((group) => make('details', {}, make('summary', {}, group),
      make('table', {}, ...facts.filter((f) => f.group === group).map((f) =>
          make('tr', {title: f.meaning}, make('th', {scope: 'row'}, f.words), make('td', {}, with_unit(short(f.value), f.unit)))))));
}

// What is known of a clip before its data are there.
function show_row(index) {
  const row = data.rows[index];
  player.index = index;
  player.clip = null;
  $('clip-name').textContent = row.name;
  $('clip').value = index;
  $('status').textContent = row.ok ? `✓ cleaned, by ${row.made_by}` : `✗ failed: ${row.reason}`;
  $('status').className = row.ok ? 'ok' : 'failed';
  $('stage').hidden = $('training').hidden = true;
  for (const id of ['charts', 'training-charts', 'facts', 'notes']) $(id).replaceChildren();
  $('metrics').replaceChildren(...metrics_table(row));
}

function show_loaded(clip, bodies) {
  take_clip(clip, bodies);
  $('clip-message').textContent = '';
  $('stage').hidden = !clip.motions.length;
  show_layers();
  show_timeline();
  $('charts').replaceChildren(...clip.charts.map((c) => chart_of(c, (t) => go_to_frame(Math.round(t * clip.fps)))));
  $('training').hidden = !clip.training.length;
  $('training-charts').replaceChildren(...clip.training.map((c) => chart_of(c)));
  $('facts').replaceChildren(...facts_list(clip.facts));
  $('notes').replaceChildren(...clip.notes.map((text) => make('li', {}, text)));
}

function show_clip(index, ready) {
  show_row(index);
  $('clip-message').textContent = 'loading …';
  const waits = () => player.index === index && !player.clip;  // no other clip was chosen meanwhile
  load_clip(index, (clip, bodies) => {
    if (!waits()) return;
    show_loaded(clip, bodies);
    ready();
  }, (why) => { if (waits()) $('clip-message').textContent = why; });
}
