// Marks over the bodies, in perspective: arrows, centres of mass, joint torques, keypoints; and on the floor the
// support polygon. Canvas 2D.

function draw_arrow(g, project, from, to, colour) {
  const a = project(from), b = project(to);
  if (a.depth < nearest || b.depth < nearest) return;
  const length = Math.hypot(b.x - a.x, b.y - a.y), angle = Math.atan2(b.y - a.y, b.x - a.x), head = Math.min(13, 0.5 * length);
  for (const [wide, tone] of [[3, '#fff'], [0, colour]]) {  // a white rim, to be seen before a body
    g.strokeStyle = g.fillStyle = tone;
    g.lineWidth = 3 + wide;
    g.beginPath();
    g.moveTo(a.x, a.y);
    g.lineTo(b.x - 0.7 * head * Math.cos(angle), b.y - 0.7 * head * Math.sin(angle));
    g.stroke();
    g.beginPath();
    g.moveTo(b.x, b.y);
    for (const side of [-0.4, 0.4]) g.lineTo(b.x - head * Math.cos(angle + side), b.y - head * Math.sin(angle + side));
    g.closePath();
    g.lineWidth = wide;
    if (wide) g.stroke();
    g.fill();
  }
}

// A ball at a point, its projection on the floor and the line between.
function draw_center(g, project, p, colour) {
  const ball = project(p), foot = project([p[0], p[1], 0]);
  if (ball.depth < nearest || foot.depth < nearest) return;
  g.strokeStyle = g.fillStyle = colour;
  g.lineWidth = 1.5;
  g.setLineDash([4, 3]);
  g.beginPath();
  g.moveTo(ball.x, ball.y);
  g.lineTo(foot.x, foot.y);
  g.stroke();
  g.setLineDash([]);
  g.beginPath();
  g.arc(ball.x, ball.y, 5, 0, 2 * Math.PI);
  g.fill();
  g.strokeStyle = '#fff';
  g.stroke();
  g.strokeStyle = colour;
  g.lineWidth = 2;
  g.beginPath();
  g.moveTo(foot.x - 6, foot.y);
  g.lineTo(foot.x + 6, foot.y);
  g.moveTo(foot.x, foot.y - 4);
  g.lineTo(foot.x, foot.y + 4);
  g.stroke();
}

// A polygon on the ground; of two corners a line. @param height  of the ground at x, y
function draw_support(g, project, corners, offset, rgb, height) {
  const points = corners.map(([x, y]) => project([x + offset[0], y + offset[1], height(x, y)]));
  if (points.length < 2 || points.some((p) => p.depth < nearest)) return;
  g.beginPath();
  for (const p of points) g.lineTo(p.x, p.y);
  g.closePath();
  g.fillStyle = `rgba(${rgb.join()},.35)`;
  g.fill();
  g.strokeStyle = `rgb(${rgb.join()})`;
  g.lineWidth = 1.5;
  g.stroke();
}

// Colour of a joint's torque in parts of its bound: the ramp "cividis" (Nuñez, Anderton, Renslow, PLoS ONE 13 (2018)),
// which is readable with colour-vision deficiency; a joint over its bound is white.
const load_ramp = [[0, 34, 78], [57, 72, 107], [110, 110, 115], [166, 157, 117], [225, 204, 85], [254, 232, 56]];
function load_colour(share) {
  if (share > 1.001) return '#fff';
  const at = Math.min(Math.max(share, 0), 1) * (load_ramp.length - 1), k = Math.min(Math.floor(at), load_ramp.length - 2);
  return `rgb(${load_ramp[k].map((v, i) => Math.round(v + (at - k) * (load_ramp[k + 1][i] - v))).join()})`;
}

// A ball at every joint but the pelvis, farthest first; its size shows the torque share.
function draw_loads(g, project, joints, shares) {
  const balls = joints.map((p, b) => ({...project(p), share: shares[b]})).slice(1).sort((a, b) => b.depth - a.depth);
  for (const ball of balls) {
    if (ball.depth < nearest) continue;
    g.beginPath();
    g.arc(ball.x, ball.y, Math.max((0.026 + 0.030 * Math.min(ball.share, 1)) * ball.scale, 3), 0, 2 * Math.PI);
    g.fillStyle = load_colour(ball.share);
    g.fill();
    g.lineWidth = 1.2;
    g.strokeStyle = ball.share > 1.001 ? '#b02a12' : 'rgba(255,255,255,.85)';
    g.stroke();
  }
}

// The detected points, fainter at low confidence, with lines to the body's points in the body's colour.
// @param seen  [{x, y, confidence}] on the canvas @param bodies  [{points: [{x, y, depth}], rgb}]
function draw_keypoints(g, seen, bones, bodies) {
  g.lineWidth = 2;
  for (const {points, rgb} of bodies) {
    seen.forEach((s, k) => {
      if (points[k].depth < nearest) return;
      g.strokeStyle = `rgba(${rgb.join()},${s.confidence})`;
      g.beginPath();
      g.moveTo(s.x, s.y);
      g.lineTo(points[k].x, points[k].y);
      g.stroke();
    });
  }
  for (const [wide, tone] of [[3.5, '255,255,255'], [1.4, '20,24,30']]) {  // a white rim, to be seen before a body
    g.lineWidth = wide;
    for (const [a, b] of bones) {
      g.strokeStyle = `rgba(${tone},${0.75 * Math.min(seen[a].confidence, seen[b].confidence)})`;
      g.beginPath();
      g.moveTo(seen[a].x, seen[a].y);
      g.lineTo(seen[b].x, seen[b].y);
      g.stroke();
    }
  }
  for (const s of seen) {
    g.beginPath();
    g.arc(s.x, s.y, 3.6, 0, 2 * Math.PI);
    g.fillStyle = `rgba(20,24,30,${s.confidence})`;
    g.strokeStyle = `rgba(255,255,255,${s.confidence})`;
    g.lineWidth = 1.3;
    g.fill();
    g.stroke();
  }
}
