// The first page: facts about the run, a table of all clips, and the distributions of the metrics before and after.

const groups = [...new Set(data.metrics.map((m) => m.group))];
const overview = {group: groups[0], sort: {column: 'status', down: false}, filter: ''};
const before = 0, between = 1, after = 2;  // the three values of a metric: input, before training, cleaned

const metrics_shown = () => data.metrics.map((m, k) => ({...m, k})).filter((m) => m.group === overview.group);

// The better of two values; for every metric smaller is better. 0: neither.
function better_of(a, b) {
  if (a === null || b === null || a === b) return 0;
  return a < b ? -1 : 1;
}

function show_run() {
  $('run').replaceChildren(...data.run.map((fact) => make('div', {}, make('dt', {}, fact.name), make('dd', {}, fact.value))));
}

// ---- the table --------------------------------------------------------------------------------------

function columns() {
  return [
    {key: 'name', title: 'clip', value: (row) => row.name},
    {key: 'status', title: 'result', value: (row, i) => (row.ok ? 1e6 : 0) + i, first: true},
    {key: 'seconds', title: 'length', unit: 's', meaning: 'of the motion', value: (row) => row.seconds},
    ...metrics_shown().map((m) => ({key: m.key, title: m.words, unit: m.unit, meaning: m.meaning, metric: m,
                                    value: (row) => row.values[m.k][after] ?? row.values[m.k][before]})),
    {key: 'reward', title: 'reward', meaning: 'mean over the frames; 1 is the reference itself',
     value: (row) => row.reward},
  ];
}

function sorted_rows() {
  const column = columns().find((c) => c.key === overview.sort.column) || columns()[1];
  const order = data.rows.map((row, i) => ({row, i, value: column.value(row, i)}))
      .filter(({row}) => row.name.toLowerCase().includes(overview.filter));
  const compare = (a, b) => a.value === b.value ? a.i - b.i
      : a.value === null ? 1 : b.value === null ? -1
      : (a.value < b.value ? -1 : 1) * (overview.sort.down ? -1 : 1);
  return order.sort(compare);
}

function sort_by(key) {
  overview.sort = {column: key, down: overview.sort.column === key && !overview.sort.down};
  show_table();
}

function head_cell(column) {
  const sorted = overview.sort.column === column.key;
  const arrow = sorted ? (overview.sort.down ? ' ▾' : ' ▴') : '';
  const button = make('button', {className: 'sort', onclick: () => sort_by(column.key)}, column.title + arrow);
  if (column.meaning) button.title = `${column.metric ? `${column.key}: ` : ''}${column.meaning}`;
  const cell = make('th', {scope: 'col'}, button);
  if (sorted) cell.setAttribute('aria-sort', overview.sort.down ? 'descending' : 'ascending');
  if (column.unit) cell.append(make('small', {}, column.unit));
  return cell;
}

// A floating input neither slides nor sinks, so its value is meaningless.
const only_on_floor = ['FS', 'FS_0', 'GP', 'GP_max'];
function hangs(row, metric) {
  const float = data.metrics.findIndex((m) => m.key === 'Float');
  return only_on_floor.includes(metric.key) && row.values[metric.k][before] === 0 && row.values[float][before] > 5;
}

// "64.8 → 0.02 ✓": the better one is bold; the check mark stands where cleaning made it better.
function pair_cells(index, metric, values) {
  const better = better_of(values[before], values[after]);
  const number = (which, value) => {
    const mine = which === 'input' ? better < 0 : better > 0;
    const span = make('span', {className: `number ${mine ? 'better' : ''}`}, short(value));
    Object.assign(span.dataset, {clip: index, metric: metric.key, which, value: value ?? ''});
    return span;
  };
  const [sign, tell] = hangs(data.rows[index], metric) ? ['◦', 'the input hangs in the air, where nothing can slide or sink']
      : better > 0 ? ['✓', 'the cleaned motion is better'] : better < 0 ? ['✗', 'the input is better'] : ['', ''];
  const mark = make('span', {className: `mark ${sign === '✓' ? 'ok' : sign === '✗' ? 'failed' : ''}`, title: tell}, sign);
  return make('td', {}, number('input', values[before]), make('span', {className: 'arrow'}, ' → '),
              number('cleaned', values[after]), mark);
}

