// Drawing in perspective: floor, capsules and their shadows. Canvas 2D, farthest first.

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

// Height of the ground under a place: that of the highest plate over it that is not above `most`, else 0.
// @param plates  [x, y, yaw, half extents, height] each
function ground_height(plates, x, y, most) {
  return plates.reduce((height, [px, py, yaw, a, b, top]) => {
    const c = Math.cos(yaw), s = Math.sin(yaw), u = c * (x - px) + s * (y - py), v = c * (y - py) - s * (x - px);
    return Math.abs(u) <= a && Math.abs(v) <= b && top <= most ? Math.max(height, top) : height;
  }, 0);
}

// The boxes under the plates, farthest face first.
function draw_boxes(g, project, plates, offset, tones) {
  const faces = plates.flatMap(([x, y, yaw, a, b, top]) => {
    const c = Math.cos(yaw), s = Math.sin(yaw);
    const corner = ([u, v], z) => project([x + offset[0] + c * u * a - s * v * b, y + offset[1] + s * u * a + c * v * b, z]);
    const around = [[-1, -1], [1, -1], [1, 1], [-1, 1]], high = around.map((q) => corner(q, top)), low = around.map((q) => corner(q, 0));
    return [...around.map((_, k) => ({corners: [low[k], low[(k + 1) % 4], high[(k + 1) % 4], high[k]], shade: 0.8 - 0.05 * (k % 2)})),
            {corners: high, shade: 1}];
  }).filter(({corners}) => corners.every((p) => p.depth >= nearest));
  const far = ({corners}) => corners.reduce((sum, p) => sum + p.depth, 0);
  faces.sort((p, q) => far(q) - far(p));
  for (const {corners, shade} of faces) {
    g.beginPath();
    for (const p of corners) g.lineTo(p.x, p.y);
    g.closePath();
    g.fillStyle = `rgb(${tones[0].map((v) => Math.round(shade * v)).join()})`;
    g.fill();
    g.strokeStyle = `rgb(${tones[0].map((v) => Math.round(0.65 * v)).join()})`;
    g.lineWidth = 1;
    g.stroke();
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
