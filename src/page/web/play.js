// Interactive simulation of a cleaned motion: the worker simulates frame by frame, and the report's player shows the frames
// beside the plan, as a clip that is filled in while it plays.

const play = {on: false, held: false, motion: null, due: 0, asked: false, frame: 0, key: null};

const names_of_people = Object.fromEntries(Object.entries(people).map(([who, {name}]) => [who, name]));

// ---- a clip that is filled in ---------------------------------------------------------------------

function empty_motion(frames, body) {
  return {frames, body, turns: new Float32Array(9 * frames * body_count), places: new Float32Array(3 * frames * body_count),
          centers: new Int32Array(3 * frames), support: Array.from({length: frames}, () => [])};
}

// Stores a new frame in the clip. The first frame is also used for all frames that are still missing.
function put_frame({frame, clip}, bodies) {
  const one = take_motion(clip.motions[0], bodies), {motion} = play;
  motion.body = one.body;
  for (let t = frame; t < (frame === 0 ? motion.frames : frame + 1); ++t) {
    motion.turns.set(one.turns, 9 * t * body_count);
    motion.places.set(one.places, 3 * t * body_count);
    motion.centers.set(one.centers, 3 * t);
    motion.support[t] = one.support[0];
    player.ground.set(decode_numbers(clip.ground, [3]), 15 * t);
    player.torques.set(decode_numbers(clip.torques, [2]), body_count * t);
  }
  play.frame = frame;
}

function show_played(played, bodies) {
  put_frame(played, bodies);
  player.clip.weight = played.clip.weight;
  player.time = (played.frame + 0.5) / player.clip.fps;
  player.stale = true;
  $('floor-said').textContent = `the floor carries ${short(Math.max(Math.round(played.floor_N), 0))} N of ${short(Math.round(played.clip.weight))} N`;
  $('audit-said').textContent = `unexplained force: ${short(played.unexplained_N)} N, ${short(played.unexplained_Nm)} N·m`;
  $('distance-said').textContent = played.distance_mm === null ? 'the simulation went wrong'
      : `farthest body: ${Math.round(played.distance_mm)} mm from the reference`;
  Object.assign(play, {distance: played.distance_mm, unexplained: played.unexplained_N, floor: played.floor_N});
}

// ---- beginning and ending -------------------------------------------------------------------------

function show_betas(betas) {
  $('betas').replaceChildren(...betas.map(({name, value}) => {
    const said = make('output', {}, value.toFixed(1));
    const input = make('input', {type: 'range', min: -3, max: 3, step: 0.1, value, 'aria-label': name,
                                 oninput: () => { said.textContent = Number(input.value).toFixed(1); }, onchange: change_shape});
    return make('label', {}, name, input, said);
  }));
}

async function begin_playing() {
  const index = player.index, {answer} = await ask({ask: 'play', number: row_shown().number});
  if (answer.error) { $('play-message').textContent = $('save-message').textContent = answer.error; return; }
  if (index !== player.index || play.on || bench.busy) return;
  const planned = player.motions.cleaned, frames = answer.played.frames;
  set_playing(false);
  Object.assign(play, {on: true, held: false, asked: false, due: performance.now(), own: answer.betas.map((b) => b.value)});
  play.motion = empty_motion(frames, planned.body);
  play.shown = {...player.shown};
  Object.assign(player.shown, {reference: true, cleaned: true, input: false, truth: false});
  Object.assign(people.reference, {name: 'as it was planned'});
  Object.assign(people.cleaned, {name: 'simulated now'});
  player.clip = {...player.clip, camera: null, needs: null, help: null, options: null, charts: [], bars: []};
  Object.assign(player, {motions: {reference: planned, cleaned: play.motion}, frames, seen: null,
                         ground: new Int32Array(15 * frames), torques: new Int32Array(body_count * frames)});
  show_played(answer.played, answer.bodies);
  show_betas(answer.betas);
  $('controller').value = '0';
  $('friction').value = 1;
  say_sliders();
  show_layers();
  show_timeline();
  show_panel();
  $('view').focus({preventScroll: true});  // a space would press the button again
  requestAnimationFrame(live_on);
}

function show_panel() {
  document.body.classList.toggle('playing', play.on);
  $('play-panel').hidden = !play.on;
  $('begin-play').textContent = play.on ? 'back to the clip' : 'play with it';
  $('begin-play').setAttribute('aria-pressed', play.on);
  $('live').textContent = play.held ? '▶ go on' : '❚❚ hold';
  $('play-message').textContent = '';
}