function table_row(row, index) {
  const link = make('a', {href: `#${index}`}, row.name);
  const result = make('td', {className: row.ok ? 'ok' : 'failed'}, row.ok ? '✓ cleaned' : '✗ failed');
  if (row.reason) result.append(make('div', {className: 'reason'}, row.reason));
  const line = make('tr', {}, make('th', {scope: 'row'}, link), result,
                    make('td', {}, row.frames ? short(row.seconds) : '–'),
                    ...metrics_shown().map((m) => pair_cells(index, m, row.values[m.k])),
                    make('td', {}, short(row.reward)));
  line.dataset.clip = index;
  return line;
}

function show_table() {
  const rows = sorted_rows();
  $('clips').replaceChildren(make('thead', {}, make('tr', {}, ...columns().map(head_cell))),
                             make('tbody', {}, ...rows.map(({row, i}) => table_row(row, i))));
}

function show_groups() {
  $('groups').replaceChildren(...groups.map((group) => {
    const button = make('button', {onclick: () => { overview.group = group; show_overview(); }}, group);
    button.setAttribute('aria-pressed', group === overview.group);
    return button;
  }));
}

// ---- distributions of the metrics ---------------------------------------------------------------------

const known = (values) => values.filter((v) => v !== null);
function median(values) {
  const sorted = [...values].sort((a, b) => a - b), n = sorted.length;
  return n === 0 ? null : n % 2 ? sorted[(n - 1) / 2] : (sorted[n / 2 - 1] + sorted[n / 2]) / 2;
}

// A dot per clip on an axis from 0: the inputs above, the cleaned below; a bar at the median.
function spread_of(metric) {
  const width = 340, left = 56, right = 14, height = 78;
  const of = (which) => data.rows.map((row) => row.values[metric.k][which]);
  const all = known([...of(before), ...of(after)]);
  const box = make('figure', {className: 'card'},
                   make('figcaption', {title: `${metric.key}: ${metric.meaning}`}, with_unit(metric.words, metric.unit && `(${metric.unit})`)));
  if (!all.length) { box.append(make('p', {className: 'hint'}, 'no values')); return box; }
  const ticks = nice_ticks(0, Math.max(...all) || 1, 4), most = Math.max(ticks[ticks.length - 1], ...all);
  const x = (v) => left + (width - left - right) * v / most;
  const picture = svg('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img',
                              'aria-label': `${metric.words}: median ${short(median(known(of(before))))} before, ${short(median(known(of(after))))} after`});
  for (const tick of ticks) {
    picture.append(svg('line', {x1: x(tick), x2: x(tick), y1: 6, y2: 56, class: 'grid'}),
                   svg('text', {x: x(tick), y: 70, 'text-anchor': 'middle'}, tick_text(tick)));
  }
  for (const [which, y, who] of [[before, 20, 'input'], [after, 43, 'cleaned']]) {
    picture.append(svg('text', {x: left - 8, y: y + 4, 'text-anchor': 'end'}, who));
    const values = of(which), middle = median(known(values));
    values.forEach((v, i) => {
      if (v === null) return;
      const dot = svg('circle', {cx: x(v), cy: y, r: data.rows.length > 100 ? 2 : 4, class: 'dot', style: `fill: var(--${who})`});
      dot.append(svg('title', {}, `${data.rows[i].name}: ${with_unit(short(v), metric.unit)}`));
      dot.addEventListener('click', () => { location.hash = `#${i}`; });
      picture.append(dot);
    });
    if (middle !== null) picture.append(svg('line', {x1: x(middle), x2: x(middle), y1: y - 9, y2: y + 9, class: 'median'}));
  }
  const medians = [before, after].map((which) => short(median(known(of(which)))));
  box.append(picture, make('p', {className: 'hint'}, `median ${medians[0]} → ${with_unit(medians[1], metric.unit)}`));
  return box;
}

function show_overview() {
  show_groups();
  show_table();
  $('spreads').replaceChildren(...metrics_shown().map(spread_of));
}
