'use strict';
// Report of a run: player, metrics and curves. World z up, metres; one capsule per body.

const data = JSON.parse(document.getElementById('data').textContent);
const $ = (id) => document.getElementById(id);
const colours = {reference: [217, 130, 43], simulated: [43, 108, 176]};
const palette = ['#2b6cb0', '#d9822b', '#2a7d46', '#b3261e', '#7b4fa3', '#4d8f9e'];

// Capsule ends in millimetres, [frame][body][end][xyz], as little-endian int16 in base64.
function decode_motion(text) {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return new Int16Array(bytes.buffer);
}

const state = {clip: 0, time: 0, playing: true, yaw: 0.5, pitch: 0.16, distance: 3.7, last: 0};
let clip = null;
const motions = {reference: null, simulated: null};

// ---- geometry -------------------------------------------------------------------------------------

// A capsule of the motion as {a, b, r}; frames past the end repeat the last one.
function capsule(who, frame, body, offset) {
  const motion = motions[who], bodies = clip.radii.length;
  const last = motion.length / (6 * bodies) - 1;
  const at = 6 * (Math.min(frame, last) * bodies + body), m = 1e-3;
  return {a: [motion[at] * m + offset[0], motion[at + 1] * m + offset[1], motion[at + 2] * m],
          b: [motion[at + 3] * m + offset[0], motion[at + 4] * m + offset[1], motion[at + 5] * m],
          r: clip.radii[body]};
}

function camera(centre, width, height) {
  const cy = Math.cos(state.yaw), sy = Math.sin(state.yaw), cp = Math.cos(state.pitch), sp = Math.sin(state.pitch);
  const forward = [-cy * cp, -sy * cp, -sp], right = [-sy, cy, 0], up = [-cy * sp, -sy * sp, cp];
  const eye = centre.map((c, i) => c - state.distance * forward[i]);
  const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  const focal = 1.25 * height;
  return (p) => {
    const d = [p[0] - eye[0], p[1] - eye[1], p[2] - eye[2]], depth = dot(d, forward), s = focal / depth;
    return {x: width / 2 + s * dot(d, right), y: height * 0.52 - s * dot(d, up), depth, scale: s};
  };
}

// ---- drawing --------------------------------------------------------------------------------------

function draw_floor(g, project, centre) {
  const half = 9, x0 = Math.round(centre[0]), y0 = Math.round(centre[1]);
  for (let i = -half; i < half; ++i) {
    for (let j = -half; j < half; ++j) {
      const x = x0 + i, y = y0 + j;
      const fade = 1 - Math.hypot(x + 0.5 - centre[0], y + 0.5 - centre[1]) / half;
      const corners = [[x, y, 0], [x + 1, y, 0], [x + 1, y + 1, 0], [x, y + 1, 0]].map(project);
      if (fade <= 0 || corners.some((c) => c.depth < 0.15)) continue;
      g.fillStyle = (x + y) % 2 ? `rgba(196,205,216,${fade})` : `rgba(214,221,229,${fade})`;
      g.beginPath();
      for (const c of corners) g.lineTo(c.x, c.y);
      g.fill();
    }
  }
}

// Shadow of a vertical light: the capsule's footprint, added to the current path with one winding, so that
// overlapping footprints do not darken each other.
function add_shadow(g, project, c) {
  let dx = c.b[0] - c.a[0], dy = c.b[1] - c.a[1];
  const angle = Math.atan2(dy, dx), steps = 8;
  for (let k = 0; k <= 2 * steps + 1; ++k) {
    const end = k <= steps ? c.b : c.a;
    const turn = angle - Math.PI / 2 + Math.PI * (k <= steps ? k : k - 1) / steps;
    const p = project([end[0] + c.r * Math.cos(turn), end[1] + c.r * Math.sin(turn), 0]);
    if (k === 0) g.moveTo(p.x, p.y); else g.lineTo(p.x, p.y);
  }
  g.closePath();
}