function stop_playing() {
  if (!play.on) return;
  play.on = false;
  for (const [who, name] of Object.entries(names_of_people)) people[who].name = name;
  Object.assign(player.shown, play.shown);
  show_panel();
  if (arrived.has(player.index)) show_loaded(...arrived.get(player.index));
}

// ---- while it goes on -----------------------------------------------------------------------------

// Requests each frame when it is due, or as fast as possible if the program is slower than real time.
async function live_on(now) {
  if (!play.on) return;
  requestAnimationFrame(live_on);
  if (play.held || play.asked || now < play.due) return;
  play.due = Math.max(play.due + 1000 / player.clip.fps, now - 100);
  await step_once();
}

async function step_once() {
  play.asked = true;
  const {answer} = await ask({ask: 'step'});
  play.asked = false;
  if (!play.on) return;
  if (answer.error) { $('play-message').textContent = answer.error; play.held = true; return; }
  show_played(answer);
}

async function change(what) {
  const {answer} = await ask(what);
  $('play-message').textContent = answer.error || '';
  return answer;
}

// Directions of pushes as seen on the screen.
const directions = {right: [-Math.sin, Math.cos], left: [Math.sin, (a) => -Math.cos(a)],
                    away: [(a) => -Math.cos(a), (a) => -Math.sin(a)], near: [Math.cos, Math.sin]};
function push_towards(side) {
  const speed = Number($('push-speed').value);
  return change({ask: 'push', change: [...directions[side].map((f) => speed * f(view.yaw)), 0]});
}

async function change_shape() {
  const inputs = [...$('betas').querySelectorAll('input')];
  const answer = await change({ask: 'shape', betas: inputs.map((input) => Number(input.value))});
  if (!answer.error) show_played(answer.played, answer.bodies);
}

async function take_own_shape() {
  [...$('betas').querySelectorAll('label')].forEach((label, k) => {
    label.querySelector('input').value = play.own[k];
    label.querySelector('output').textContent = play.own[k].toFixed(1);
  });
  const answer = await change({ask: 'shape', betas: null});
  if (!answer.error) show_played(answer.played, answer.bodies);
}

function say_sliders() {
  $('push-speed-said').textContent = `${Number($('push-speed').value).toFixed(1)} m/s`;
  $('friction-said').textContent = Number($('friction').value).toFixed(2);
}

function hold_or_go_on() {
  Object.assign(play, {held: !play.held, due: performance.now()});
  show_panel();
}

async function restart() {
  const answer = await change({ask: 'restart'});
  if (!answer.error) show_played(answer);
}

const play_keys = {
  ArrowLeft: () => push_towards('left'), ArrowRight: () => push_towards('right'),
  ArrowUp: () => push_towards('away'), ArrowDown: () => push_towards('near'),
  ' ': hold_or_go_on, Home: restart, End: () => {}, Escape: stop_playing,
};

// Handles keys before the player does, which would change frames. A focused element keeps the keys that it needs, and a
// key that is held down gives one push.
function on_play_key(e) {
  const act = play_keys[e.key], tag = e.target.tagName;
  const ours = e.repeat ? play.key === e.key : play.on && act && !e.ctrlKey && !e.metaKey && !e.altKey;
  play.key = ours ? e.key : null;
  if (!ours) return;
  e.stopPropagation();
  const needed = tag === 'SELECT' || tag === 'INPUT' || (e.key === ' ' && (tag === 'BUTTON' || tag === 'SUMMARY'));
  if (needed && e.key !== 'Escape') return;
  e.preventDefault();
  if (!e.repeat) act();
}

function begin_play_panel() {
  $('begin-play').onclick = () => { if (play.on) stop_playing(); else begin_playing(); };
  addEventListener('keydown', on_play_key, true);
  $('live').onclick = hold_or_go_on;
  $('restart').onclick = restart;
  $('controller').onchange = () => change({ask: 'controller', which: Number($('controller').value)});
  $('friction').oninput = $('push-speed').oninput = say_sliders;
  $('friction').onchange = () => change({ask: 'friction', friction: Number($('friction').value)});
  $('own-shape').onclick = take_own_shape;
  for (const button of $('pushes').querySelectorAll('[data-push]')) button.onclick = () => push_towards(button.dataset.push);
}
