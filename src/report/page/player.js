// The motions of one clip in one world: input, reference, cleaned, truth; each can be switched off. Seen from
// anywhere, or by the clip's own camera.

const view = {yaw: 0.5, pitch: 0.16, distance: 3.3, pan: [0, 0], zoom: 1};
const player = {clip: null, index: -1, frames: 0, time: 0, playing: false, last: 0, stale: true, motions: {}, ground: null,
                torques: null, seen: null, box: null,
                shown: {input: true, reference: false, cleaned: true, truth: false}, placing: 'beside', from: 'around',
                layers: {forces: true, balance: false, loads: false, shapes: false, keypoints: true}};
const tones = {};

// The colours of the style sheet as numbers, read again when the colour scheme changes.
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
// @param bodies  of its file, by key
function take_clip(clip, bodies) {
  player.clip = clip;
  player.motions = {};
  for (const m of clip.motions) if (m.frames > 0) player.motions[m.who] = take_motion(m, bodies);
  player.ground = clip.ground ? decode_numbers(clip.ground, [3]) : null;
  player.torques = clip.torques ? decode_numbers(clip.torques, [2]) : null;
  player.seen = clip.camera ? decode_seen(clip.camera) : null;
  player.box = clip.camera ? box_of_clip() : null;
  player.frames = Math.max(0, ...clip.motions.map((m) => m.frames));
  player.time = 0;
  player.stale = true;
  Object.assign(view, {pan: [0, 0], zoom: 1});
}

const present = () => Object.keys(people).filter((who) => player.motions[who]);
const visible = () => present().filter((who) => player.shown[who]);
const as_camera_saw = () => player.from === 'camera' && player.clip.camera;
const skins_shown = () => !player.layers.shapes && can_paint();

function resize(canvas) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  const g = canvas.getContext('2d');
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  return {g, width, height, ratio};
}

// Parts of the canvas, each with its camera, the motions in it, and where these stand. Side by side means across the view
// around, and a picture for each of what a camera saw: the input by the camera that it was told.
function panels_of(width, height, shown, frame) {
  const beside = player.placing === 'beside', count = Math.max(shown.length, 1);
  if (as_camera_saw()) {
    const groups = beside && shown.length ? shown.map((who) => [who]) : [shown];
    const {camera} = player.clip, placed = (own, part) => clip_camera(own, frame, picture_shown(part), part);
    return groups.map((group, k) => {
      const part = {x: k * width / groups.length, y: 0, width: width / groups.length, height}, told = placed(camera.told || camera, part);
      return {part, shown: group, offsets: group.map(() => [0, 0]), camera: group.join() === 'input' ? told : placed(camera, part), of_input: told};
    });
  }
  const part = {x: 0, y: 0, width, height}, leader = shown.includes('cleaned') ? 'cleaned' : shown[0] || present()[0];
  if (!leader) return [];
  const pelvis = point_of(player.motions[leader], frame, 0, [0, 0, 0]);
  const offsets = shown.map((_, k) => {
    const aside = beside ? 1.1 * (k - (count - 1) / 2) : 0;
    return [-aside * Math.sin(view.yaw), aside * Math.cos(view.yaw)];
  });
  return [{part, shown, offsets, camera: orbit_camera([pelvis[0], pelvis[1], 0.85], view, part)}];
}

// Overlapping bodies are transparent; so is one whose joint torques are shown, and those in a camera view.
function alpha_of(who, panel) {
  if (player.layers.loads && player.torques && who === 'cleaned') return 0.45;
  if (as_camera_saw() && player.layers.keypoints) return 0.6;
  const leader = panel.shown.includes('cleaned') ? 'cleaned' : panel.shown[0];
  return player.placing === 'over' && panel.shown.length > 1 && who !== leader ? 0.5 : 1;
}

const camera_of = (who, panel) => who === 'input' && panel.of_input || panel.camera;
const figures_of = (panel, frame) => panel.shown.map((who, k) =>
    ({who, motion: player.motions[who], frame, offset: panel.offsets[k], rgb: tones[who], alpha: alpha_of(who, panel), camera: camera_of(who, panel)}));

const plates_of = (clip) => clip.plates || [];

// Sky, floor, shadows, the boxes of the scene and support polygons.
function draw_ground(g, panel, figures, frame) {
  const {part, camera} = panel, sky = g.createLinearGradient(0, 0, 0, part.height);
  tones.sky.forEach((tone, i) => sky.addColorStop(i, tone));
  g.fillStyle = sky;
  g.fillRect(part.x, part.y, part.width, part.height);
  const first = figures[0] ? point_of(figures[0].motion, frame, 0, [0, 0, 0]) : [0, 0, 0];
  draw_floor(g, camera.project, first, tones.floor);
  g.beginPath();
  for (const f of figures) for (const c of capsules_of(f.motion, frame, f.offset)) add_shadow(g, f.camera.project, c);
  g.fillStyle = tones.shadow;
  g.fill();
  const plates = plates_of(player.clip), places = new Map(figures.map((f) => [f.offset.join(), f]));
  for (const f of places.values()) draw_boxes(g, f.camera.project, plates, f.offset, tones.floor);
  if (!player.layers.balance) return;
  for (const f of figures) {
    if (!f.motion.support) continue;
    const feet = [7, 8].map((b) => point_of(f.motion, frame, b, [0, 0, 0])[2]), at = Math.min(frame, f.motion.frames - 1);
    draw_support(g, f.camera.project, f.motion.support[at], f.offset, f.rgb, (x, y) => ground_height(plates, x, y, Math.max(...feet)));
  }
}