// Outline of two circles and their common tangents, shaded across the axis.
function draw_capsule(g, project, c, rgb, alpha) {
  let a = project(c.a), b = project(c.b);
  if (a.depth < 0.15 || b.depth < 0.15) return;
  let ra = c.r * a.scale, rb = c.r * b.scale;
  const dx = b.x - a.x, dy = b.y - a.y, length = Math.hypot(dx, dy), along = Math.atan2(dy, dx);
  g.beginPath();
  if (length <= Math.abs(ra - rb)) {
    const big = ra > rb ? a : b;
    g.arc(big.x, big.y, Math.max(ra, rb), 0, 2 * Math.PI);
  } else {
    const tangent = Math.acos((ra - rb) / length);
    g.arc(a.x, a.y, ra, along + tangent, along - tangent + 2 * Math.PI);
    g.arc(b.x, b.y, rb, along - tangent, along + tangent);
  }
  g.closePath();
  const nx = length > 1e-6 ? -dy / length : 0, ny = length > 1e-6 ? dx / length : 1;
  const r = Math.max(ra, rb), lit = 0.5 + 0.3 * (nx * -0.45 + ny * -0.89);  // light from the upper left
  const mx = (a.x + b.x) / 2, my = (a.y + b.y) / 2;
  const shade = g.createLinearGradient(mx - nx * r, my - ny * r, mx + nx * r, my + ny * r);
  const tone = (k) => `rgba(${rgb.map((v) => Math.round(Math.min(255, v * k + (k > 1 ? 60 * (k - 1) : 0)))).join()},${alpha})`;
  shade.addColorStop(0, tone(0.68));
  shade.addColorStop(lit, tone(1.3));
  shade.addColorStop(1, tone(0.68));
  g.fillStyle = shade;
  g.fill();
  g.strokeStyle = `rgba(${rgb.map((v) => Math.round(v * 0.45)).join()},${0.55 * alpha})`;
  g.stroke();
}

function draw(canvas) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  const g = canvas.getContext('2d');
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  const sky = g.createLinearGradient(0, 0, 0, height);
  sky.addColorStop(0, '#e9eef4');
  sky.addColorStop(1, '#f8fafc');
  g.fillStyle = sky;
  g.fillRect(0, 0, width, height);

  const frame = Math.floor(state.time * clip.fps), placing = $('placing').value;
  const shown = Object.keys(motions).filter((who) => motions[who] && (!(placing in motions) || placing === who));
  // Side by side means across the view, wherever the camera stands.
  const aside = placing === 'beside' && shown.length === 2 ? 0.55 : 0;
  const offset = (who) => [1, -1].map((s, i) => (who === 'reference' ? -aside : aside) *
                                                (i ? Math.cos(state.yaw) : -Math.sin(state.yaw)));
  const leader = shown.includes('simulated') ? 'simulated' : shown[0];
  if (!leader) return;
  const pelvis = capsule(leader, frame, 0, [0, 0]);
  const centre = [(pelvis.a[0] + pelvis.b[0]) / 2, (pelvis.a[1] + pelvis.b[1]) / 2, 0.85];
  const project = camera(centre, width, height);
  draw_floor(g, project, centre);
  const parts = [];
  g.beginPath();
  for (const who of shown) {
    for (let body = 0; body < clip.radii.length; ++body) {
      const c = capsule(who, frame, body, offset(who));
      add_shadow(g, project, c);
      const ghost = placing === 'over' && who === 'reference';
      parts.push({c, who, alpha: ghost ? 0.45 : 1, depth: project(c.a).depth + project(c.b).depth});
    }
  }
  g.fillStyle = 'rgba(40,50,65,.28)';
  g.fill();
  parts.sort((p, q) => q.depth - p.depth);
  g.lineWidth = 0.8;
  for (const p of parts) draw_capsule(g, project, p.c, colours[p.who], p.alpha);
  $('time').textContent = `${state.time.toFixed(2)} s · frame ${frame} of 0–${clip.frames - 1}`;
}

