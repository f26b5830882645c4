// Draws skins with WebGL, on a transparent canvas over the canvas of the floor.

const painter = {gl: null, canvas: null, tried: false, meshes: new Map(), places: {}};

const vertex_program = `
attribute vec3 place, normal;
attribute vec4 joints, weights;
uniform vec4 bones[66];
uniform mat4 to_clip;
varying vec3 facing;
void main() {
  vec4 p = vec4(0.0, 0.0, 0.0, 1.0);
  facing = vec3(0.0);
  for (int k = 0; k < 4; ++k) {
    int b = 3 * int(joints[k] + 0.5);
    vec4 q = vec4(place, 1.0), n = vec4(normal, 0.0);
    p.xyz += weights[k] * vec3(dot(bones[b], q), dot(bones[b + 1], q), dot(bones[b + 2], q));
    facing += weights[k] * vec3(dot(bones[b], n), dot(bones[b + 1], n), dot(bones[b + 2], n));
  }
  gl_Position = to_clip * p;
}`;

// Light from the upper left behind the camera, a little from the sky, and a rim.
const fragment_program = `
precision mediump float;
uniform vec4 colour;
uniform vec3 light, eye;
varying vec3 facing;
void main() {
  vec3 n = normalize(facing);
  float key = max(dot(n, light), 0.0), sky = 0.5 + 0.5 * n.z, rim = pow(1.0 - max(dot(n, eye), 0.0), 3.0);
  float shine = pow(max(dot(n, normalize(light + eye)), 0.0), 24.0);
  vec3 lit = colour.rgb * (0.34 + 0.24 * sky + 0.56 * key) + vec3(0.10 * shine + 0.10 * rim);
  gl_FragColor = vec4(min(lit, 1.0) * colour.a, colour.a);
}`;

function shader(gl, kind, text) {
  const made = gl.createShader(kind);
  gl.shaderSource(made, text);
  gl.compileShader(made);
  if (!gl.getShaderParameter(made, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(made));
  return made;
}

// Whether WebGL works here; otherwise the collision shapes are drawn.
function can_paint() {
  if (!painter.tried && skin) {
    painter.tried = true;
    painter.canvas = document.createElement('canvas');
    const gl = painter.canvas.getContext('webgl', {alpha: true, antialias: true});
    if (gl) set_up(gl);
  }
  return Boolean(painter.gl);
}

function set_up(gl) {
  const program = gl.createProgram();
  gl.attachShader(program, shader(gl, gl.VERTEX_SHADER, vertex_program));
  gl.attachShader(program, shader(gl, gl.FRAGMENT_SHADER, fragment_program));
  gl.linkProgram(program);
  gl.useProgram(program);
  for (const name of ['place', 'normal', 'joints', 'weights']) {
    painter.places[name] = gl.getAttribLocation(program, name);
    gl.enableVertexAttribArray(painter.places[name]);
  }
  for (const name of ['bones', 'to_clip', 'colour', 'light', 'eye']) painter.places[name] = gl.getUniformLocation(program, name);
  gl.enable(gl.DEPTH_TEST);
  gl.enable(gl.CULL_FACE);
  gl.depthFunc(gl.LEQUAL);
  gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  const {triangles, joints, weights} = skin_parts(), elements = gl.createBuffer();
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, elements);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
  painter.joints = filled_buffer(gl, joints);
  painter.weights = filled_buffer(gl, weights);
  painter.count = triangles.length;
  painter.canvas.addEventListener('webglcontextlost', () => { painter.gl = null; player.stale = true; });
  painter.gl = gl;
}

function filled_buffer(gl, values) {
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
  return buffer;
}

function mesh_buffers(body) {
  if (!painter.meshes.has(body)) {
    const {places, normals} = skin_of(body);
    painter.meshes.set(body, {places: filled_buffer(painter.gl, places), normals: filled_buffer(painter.gl, normals)});
  }
  return painter.meshes.get(body);
}

// Matrices from the bind pose to the world, [body][3 rows][4].
function bone_rows(motion, frame, offset) {
  const rows = new Float32Array(12 * body_count), t = Math.min(frame, motion.frames - 1);
  for (let b = 0; b < body_count; ++b) {
    const at = t * body_count + b, joint = motion.body.joints[b];
    for (let i = 0; i < 3; ++i) {
      const R = motion.turns.subarray(9 * at + 3 * i, 9 * at + 3 * i + 3);
      rows.set([R[0], R[1], R[2], motion.places[3 * at + i] + (i < 2 ? offset[i] : 0) - dot(R, joint)], 12 * b + 4 * i);
    }
  }
  return rows;
}

function begin_painting(width, height, ratio) {
  const {gl, canvas} = painter, wide = Math.round(width * ratio), high = Math.round(height * ratio);
  if (canvas.width !== wide) canvas.width = wide;
  if (canvas.height !== high) canvas.height = high;
  gl.viewport(0, 0, wide, high);
  gl.disable(gl.SCISSOR_TEST);
  gl.clearColor(0, 0, 0, 0);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.enable(gl.SCISSOR_TEST);
  Object.assign(painter, {width, height, ratio});
}

// The camera's matrix and the direction of the light.
function look_through(camera) {
  const {gl, places, width, height} = painter, [right, down, forward] = camera.rows;
  const light = right.map((r, i) => -0.5 * r - 0.75 * down[i] - 0.6 * forward[i]), long = Math.hypot(...light);
  gl.uniform3fv(places.light, light.map((x) => x / long));
  gl.uniform3fv(places.eye, forward.map((x) => -x));
  gl.uniformMatrix4fv(places.to_clip, false, clip_matrix(camera, width, height));
}

// @param figures  [{motion, frame, offset, rgb, alpha, camera}] @param part  of the canvas
function paint_skins(figures, part) {
  const {gl, places, height, ratio} = painter;
  gl.scissor(Math.round(part.x * ratio), Math.round((height - part.y - part.height) * ratio),
             Math.round(part.width * ratio), Math.round(part.height * ratio));
  for (const figure of [...figures].sort((a, b) => b.alpha - a.alpha)) {  // transparent ones last
    look_through(figure.camera);
    const mesh = mesh_buffers(figure.motion.body);
    for (const [name, buffer, size] of [['place', mesh.places, 3], ['normal', mesh.normals, 3], ['joints', painter.joints, 4], ['weights', painter.weights, 4]]) {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.vertexAttribPointer(places[name], size, gl.FLOAT, false, 0, 0);
    }
    gl.uniform4fv(places.bones, bone_rows(figure.motion, figure.frame, figure.offset));
    gl.uniform4fv(places.colour, [...figure.rgb.map((v) => v / 255), figure.alpha]);
    const draw = () => gl.drawElements(gl.TRIANGLES, painter.count, gl.UNSIGNED_SHORT, 0);
    if (figure.alpha < 1) {  // depth first, then colour, so that the far side does not shine through
      gl.colorMask(false, false, false, false);
      draw();
      gl.colorMask(true, true, true, true);
      gl.enable(gl.BLEND);
    }
    draw();
    gl.disable(gl.BLEND);
  }
}
