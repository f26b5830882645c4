// The whole page: switching between its two views, keys, and the clock of the player.
// report.html#2,30 opens the third clip at its frame 30; without a hash, all clips.

function route() {
  const [clip, frame] = location.hash.slice(1).split(',').map((text) => text === '' ? NaN : Number(text));
  const one = clip >= 0 && clip < data.rows.length;
  $('overview').hidden = one;
  $('clip-view').hidden = !one;
  document.body.classList.toggle('one', one);
  if (!one) { set_playing(false); return; }
  window.scrollTo(0, 0);
  show_clip(clip, () => { if (frame >= 0) go_to_frame(frame); else set_playing(true); });
}

function tick(now) {
  const step = Math.min((now - player.last) / 1000, 0.1);
  player.last = now;
  if (player.clip && !$('clip-view').hidden && player.frames) {
    const length = player.frames / player.clip.fps;
    if (player.playing) {
      player.time = (player.time + step * Number($('speed').value)) % length;
      player.stale = true;
    }
    if (player.stale) {
      player.stale = false;
      const frame = frame_of(player.time);
      draw_scene($('view'));
      update_timeline(frame);
      update_ramp(frame);
      for (const chart of $('charts').children) if (chart.at_time) chart.at_time(frame / player.clip.fps);
    }
  }
  requestAnimationFrame(tick);
}

const go_to_clip = (index) => { location.hash = `#${Math.min(Math.max(index, 0), data.rows.length - 1)}`; };

// What the keys do with the clip that is shown.
function player_keys(leap) {
  const frame = frame_of(player.time);
  const keys = {
    ' ': () => set_playing(!player.playing),
    ArrowRight: () => go_to_frame(frame + leap),
    ArrowLeft: () => go_to_frame(frame - leap),
    Home: () => go_to_frame(0),
    End: () => go_to_frame(player.frames - 1),
    c: () => { if (player.clip.camera) look_from(as_camera_saw() ? 'around' : 'camera'); },
    o: () => { $('placing').value = player.placing === 'over' ? 'beside' : 'over'; $('placing').onchange(); },
  };
  present().forEach((who, i) => { keys[i + 1] = () => { player.shown[who] = !player.shown[who]; show_layers(); player.stale = true; }; });
  return keys;
}

function on_key(e) {
  const tag = e.target.tagName;
  if (e.ctrlKey || e.metaKey || e.altKey || tag === 'SELECT' || (tag === 'INPUT' && e.target.type === 'search')) return;
  if ($('clip-view').hidden) return;
  const keys = {
    n: () => go_to_clip(player.index + 1),
    p: () => go_to_clip(player.index - 1),
    Escape: () => { location.hash = ''; },
    ...(player.clip ? player_keys(e.shiftKey ? 10 : 1) : {}),
  };
  if (!keys[e.key] || (e.key === ' ' && (tag === 'BUTTON' || tag === 'SUMMARY' || tag === 'INPUT'))) return;
  keys[e.key]();
  e.preventDefault();
}

// What becomes of dropped files that are no certificates; the browser's page has something for them.
const dropped = {others: () => {}};

function begin() {
  read_tones();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { read_tones(); if (player.clip && player.clip.needs) draw_band(); });
  show_run();
  show_overview();
  show_map();
  data.rows.forEach((row, i) => $('clip').append(new Option(`${row.ok ? '' : '✗ '}${row.name}`, i)));
  $('filter').oninput = () => { overview.filter = $('filter').value.toLowerCase(); show_table(); };
  $('filter').hidden = data.rows.length < 8;
  $('clip').onchange = () => go_to_clip(Number($('clip').value));
  $('previous').onclick = () => go_to_clip(player.index - 1);
  $('next').onclick = () => go_to_clip(player.index + 1);
  $('play').onclick = () => set_playing(!player.playing);
  $('from').onchange = () => look_from($('from').value);
  $('placing').onchange = () => { player.placing = $('placing').value; player.stale = true; };
  listen_to_view($('view'));
  listen_to_timeline();
  listen_to_certificates((files) => dropped.others(files));
  document.onkeydown = on_key;
  window.onhashchange = route;
  route();
  requestAnimationFrame(tick);
}

begin();