// ---- what the reference asks for that no body has --------------------------------------------------

// Colours of Okabe and Ito, which colour-blind people tell apart; the height of a bar says how much.
const kinds = [
  {words: ['hovers', 'pulled'], colour: '#d55e00', name: 'up or down'},
  {words: ['drifts', 'slips'], colour: '#0072b2', name: 'sideways'},
  {words: ['turns', 'tips'], colour: '#e69f00', name: 'a turn'},
  {words: ['sunk'], colour: '#000000', name: 'in the floor'},
];
const feasible_colour = '#b4bcc6', help_colour = '#cc79a7';
const band = {inset: 8, row: 18, pointed: -1};  // the inset is half of a slider's thumb

const colour_of = (word) => (kinds.find((k) => k.words.includes(word)) || {colour: feasible_colour}).colour;

function band_x(frame, width) { return band.inset + (width - 2 * band.inset) * frame / Math.max(clip.frames - 1, 1); }

function band_frame(x, width) {
  const frame = Math.round((x - band.inset) / (width - 2 * band.inset) * Math.max(clip.frames - 1, 1));
  return Math.min(Math.max(frame, 0), clip.frames - 1);
}

const amount = (n, t) =>
    `${n.force[t].toFixed(0)} N (${n.acceleration[t].toFixed(1)} m/s²) and ${n.moment[t].toFixed(0)} N m`;

// "frame 61 (2.03 s): the reference is not feasible (hovers); 310 N (4.4 m/s²) and 12 N m would have to come …"
function need_in_words(frame) {
  let text = `frame ${frame} (${(frame / clip.fps).toFixed(2)} s): `;
  if (frame >= clip.needs.force.length) return text + 'behind the end of the reference';
  const word = clip.needs.wrong[frame];
  text += word === 'feasible' ? 'the reference is feasible' : `the reference is not feasible (${word})`;
  text += `; ${amount(clip.needs, frame)} would have to come from outside`;
  if (!clip.help || frame >= clip.help.force.length) return text;
  return text + `; in the soft stage ${amount(clip.help, frame)} helped the pelvis`;
}

function draw_band(current) {
  const canvas = $('band'), ratio = window.devicePixelRatio || 1, width = canvas.clientWidth;
  const height = band.row * (clip.help ? 2 : 1);
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const g = canvas.getContext('2d');
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  const wide = Math.max((width - 2 * band.inset) / Math.max(clip.frames - 1, 1), 1);
  const bars = (needs, foot, colour) => needs.bar.forEach((part, t) => {
    g.fillStyle = colour(t);
    const high = Math.max(g.fillStyle === feasible_colour ? 1 : 4, part * (band.row - 3));
    g.fillRect(band_x(t, width) - wide / 2, foot - high, wide, high);
  });
  bars(clip.needs, band.row, (t) => colour_of(clip.needs.wrong[t]));
  if (clip.help) bars(clip.help, 2 * band.row, () => help_colour);
  g.fillStyle = '#1d2530';
  g.fillRect(band_x(current, width) - 0.5, 0, 1, height);
}

// The band of the present clip and its key; nothing where the run recorded no needs.
function show_band() {
  band.pointed = -1;
  $('needs').hidden = !clip.needs;
  $('band').style.height = clip.needs ? `${band.row * (clip.help ? 2 : 1)}px` : '0';
  if (!clip.needs) return;
  const shown = kinds.filter((k) => k.words.some((w) => clip.needs.wrong.includes(w)));
  const keys = [{colour: feasible_colour, name: 'feasible'}, ...shown];
  if (clip.help) keys.push({colour: help_colour, name: 'help in the soft stage (lower row)'});
  $('need-key').replaceChildren('from outside; a full bar is half the weight or more:', ...keys.flatMap((k) => {
    const swatch = document.createElement('i');
    swatch.style.background = k.colour;
    return [swatch, k.name];
  }));
}

function update_band(current) {
  if (!clip.needs) return;
  draw_band(current);
  $('need').textContent = need_in_words(band.pointed < 0 ? current : band.pointed);
}

