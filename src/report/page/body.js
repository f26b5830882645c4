// Bodies: bones, collision shapes and a skin, and the poses of a motion. World z up, metres.

const body_count = 22, bodies_known = new Map();  // by key

const element_json = (id) => { const element = $(id); return element ? JSON.parse(element.textContent) : null; };
const skin = element_json('skin');  // what all bodies share; null if there is nothing to show

// Positions of the joints in the bind pose, from the pelvis on.
function bind_joints(offsets) {
  const joints = [];
  offsets.forEach((offset, b) => joints.push(b === 0 ? [0, 0, 0] : offset.map((x, i) => x + joints[skin.parents[b]][i])));
  return joints;
}

// Triangles, bodies and weights of the skin, which all bodies share. [vertex][4]
let shared_skin = null;
function skin_parts() {
  if (shared_skin) return shared_skin;
  const joints = decode_counts(skin.joints, 1), weights = decode_counts(skin.weights, 1), parts = new Float32Array(weights.length);
  for (let v = 0; v < weights.length; v += 4) {
    const sum = weights[v] + weights[v + 1] + weights[v + 2] + weights[v + 3];
    for (let k = v; k < v + 4; ++k) parts[k] = weights[k] / sum;
  }
  shared_skin = {triangles: Uint16Array.from(decode_counts(skin.triangles, 2)), joints: Float32Array.from(joints), weights: parts};
  return shared_skin;
}

// Vertices of a body in the bind pose, [vertex][3], and unit normals, means over the adjacent triangles.
function skin_of(body) {
  if (body.places) return body;
  const {triangles, joints} = skin_parts(), raw = decode_numbers(body.vertices, [2]), places = new Float32Array(raw.length);
  for (let i = 0; i < raw.length; ++i) places[i] = 0.4e-3 * raw[i] + body.joints[joints[4 * Math.floor(i / 3)]][i % 3];
  const normals = new Float32Array(raw.length), p = (v) => [places[3 * v], places[3 * v + 1], places[3 * v + 2]];
  for (let f = 0; f < triangles.length; f += 3) {
    const [a, b, c] = [p(triangles[f]), p(triangles[f + 1]), p(triangles[f + 2])];
    const u = b.map((x, i) => x - a[i]), v = c.map((x, i) => x - a[i]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    for (let k = 0; k < 3; ++k) for (let i = 0; i < 3; ++i) normals[3 * triangles[f + k] + i] += n[i];
  }
  return Object.assign(body, {places, normals});
}

// @param given  bodies of the clip's file; others are in the page
function take_body(key, given) {
  if (!bodies_known.has(key)) {
    const body = (given && given[key]) || element_json(`body-${key}`);
    body.joints = bind_joints(body.offsets);
    bodies_known.set(key, body);
  }
  return bodies_known.get(key);
}

// Rows of the rotation matrix of a rotation vector, into `out` from `at` on.
function put_rotation(x, y, z, out, at) {
  const angle = Math.hypot(x, y, z), s = angle > 1e-9 ? Math.sin(angle) / angle : 1, c = angle > 1e-9 ? (1 - Math.cos(angle)) / (angle * angle) : 0.5;
  const d = 1 - c * angle * angle;
  out.set([d + c * x * x, c * x * y - s * z, c * x * z + s * y,
           c * x * y + s * z, d + c * y * y, c * y * z - s * x,
           c * x * z - s * y, c * y * z + s * x, d + c * z * z], at);
}

// Decodes a motion → {frames, body, turns: [frame][body][9], places: [frame][body][3], m, centers, support}.
function take_motion(motion, given) {
  const body = take_body(motion.body, given), {frames} = motion;
  const raw = decode_numbers(motion.poses, [3, 3, 3, ...Array(3 * body_count).fill(2)]), row = 3 + 3 * body_count;
  const turns = new Float32Array(9 * frames * body_count), places = new Float32Array(3 * frames * body_count);
  for (let t = 0; t < frames; ++t) {
    for (let b = 0; b < body_count; ++b) {
      const from = t * row + 3 + 3 * b, R = 9 * (t * body_count + b), p = 3 * (t * body_count + b);
      put_rotation(...[0, 1, 2].map((i) => raw[from + i] * Math.PI / 2048), turns, R);
      const up = t * body_count + skin.parents[b], offset = body.offsets[b];
      for (let i = 0; i < 3; ++i)
        places[p + i] = b === 0 ? 1e-3 * raw[t * row + i]
            : places[3 * up + i] + turns[9 * up + 3 * i] * offset[0] + turns[9 * up + 3 * i + 1] * offset[1] + turns[9 * up + 3 * i + 2] * offset[2];
    }
  }
  return {frames, body, turns, places, centers: decode_numbers(motion.centers, [3]), support: decode_support(motion, places)};
}

// Corners of the support polygon, [frame][corner][2], m.
function decode_support(motion, places) {
  if (!motion.support) return null;
  const read = reader_of(motion.support);
  return Array.from({length: motion.frames}, (_, t) => {
    const pelvis = 3 * t * body_count;
    return Array.from({length: read.count(1)}, () => [0, 1].map((i) => 1e-3 * read.number(2) + places[pelvis + i]));
  });
}

// The world position of a point of a body.
function point_of(motion, frame, b, p, offset = [0, 0]) {
  const at = Math.min(frame, motion.frames - 1) * body_count + b, R = 9 * at;
  return [0, 1, 2].map((i) => motion.places[3 * at + i] + (i < 2 ? offset[i] : 0) +
      motion.turns[R + 3 * i] * p[0] + motion.turns[R + 3 * i + 1] * p[1] + motion.turns[R + 3 * i + 2] * p[2]);
}

// The collision shapes of a frame as {a, b, r}.
const capsules_of = (motion, frame, offset) => motion.body.shapes.map(([b, ax, ay, az, bx, by, bz, r]) =>
    ({a: point_of(motion, frame, b, [ax, ay, az], offset), b: point_of(motion, frame, b, [bx, by, bz], offset), r}));