function draw_shapes(g, panel, figures, frame) {
  const parts = figures.flatMap((f) => capsules_of(f.motion, frame, f.offset).map((c) => ({c, f})));
  for (const p of parts) p.depth = p.f.camera.project(p.c.a).depth + p.f.camera.project(p.c.b).depth;
  parts.sort((p, q) => q.depth - p.depth);
  g.lineWidth = 0.8;
  for (const p of parts) draw_capsule(g, p.f.camera.project, p.c, p.f.rgb, p.f.alpha);
}

function draw_forces(g, project, frame, offset) {
  const metres_per_newton = 0.9 / player.clip.weight;
  for (let k = 0; k < 3; ++k) {
    const [x, y, fx, fy, fz] = player.ground.subarray(15 * frame + 5 * k, 15 * frame + 5 * k + 5);
    if (fz <= 0) continue;
    const carrier = point_of(player.motions.cleaned, frame, [7, 8, 0][k], [0, 0, 0]);  // ankles; pelvis
    const height = ground_height(plates_of(player.clip), 1e-3 * x, 1e-3 * y, carrier[2] + 0.08);
    const from = [1e-3 * x + offset[0], 1e-3 * y + offset[1], height];
    draw_arrow(g, project, from, [from[0] + fx * metres_per_newton, from[1] + fy * metres_per_newton, height + fz * metres_per_newton], tones.force);
  }
}

// Torques of the joints of a frame, 1 = the bound. Frame 0 ends no interval, so it shows those of frame 1.
function loads_at(frame) {
  const t = Math.min(Math.max(frame, 1), player.torques.length / body_count - 1);
  return Array.from(player.torques.subarray(t * body_count, (t + 1) * body_count), (n) => 1e-3 * n);
}

function draw_marks(g, figures, frame) {
  for (const f of figures) {
    const {project} = f.camera;
    const at = 3 * Math.min(frame, f.motion.frames - 1), {centers} = f.motion;
    if (player.layers.balance)
      draw_center(g, project, [1e-3 * centers[at] + f.offset[0], 1e-3 * centers[at + 1] + f.offset[1], 1e-3 * centers[at + 2]],
                  `rgb(${f.rgb.map((v) => Math.round(0.7 * v)).join()})`);
    if (f.who !== 'cleaned' || frame >= f.motion.frames) continue;
    if (player.layers.loads && player.torques)
      draw_loads(g, project, Array.from({length: body_count}, (_, b) => point_of(f.motion, frame, b, [0, 0, 0], f.offset)), loads_at(frame));
    if (player.layers.forces && player.ground) draw_forces(g, project, frame, f.offset);
  }
}

// The name of the motion, where each has its own picture.
function draw_title(g, panel) {
  g.font = '600 13px system-ui, sans-serif';
  g.fillStyle = `rgb(${tones[panel.shown[0]].join()})`;
  g.fillText(people[panel.shown[0]].name, panel.part.x + 10, 20);
}

function draw_scene(canvas) {
  const {g, width, height, ratio} = resize(canvas);
  if (!width || !height) return;  // not on the screen
  const frame = frame_of(player.time), panels = panels_of(width, height, visible(), frame), skins = skins_shown();
  const scenes = panels.map((panel) => ({panel, figures: figures_of(panel, frame)}));
  const within = (part, draw) => {
    g.save();
    g.beginPath();
    g.rect(part.x, part.y, part.width, part.height);
    g.clip();
    draw();
    g.restore();
  };
  g.clearRect(0, 0, width, height);
  if (skins) begin_painting(width, height, ratio);
  for (const {panel, figures} of scenes) {
    within(panel.part, () => {
      draw_ground(g, panel, figures, frame);
      if (!skins) draw_shapes(g, panel, figures, frame);
    });
    if (skins) paint_skins(figures, panel.part);
  }
  if (skins) g.drawImage(painter.canvas, 0, 0, width, height);
  for (const {panel, figures} of scenes) {
    within(panel.part, () => {
      if (as_camera_saw()) {
        draw_edge(g, panel.camera);
        if (player.layers.keypoints) draw_seen(g, panel, frame);
      }
      draw_marks(g, figures, frame);
      if (panels.length > 1) draw_title(g, panel);
    });
  }
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
