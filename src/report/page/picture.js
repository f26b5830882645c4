// The clip's own camera view: the visible part of the picture, and the keypoints in it.

// u, v and confidence of the detections, [frame][point][3].
function decode_seen(camera) {
  const raw = decode_numbers(camera.seen, [3, 3, 1]), seen = new Float32Array(raw.length);
  for (let i = 0; i < raw.length; i += 3) seen.set([0.1 * raw[i], 0.1 * raw[i + 1], (raw[i + 2] + 32) / 63], i);
  return seen;
}

// The box around all detections of the clip, with a margin; detections of low confidence do not count.
function box_of_clip() {
  const {seen} = player, box = {left: Infinity, right: -Infinity, top: Infinity, bottom: -Infinity};
  for (let i = 0; i < seen.length; i += 3) {
    if (seen[i + 2] < 0.3) continue;
    box.left = Math.min(box.left, seen[i]);
    box.right = Math.max(box.right, seen[i]);
    box.top = Math.min(box.top, seen[i + 1]);
    box.bottom = Math.max(box.bottom, seen[i + 1]);
  }
  const {cx, cy} = player.clip.camera;  // no detections: the whole picture
  return box.left < box.right ? box : {left: 0, right: 2 * cx, top: 0, bottom: 2 * cy};
}

// Shows the box in a part of the canvas, moved and enlarged as the person wants it. The head reaches above its joint, and
// an input may be beside what was seen.
function picture_shown(part) {
  const {left, right, top, bottom} = player.box, high = bottom - top;
  const fits = Math.min(part.width / (right - left + 0.5 * high), part.height / (1.45 * high));
  return {u: (left + right) / 2 - view.pan[0], v: (top + bottom) / 2 - 0.06 * high - view.pan[1], zoom: fits * view.zoom};
}

// The detector's points of a frame on the canvas, in the picture of a clip's camera.
function seen_at(frame, {pixel}) {
  const count = player.clip.camera.points.length;
  const first = 3 * count * Math.min(frame, player.seen.length / (3 * count) - 1);
  return player.clip.camera.points.map((_, k) => {
    const [u, v, confidence] = player.seen.subarray(first + 3 * k, first + 3 * k + 3);
    return {...pixel(u, v), confidence};
  });
}

function draw_edge(g, {pixel, size}) {
  const from = pixel(0, 0), to = pixel(size.width, size.height);
  g.strokeStyle = tones.ink;
  g.globalAlpha = 0.35;
  g.lineWidth = 1;
  g.strokeRect(from.x, from.y, to.x - from.x, to.y - from.y);
  g.globalAlpha = 1;
}

function draw_seen(g, panel, frame) {
  const {points, bones} = player.clip.camera;
  const bodies = panel.shown.map((who) => ({rgb: tones[who], points: points.map(([b, ...p]) => camera_of(who, panel).project(point_of(player.motions[who], frame, b, p)))}));
  draw_keypoints(g, seen_at(frame, panel.camera), bones, bodies);
}