// ---- curves ---------------------------------------------------------------------------------------

const short = (v) => v === null ? '–'
    : Math.abs(v) >= 1e6 ? (v / 1e6).toFixed(2) + 'M'
    : v !== 0 && Math.abs(v) < 1e-3 ? v.toExponential(1) : String(Number(v.toPrecision(4)));
const fixed = (v) => v === null ? '–' : v.toFixed(2);

// lines: [{name, values}], all over the same xs. Returns the chart's element.
function chart(title, xs, x_unit, lines) {
  const known = lines.flatMap((l) => l.values).filter((v) => v !== null);
  const box = document.createElement('div');
  box.className = 'curve';
  const heading = document.createElement('h2');
  heading.textContent = title;
  box.append(heading);
  if (!known.length) { box.append('no values'); return box; }
  let low = Math.min(...known), high = Math.max(...known);
  if (high - low < 1e-12) { low -= 0.5 * Math.abs(low) + 1e-6; high += 0.5 * Math.abs(high) + 1e-6; }
  const last = xs[xs.length - 1] || 1, w = 300, h = 108;
  const X = (x) => w * x / last, Y = (y) => h - (h - 6) * (y - low) / (high - low);
  const ns = 'http://www.w3.org/2000/svg', svg = document.createElementNS(ns, 'svg');
  svg.setAttribute('viewBox', `0 0 ${w} 120`);
  svg.setAttribute('preserveAspectRatio', 'none');
  const add = (tag, attributes) => {
    const e = document.createElementNS(ns, tag);
    for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
    svg.append(e);
    return e;
  };
  for (const y of [low, high]) add('line', {x1: 0, x2: w, y1: Y(y), y2: Y(y), stroke: '#e3e7ec'});
  lines.forEach((line, n) => {
    let path = '', pen = 'M';
    line.values.forEach((v, i) => {
      if (v === null) return;  // what is measured now and then is joined up
      path += `${pen}${X(xs[i]).toFixed(2)} ${Y(v).toFixed(2)}`;
      pen = 'L';
    });
    add('path', {d: path, stroke: palette[n % palette.length], 'stroke-width': 1.5});
  });
  if (x_unit === 's') add('line', {x1: 0, x2: 0, y1: 0, y2: h, stroke: '#b3261e', class: 'cursor', 'data-w': w / last});
  box.append(svg);
  const key = document.createElement('div');
  key.className = 'key';
  key.textContent = `${short(low)} … ${short(high)} over ${short(last)} ${x_unit}, last ${short(known[known.length - 1])}`;
  if (lines.length > 1) {
    key.textContent = `${short(low)} … ${short(high)} over ${short(last)} ${x_unit}`;
    lines.forEach((line, n) => {
      const name = document.createElement('span');
      name.style.color = palette[n % palette.length];
      name.textContent = ` ${line.name}`;
      key.append(name);
    });
  }
  box.append(key);
  return box;
}

function show_curves() {
  $('clip-curves').replaceChildren(...clip.series.map((s) =>
      chart(s.title, s.values.map((_, i) => i * s.step), 's', [{name: s.title, values: s.values}])));
  const columns = clip.log.columns, at = columns.indexOf('samples');
  const values = (i) => clip.log.rows.map((row) => row[i]);
  const groups = new Map();  // columns "title:part" share one chart
  columns.forEach((name, i) => {
    if (name === 'iteration' || name === 'samples') return;
    const title = name.includes(':') ? name.split(':')[0] : name;
    if (!groups.has(title)) groups.set(title, []);
    groups.get(title).push({name: name.includes(':') ? name.split(':')[1] : name, values: values(i)});
  });
  $('training-curves').replaceChildren(...[...groups].map(([title, lines]) =>
      chart(title, at < 0 ? [] : values(at), 'samples', lines)));
}

// ---- the page -------------------------------------------------------------------------------------

