// Drawing in perspective: floor, capsules and their shadows, arrows. Canvas 2D, farthest first.

// Where a camera that looks at `centre` sees a point: {x, y, depth, scale}, scale in pixels per metre.
function camera(centre, view, width, height) {
  const cy = Math.cos(view.yaw), sy = Math.sin(view.yaw), cp = Math.cos(view.pitch), sp = Math.sin(view.pitch);
  const forward = [-cy * cp, -sy * cp, -sp], right = [-sy, cy, 0], up = [-cy * sp, -sy * sp, cp];
  const eye = centre.map((c, i) => c - view.distance * forward[i]);
  const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  const focal = 1.25 * Math.min(height, 1.1 * width);
  return (p) => {
    const d = [p[0] - eye[0], p[1] - eye[1], p[2] - eye[2]], depth = dot(d, forward), s = focal / depth;
    return {x: width / 2 + s * dot(d, right), y: height * 0.52 - s * dot(d, up), depth, scale: s};
  };
}

const nearest = 0.15;  // m before the camera

function draw_floor(g, project, centre, tones) {
  const half = 9, x0 = Math.round(centre[0]), y0 = Math.round(centre[1]);
  for (let i = -half; i < half; ++i) {
    for (let j = -half; j < half; ++j) {
      const x = x0 + i, y = y0 + j;
      const fade = 1 - Math.hypot(x + 0.5 - centre[0], y + 0.5 - centre[1]) / half;
      const corners = [[x, y, 0], [x + 1, y, 0], [x + 1, y + 1, 0], [x, y + 1, 0]].map(project);
      if (fade <= 0 || corners.some((c) => c.depth < nearest)) continue;
      g.fillStyle = `rgba(${tones[Math.abs(x + y) % 2].join()},${fade})`;
      g.beginPath();
      for (const c of corners) g.lineTo(c.x, c.y);
      g.fill();
    }
  }
}

// Shadow of a vertical light: the capsule's footprint, added to the current path with one winding, so that
// overlapping footprints do not darken each other.
function add_shadow(g, project, c) {
  const dx = c.b[0] - c.a[0], dy = c.b[1] - c.a[1];
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
  const a = project(c.a), b = project(c.b);
  if (a.depth < nearest || b.depth < nearest) return;
  const ra = c.r * a.scale, rb = c.r * b.scale;
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

// A ball at a point of the air, its place on the floor and the line between.
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
