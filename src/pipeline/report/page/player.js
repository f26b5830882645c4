// The motions of one clip in one world: input where it was, reference, cleaned, truth; each can be switched off.

const view = {yaw: 0.5, pitch: 0.16, distance: 3.7};
const player = {clip: null, index: -1, frames: 0, time: 0, playing: false, last: 0, stale: true, motions: {}, ground: null,
                shown: {input: true, reference: false, cleaned: true, truth: false}, forces: true, centers: false,
                placing: 'beside'};
const tones = {};

// The colours of the style sheet as numbers, again whenever the scheme changes.
function read_tones() {
  for (const who of Object.keys(people)) tones[who] = rgb_of(style_value(`--${who}`));
  tones.floor = [rgb_of(style_value('--floor-a')), rgb_of(style_value('--floor-b'))];
  tones.sky = [style_value('--sky'), style_value('--horizon')];
  tones.shadow = style_value('--shadow');
  tones.force = style_value('--force');
  tones.ink = style_value('--ink');
  player.stale = true;
}

function frame_of(time) {
  return Math.min(Math.max(Math.floor(time * player.clip.fps), 0), Math.max(player.frames - 1, 0));
}

// Decodes a clip for the player. Frames past the end of a motion repeat its last one.
function take_clip(clip) {
  player.clip = clip;
  player.motions = {};
  for (const m of clip.motions)
    player.motions[m.who] = {frames: m.frames, radii: m.radii, ends: decode_ends(m.ends, m.radii.length),
                              centers: decode_numbers(m.centers, [3])};
  player.ground = clip.ground ? decode_numbers(clip.ground, [3]) : null;
  player.frames = Math.max(0, ...clip.motions.map((m) => m.frames));
  player.time = 0;
  player.stale = true;
}

// A capsule of a motion as {a, b, r}, m.
function capsule(who, frame, body, offset) {
  const m = player.motions[who], at = 6 * (Math.min(frame, m.frames - 1) * m.radii.length + body), s = 1e-3;
  return {a: [m.ends[at] * s + offset[0], m.ends[at + 1] * s + offset[1], m.ends[at + 2] * s],
          b: [m.ends[at + 3] * s + offset[0], m.ends[at + 4] * s + offset[1], m.ends[at + 5] * s], r: m.radii[body]};
}

const present = () => Object.keys(people).filter((who) => player.motions[who] && player.motions[who].frames > 0);
const visible = () => present().filter((who) => player.shown[who]);

// Side by side means across the view, wherever the camera stands.
function offset_of(who, shown) {
  if (player.placing !== 'beside') return [0, 0];
  const aside = 1.1 * (shown.indexOf(who) - (shown.length - 1) / 2);
  return [-aside * Math.sin(view.yaw), aside * Math.cos(view.yaw)];
}

function resize(canvas) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  const g = canvas.getContext('2d');
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  return {g, width, height};
}

function draw_forces(g, project, frame, offset) {
  const metres_per_newton = 0.9 / player.clip.weight;
  for (let k = 0; k < 3; ++k) {
    const [x, y, fx, fy, fz] = player.ground.subarray(15 * frame + 5 * k, 15 * frame + 5 * k + 5);
    if (fz <= 0) continue;
    const from = [1e-3 * x + offset[0], 1e-3 * y + offset[1], 0];
    draw_arrow(g, project, from, [from[0] + fx * metres_per_newton, from[1] + fy * metres_per_newton, fz * metres_per_newton], tones.force);
  }
}

function draw_scene(canvas) {
  const {g, width, height} = resize(canvas);
  const sky = g.createLinearGradient(0, 0, 0, height);
  tones.sky.forEach((tone, i) => sky.addColorStop(i, tone));
  g.fillStyle = sky;
  g.fillRect(0, 0, width, height);
  const shown = visible(), frame = frame_of(player.time);
  const leader = shown.includes('cleaned') ? 'cleaned' : shown[0] || present()[0];
  if (!leader) return;
  const pelvis = capsule(leader, frame, 0, [0, 0]);
  const centre = [(pelvis.a[0] + pelvis.b[0]) / 2, (pelvis.a[1] + pelvis.b[1]) / 2, 0.85];
  const project = camera(centre, view, width, height);
  draw_floor(g, project, centre, tones.floor);
  const parts = [];
  g.beginPath();
  for (const who of shown) {
    for (let body = 0; body < player.motions[who].radii.length; ++body) {
      const c = capsule(who, frame, body, offset_of(who, shown));
      add_shadow(g, project, c);
      const ghost = player.placing === 'over' && shown.length > 1 && who !== leader;
      parts.push({c, who, alpha: ghost ? 0.5 : 1, depth: project(c.a).depth + project(c.b).depth});
    }
  }
  g.fillStyle = tones.shadow;
  g.fill();
  parts.sort((p, q) => q.depth - p.depth);
  g.lineWidth = 0.8;
  for (const p of parts) draw_capsule(g, project, p.c, tones[p.who], p.alpha);
  for (const who of player.centers ? shown : []) {
    const m = player.motions[who], at = 3 * Math.min(frame, m.frames - 1), offset = offset_of(who, shown);
    draw_center(g, project, [1e-3 * m.centers[at] + offset[0], 1e-3 * m.centers[at + 1] + offset[1], 1e-3 * m.centers[at + 2]],
                `rgb(${tones[who].map((v) => Math.round(0.7 * v)).join()})`);
  }
  if (player.forces && player.ground && shown.includes('cleaned') && frame < player.motions.cleaned.frames)
    draw_forces(g, project, frame, offset_of('cleaned', shown));
}

// A box per motion to switch it on and off, with the height of its lowest point at the frame.
function show_layers() {
  const box = (name, on, change, color) => {
    const input = make('input', {type: 'checkbox', checked: on, onchange: () => { change(input.checked); player.stale = true; }});
    const label = make('label', {}, input, name);
    if (color) { label.style.setProperty('--swatch', `var(--${color})`); label.className = 'who'; label.dataset.who = color; }
    return label;
  };
  const layers = present().map((who) => box(people[who].name, player.shown[who], (on) => { player.shown[who] = on; }, who));
  if (player.ground) layers.push(box('forces of the floor', player.forces, (on) => { player.forces = on; }));
  layers.push(box('centre of mass', player.centers, (on) => { player.centers = on; }));
  $('layers').replaceChildren(...layers);
}

function set_playing(playing) {
  player.playing = playing;
  $('play').textContent = playing ? '❚❚ pause' : '▶ play';
}

function go_to_frame(frame) {
  if (!player.clip) return;
  set_playing(false);
  player.time = (Math.min(Math.max(frame, 0), Math.max(player.frames - 1, 0)) + 0.5) / player.clip.fps;
  player.stale = true;
}

function listen_to_view(canvas) {
  const turned = () => { player.stale = true; };
  canvas.onpointerdown = (e) => canvas.setPointerCapture(e.pointerId);
  canvas.onpointermove = (e) => {
    if (!e.buttons) return;
    view.yaw -= 0.008 * e.movementX;
    view.pitch = Math.min(1.5, Math.max(0.02, view.pitch + 0.006 * e.movementY));
    turned();
  };
  canvas.addEventListener('wheel', (e) => {
    e.preventDefault();
    view.distance = Math.min(20, Math.max(1.2, view.distance * Math.exp(0.001 * e.deltaY)));
    turned();
  }, {passive: false});
  new ResizeObserver(turned).observe(canvas);
}