function row_of(cells, tag) {
  const row = document.createElement('tr');
  for (const text of cells) {
    const cell = document.createElement(tag);
    cell.textContent = text;
    row.append(cell);
  }
  return row;
}

function show_clip(index) {
  state.clip = index;
  clip = data.sequences[index];
  for (const who of Object.keys(motions)) motions[who] = clip[who] ? decode_motion(clip[who]) : null;
  $('scrub').max = Math.max(clip.frames - 1, 0);
  $('status').textContent = clip.status + (clip.reason ? `: ${clip.reason}` : '');
  $('status').className = clip.status;
  $('metrics').replaceChildren(row_of(['', ...clip.metrics.columns], 'th'),
      ...clip.metrics.rows.map((r) => row_of([r.name, ...r.values.map(fixed)], 'td')));
  $('notes').replaceChildren(...clip.notes.map((text) => {
    const item = document.createElement('li');
    item.textContent = text;
    return item;
  }));
  show_curves();
  show_band();
  state.time = 0;
}

function set_playing(playing) {
  state.playing = playing;
  $('play').textContent = playing ? 'pause' : 'play';
}

function tick(now) {
  const step = Math.min((now - state.last) / 1000, 0.1);
  state.last = now;
  const length = clip.frames / clip.fps;
  if (state.playing && length > 0) state.time = (state.time + step * Number($('speed').value)) % length;
  $('scrub').value = Math.floor(state.time * clip.fps);
  for (const c of document.querySelectorAll('.cursor')) {
    c.setAttribute('x1', state.time * c.dataset.w);
    c.setAttribute('x2', state.time * c.dataset.w);
  }
  draw($('view'));
  update_band(Math.min(Math.floor(state.time * clip.fps), clip.frames - 1));
  requestAnimationFrame(tick);
}

function go_to_frame(frame) {
  set_playing(false);
  state.time = (Math.min(Math.max(frame, 0), clip.frames - 1) + 0.5) / clip.fps;
}

function listen() {
  $('clip').onchange = () => show_clip(Number($('clip').value));
  $('play').onclick = () => set_playing(!state.playing);
  $('scrub').oninput = () => go_to_frame(Number($('scrub').value));
  const strip = $('band');
  strip.onpointermove = (e) => { band.pointed = band_frame(e.offsetX, strip.clientWidth); };
  strip.onpointerleave = () => { band.pointed = -1; };
  strip.onclick = (e) => go_to_frame(band_frame(e.offsetX, strip.clientWidth));
  const view = $('view');
  view.onpointerdown = (e) => view.setPointerCapture(e.pointerId);
  view.onpointermove = (e) => {
    if (!e.buttons) return;
    state.yaw -= 0.008 * e.movementX;
    state.pitch = Math.min(1.5, Math.max(0.02, state.pitch + 0.006 * e.movementY));
  };
  view.addEventListener('wheel', (e) => {
    e.preventDefault();
    state.distance = Math.min(20, Math.max(1.2, state.distance * Math.exp(0.001 * e.deltaY)));
  }, {passive: false});
  document.onkeydown = (e) => {
    if (e.target.tagName === 'SELECT' || e.target.tagName === 'BUTTON') return;
    const frame = Math.floor(state.time * clip.fps);
    if (e.key === ' ') set_playing(!state.playing);
    else if (e.key === 'ArrowRight') go_to_frame(frame + 1);
    else if (e.key === 'ArrowLeft') go_to_frame(frame - 1);
    else return;
    e.preventDefault();
  };
}

data.sequences.forEach((s, i) => $('clip').append(new Option(s.name, i)));
listen();
// report.html#2,30 opens the third clip and stands at its frame 30.
const [start_clip, start_frame] = location.hash.slice(1).split(',').map(Number);
if (data.sequences.length) {
  show_clip(Math.min(start_clip || 0, data.sequences.length - 1));
  $('clip').value = state.clip;
  if (start_frame >= 0) go_to_frame(start_frame);
  requestAnimationFrame(tick);
}
