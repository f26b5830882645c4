// Plots of lines over an axis, as SVG that grows with its column. A line under the pointer follows the player.

function svg(tag, attributes, ...children) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

// Round numbers from at most `low` to at least `high`, about `count` of them.
function nice_ticks(low, high, count) {
  if (!(high > low)) {  // a constant value is in the middle, or on zero
    const room = Math.abs(low) || 1;
    high = low < 0 ? 0 : low + room;
    low = low < 0 ? low - room : 0;
  }
  const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((f) => f * power >= raw * 0.999);
  const first = Math.floor(low / step + 1e-9), last = Math.ceil(high / step - 1e-9);
  return Array.from({length: last - first + 1}, (_, i) => Number(((first + i) * step).toPrecision(12)));
}

const plot = {width: 380, height: 190, left: 46, right: 10, top: 10, bottom: 34};

// The path of the known values, with gaps at unknown ones, or joined over them.
function path_of(xs, values, X, Y, join) {
  let path = '', pen = 'M';
  values.forEach((v, i) => {
    if (v === null) { if (!join) pen = 'M'; return; }
    path += `${pen}${X(xs[i]).toFixed(1)} ${Y(v).toFixed(1)}`;
    if (pen === 'M') path += 'h.01';  // a value without neighbours is a dot
    pen = 'L';
  });
  return path;
}

// The area between a line's `least` and `most`, a closed path per stretch of known values.
function band_of(xs, line, X, Y) {
  let path = '';
  for (let first = 0; first < line.least.length; ++first) {
    if (line.least[first] === null) continue;
    let end = first;
    while (end < line.least.length && line.least[end] !== null) ++end;
    const corner = (v, k) => `${X(xs[first + k]).toFixed(1)} ${Y(v).toFixed(1)}`;
    const upper = line.most.slice(first, end).map(corner), lower = line.least.slice(first, end).map(corner);
    path += `M${upper.concat(lower.reverse()).join('L')}Z`;
    first = end;
  }
  return path;
}

function axes(picture, chart, ticks, X, Y) {
  const {width, height, left, right, bottom} = plot, low = height - bottom;
  for (const v of ticks.y)
    picture.append(svg('line', {x1: left, x2: width - right, y1: Y(v), y2: Y(v), class: v === 0 ? 'grid zero' : 'grid'}),
                   svg('text', {x: left - 5, y: Y(v) + 4, 'text-anchor': 'end'}, tick_text(v)));
  for (const v of ticks.x)
    if (X(v) < width - right + 1)
      picture.append(svg('line', {x1: X(v), x2: X(v), y1: low, y2: low + 4, class: 'grid'}),
                     svg('text', {x: X(v), y: low + 15, 'text-anchor': 'middle'}, tick_text(v)));
  picture.append(svg('text', {x: (left + width - right) / 2, y: height - 3, 'text-anchor': 'middle', class: 'axis'},
                     chart.x ? 'samples' : 'time, s'));
}

function legend_of(lines, index_of) {
  return make('div', {className: 'legend'}, ...lines.filter((l) => l.name).map((line) => {
    const look = svg('svg', {viewBox: '0 0 26 8', class: 'swatch'});
    look.append(svg('path', {d: 'M0 4H26', class: 'curve', style: look_of(line, index_of(line))}));
    return make('span', {}, look, line.name);
  }));
}

const look_of = (line, index) =>
    `stroke: ${colour_of(line.who, index)}; stroke-dasharray: ${(line.who ? people[line.who].dash : other_dashes[index % other_dashes.length]) || 'none'}`;

// {title: {words, unit, meaning}, lines: [{who, name, values}], step, start} or with x instead of step.
function chart_of(chart, on_time) {
  const xs = chart.x || chart.lines[0].values.map((_, i) => chart.start + i * chart.step);
  const longest = chart.lines.reduce((a, l) => Math.max(a, l.values.length), 0);
  while (!chart.x && xs.length < longest) xs.push(chart.start + xs.length * chart.step);
  const box = make('figure', {className: 'card'},
      make('figcaption', {title: chart.title.meaning}, with_unit(chart.title.words, chart.title.unit && `(${chart.title.unit})`)));
  const values = known(chart.lines.flatMap((l) => l.values.concat(l.least || [], l.most || [])));
  if (!values.length) { box.append(make('p', {className: 'hint'}, 'no values')); return box; }
  const low = values.reduce((a, v) => Math.min(a, v), Infinity), high = values.reduce((a, v) => Math.max(a, v), -Infinity);
  const ticks = {y: nice_ticks(low, high, 4), x: nice_ticks(xs[0], xs[xs.length - 1], 5)};
  const {width, height, left, right, top, bottom} = plot;
  const y0 = ticks.y[0], y1 = ticks.y[ticks.y.length - 1], x0 = xs[0], x1 = xs[xs.length - 1] > x0 ? xs[xs.length - 1] : x0 + 1;
  const X = (x) => left + (width - left - right) * (x - x0) / (x1 - x0);
  const Y = (y) => height - bottom - (height - top - bottom) * (y - y0) / (y1 - y0);
  const picture = svg('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': chart.title.words});
  axes(picture, chart, {...ticks, x: ticks.x.filter((v) => v >= x0)}, X, Y);
  // Lines that belong to no motion have their own dashes; beside lines of motions the first dash is not used.
  const rank = new Map();
  for (const line of chart.lines) if (!line.who) rank.set(line, rank.size + (chart.lines[0].who ? 1 : 0));
  for (const line of chart.lines)
    if (line.least)
      picture.append(svg('path', {d: band_of(xs, line, X, Y), class: 'band',
                                  style: `fill: ${colour_of(line.who, rank.get(line))}`}));
  for (const line of chart.lines)
    picture.append(svg('path', {d: path_of(xs, line.values, X, Y, Boolean(chart.x)), class: 'curve',
                                style: look_of(line, rank.get(line))}));
  const cursor = svg('line', {y1: top, y2: height - bottom, class: 'cursor', visibility: 'hidden'});
  picture.append(cursor);
  const reading = make('p', {className: 'hint reading'}, chart.title.meaning || '\u00a0');
  const place = (t) => { cursor.setAttribute('x1', X(t)); cursor.setAttribute('x2', X(t)); cursor.setAttribute('visibility', 'visible'); };
  const at = (event) => {
    const area = picture.getBoundingClientRect();
    return Math.min(Math.max(x0 + ((event.clientX - area.left) / area.width * width - left) / (width - left - right) * (x1 - x0), x0), x1);
  };
  picture.addEventListener('pointermove', (event) => {
    const t = at(event), i = xs.reduce((best, x, k) => Math.abs(x - t) < Math.abs(xs[best] - t) ? k : best, 0);
    reading.textContent = `at ${short(xs[i])} ${chart.x ? 'samples' : 's'}: ` +
        chart.lines.map((l) => `${l.name ? `${l.name} ` : ''}${with_unit(short(l.values[i]), chart.title.unit)}`).join(', ');
    if (chart.x) place(t);
  });
  picture.addEventListener('pointerleave', () => {
    reading.textContent = chart.title.meaning || '\u00a0';
    if (chart.x) cursor.setAttribute('visibility', 'hidden');
  });
  if (!chart.x) {
    picture.addEventListener('click', (event) => on_time(at(event)));
    box.at_time = place;
  }
  box.append(picture, legend_of(chart.lines, (l) => rank.get(l)), reading);
  return box;
}
