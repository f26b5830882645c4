// The rows under the player: the slider, flaws and contacts of the feet in the colour of their motion, and external
// forces that the reference would need.

// The faults of the reference's frames, a colour each; the height of a bar is the amount.
const kinds = [
  {words: ['hovers', 'pulled'], colour: '--line-0', name: 'up or down'},
  {words: ['drifts', 'slips'], colour: '--line-1', name: 'sideways'},
  {words: ['turns', 'tips'], colour: '--line-2', name: 'a turn'},
  {words: ['sunk'], colour: '--ink', name: 'in the floor'},
];
const help_colour = '--line-3';
const band = {row: 18, pointed: -1};

const share_of = (frame) => player.frames > 1 ? frame / (player.frames - 1) : 0;

function bar_row(bars) {
  const track = make('div', {className: 'track'});
  for (const [first, last] of bars.spans) {
    const bar = make('i', {className: bars.flaw ? 'flaw' : 'contact'});
    bar.style.setProperty('--own', `var(--${bars.who})`);
    bar.style.left = `${100 * share_of(first - 0.5)}%`;
    bar.style.width = `${100 * share_of(last - first + 1)}%`;
    track.append(bar);
  }
  const frames = bars.spans.reduce((sum, [first, last]) => sum + last - first + 1, 0);
  const label = make('span', {className: 'label', title: `${bars.meaning}: ${frames} of ${player.frames} frames`},
                     bars.name);
  track.onclick = (e) => go_to_frame(frame_at(e, track));
  return [label, track];
}

// The option that acts, in the colour of its cluster.
function option_row(stretches) {
  const track = make('div', {className: 'track options'});
  for (const [first, last, option] of stretches) {
    const bar = make('i', {title: option_in_words(option)}, String(option)), from = Math.max(first - 0.5, 0);
    bar.style.left = `${100 * share_of(from)}%`;
    bar.style.width = `${100 * share_of(last + 0.5 - from)}%`;
    bar.style.background = cluster_colour(option);
    track.append(bar);
  }
  track.onclick = (e) => go_to_frame(frame_at(e, track));
  return [make('span', {className: 'label', title: 'the trained option that acts'}, 'option'), track];
}

function frame_at(event, track) {
  const area = track.getBoundingClientRect();
  const frame = Math.round((event.clientX - area.left) / area.width * (player.frames - 1));
  return Math.min(Math.max(frame, 0), player.frames - 1);
}

function show_timeline() {
  const clip = player.clip;
  $('scrub').max = Math.max(player.frames - 1, 0);
  $('bars').replaceChildren(...(clip.options ? option_row(clip.options) : []), ...clip.bars.flatMap(bar_row));
  $('needs').hidden = !clip.needs;
  band.pointed = -1;
  if (!clip.needs) return;
  $('band').style.height = `${band.row * (clip.help ? 2 : 1)}px`;
  const kind_shown = kinds.filter((k) => k.words.some((w) => clip.needs.wrong.includes(w)));
  const keys = [{colour: '--feasible', name: 'feasible'}, ...kind_shown];
  if (clip.help) keys.push({colour: help_colour, name: 'assistive force in the plan\'s assisted stage (lower row)'});
  $('need-key').replaceChildren('a full bar is half the weight or more:', ...keys.flatMap((k) => {
    const swatch = make('i');
    swatch.style.background = `var(${k.colour})`;
    return [swatch, k.name];
  }));
  draw_band();
}

const kind_of = (word) => kinds.find((k) => k.words.includes(word));
const amount = (n, t) => `${short(Math.round(n.force[t]))} N (${n.acceleration[t].toFixed(1)} m/s²) and ${short(Math.round(n.moment[t]))} N·m`;

// "frame 61 (2.03 s): the reference is not feasible (hovers); 310 N (4.4 m/s²) and 12 N·m would be needed from outside"
function need_in_words(frame) {
  const clip = player.clip;
  let text = `frame ${frame} (${(frame / clip.fps).toFixed(2)} s): `;
  if (frame >= clip.needs.force.length) return text + 'after the end of the reference';
  const word = clip.needs.wrong[frame];
  text += word === 'feasible' ? 'the reference is feasible' : `the reference is not feasible (${word})`;
  text += `; ${amount(clip.needs, frame)} would be needed from outside`;
  if (!clip.help || frame >= clip.help.force.length) return text;
  return text + `; in the assisted stage ${amount(clip.help, frame)} assisted the pelvis`;
}

function draw_band() {
  const clip = player.clip, {g, width, height} = resize($('band'));
  g.clearRect(0, 0, width, height);
  const wide = Math.max(width / Math.max(player.frames - 1, 1), 1);
  const bars = (needs, foot, kind) => needs.bar.forEach((part, t) => {
    const colour = kind(t), high = Math.max(colour === '--feasible' ? 1 : 4, part * (band.row - 3));
    g.fillStyle = style_value(colour);
    g.fillRect(share_of(t) * width - wide / 2, foot - high, wide, high);
  });
  bars(clip.needs, band.row, (t) => (kind_of(clip.needs.wrong[t]) || {colour: '--feasible'}).colour);
  if (clip.help) bars(clip.help, 2 * band.row, () => help_colour);
}

// Updates everything that depends on the present frame.
function update_timeline(frame) {
  const clip = player.clip;
  $('scrub').value = frame;
  $('scrub').setAttribute('aria-valuetext', `frame ${frame}, ${(frame / clip.fps).toFixed(2)} s`);
  $('time').textContent = `${(frame / clip.fps).toFixed(2)} s · frame ${frame} of 0–${Math.max(player.frames - 1, 0)}`;
  $('now').style.left = `${100 * share_of(frame)}%`;
  if (clip.needs) $('need').textContent = need_in_words(band.pointed < 0 ? frame : band.pointed);
  for (const label of document.querySelectorAll('#layers .who')) label.lastChild.textContent = height_in_words(label.dataset.who, frame);
}

// "input: 64 mm over the floor"
function height_in_words(who, frame) {
  const chart = player.clip.charts.find((c) => c.title.words.startsWith('lowest point'));
  const line = chart && chart.lines.find((l) => l.who === who), value = line && line.values[frame];
  if (value === undefined || value === null) return people[who].name;
  const where = Math.abs(value) < 1 ? 'on the floor' : value > 0 ? `${value.toFixed(0)} mm over the floor` : `${(-value).toFixed(0)} mm in the floor`;
  return `${people[who].name}: ${where}`;
}

function listen_to_timeline() {
  $('scrub').oninput = () => go_to_frame(Number($('scrub').value));
  const strip = $('band');
  const moved = () => { player.stale = true; };
  strip.onpointermove = (e) => { band.pointed = frame_at(e, strip); moved(); };
  strip.onpointerleave = () => { band.pointed = -1; moved(); };
  strip.onclick = (e) => go_to_frame(frame_at(e, strip));
  new ResizeObserver(() => { if (player.clip && player.clip.needs) draw_band(); }).observe(strip);
}
