// The switches beside the canvas, and turning the view.

// Layers beside the motions: names, and whether the clip has them in this view.
const layers = [
  {key: 'forces', name: 'forces of the floor', there: () => player.ground, meaning: 'at their centres of pressure; a body weight is 0.9 m long'},
  {key: 'balance', name: 'centre of mass and support', there: () => true,
   meaning: 'the centre of mass, its place on the floor, and the hull of the points of the soles that touch it'},
  {key: 'loads', name: 'load of the joints', there: () => player.torques, meaning: 'of the cleaned motion: torque of every joint, in parts of its bound'},
  {key: 'keypoints', name: 'keypoints', there: as_camera_saw, meaning: 'what the detector saw; the fainter, the less sure it was'},
  {key: 'shapes', name: 'collision shapes', there: can_paint, meaning: 'what the simulator collides with, instead of the skin'},
];

function layer_box(name, on, change, who, meaning) {
  const input = make('input', {type: 'checkbox', checked: on, onchange: () => { change(input.checked); player.stale = true; }});
  const label = make('label', {title: meaning || ''}, input, name);
  if (who) { label.style.setProperty('--swatch', `var(--${who})`); label.className = 'who'; label.dataset.who = who; }
  return label;
}

// A box per motion, with the height of its lowest point at the frame, and one per layer that the clip has.
function show_layers() {
  const motions = present().map((who) => layer_box(people[who].name, player.shown[who], (on) => { player.shown[who] = on; }, who));
  const others = layers.filter((l) => l.there()).map((l) => {
    const label = layer_box(l.name, player.layers[l.key], (on) => { player.layers[l.key] = on; show_ramp(); }, null, l.meaning);
    label.dataset.layer = l.key;
    return label;
  });
  $('layers').replaceChildren(...motions, ...others);
  $('from').hidden = !player.clip.camera;
  $('from').value = as_camera_saw() ? 'camera' : 'around';
  $('turning').textContent = as_camera_saw() ? 'drag: move the picture · wheel: larger, smaller' : 'drag: turn · wheel: nearer, farther';
  show_ramp();
}

// The colour scale of the joints, and the joint with the largest torque share.
function show_ramp() {
  $('ramp').hidden = !(player.layers.loads && player.torques);
  $('ramp-bar').style.background = `linear-gradient(to right, ${load_ramp.map((rgb) => `rgb(${rgb.join()})`).join()})`;
}

function update_ramp(frame) {
  if ($('ramp').hidden) return;
  const loads = loads_at(frame), most = loads.reduce((best, v, b) => v > loads[best] ? b : best, 1);
  $('ramp-most').textContent = `most here: ${skin.names[most]}, ${Math.round(100 * loads[most])} %`;
}

function look_from(from) {
  player.from = from;
  player.stale = true;
  show_layers();
}

function listen_to_view(canvas) {
  const turned = () => { player.stale = true; };
  const drag = (e) => {
    if (as_camera_saw()) {
      const {zoom} = picture_shown({width: canvas.clientWidth / (player.placing === 'beside' ? Math.max(visible().length, 1) : 1), height: canvas.clientHeight});
      view.pan = [view.pan[0] + e.movementX / zoom, view.pan[1] + e.movementY / zoom];
    } else {
      view.yaw -= 0.008 * e.movementX;
      view.pitch = Math.min(1.5, Math.max(0.02, view.pitch + 0.006 * e.movementY));
    }
  };
  canvas.onpointerdown = (e) => canvas.setPointerCapture(e.pointerId);
  canvas.onpointermove = (e) => { if (e.buttons) { drag(e); turned(); } };
  canvas.addEventListener('wheel', (e) => {
    e.preventDefault();
    if (as_camera_saw()) view.zoom = Math.min(20, Math.max(0.1, view.zoom * Math.exp(-0.001 * e.deltaY)));
    else view.distance = Math.min(20, Math.max(1.2, view.distance * Math.exp(0.001 * e.deltaY)));
    turned();
  }, {passive: false});
  new ResizeObserver(turned).observe(canvas);
}
