// Cameras: projection of world points onto the canvas.
//
// A camera is {rows, shift, lens}: x (right), y (down) and z (forward) of a point are rows · p + shift; the lens has focal
// lengths and the middle of the picture in pixels of the canvas.

const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
const nearest = 0.15;  // m in front of the camera

function make_camera(rows, shift, lens) {
  const project = (p) => {
    const [x, y, depth] = rows.map((row, i) => dot(row, p) + shift[i]);
    return {x: lens.cx + (lens.fx * x + lens.skew * y) / depth, y: lens.cy + lens.fy * y / depth, depth, scale: lens.fx / depth};
  };
  return {rows, shift, lens, project};
}

// A camera that orbits a point, drawn in a part {x, y, width, height} of the canvas.
function orbit_camera(centre, view, part) {
  const cy = Math.cos(view.yaw), sy = Math.sin(view.yaw), cp = Math.cos(view.pitch), sp = Math.sin(view.pitch);
  const rows = [[-sy, cy, 0], [cy * sp, sy * sp, -cp], [-cy * cp, -sy * cp, -sp]];
  const eye = centre.map((c, i) => c - view.distance * rows[2][i]), focal = 1.25 * Math.min(part.height, 1.1 * part.width);
  return make_camera(rows, rows.map((row) => -dot(row, eye)),
                     {fx: focal, fy: focal, skew: 0, cx: part.x + part.width / 2, cy: part.y + part.height * 0.52});
}

// The camera of a clip at a frame. Its pixel(u, v) is where a place of its picture is on the canvas; size is that of the
// picture, an estimate: its middle is the principal point.
// @param shown  {u, v, zoom}: centre of the view, px of the picture; magnification
function clip_camera(camera, frame, shown, part) {
  const e = camera.extrinsics[camera.extrinsics.length > 1 ? Math.min(frame, camera.extrinsics.length - 1) : 0];
  const pixel = (u, v) => ({x: part.x + part.width / 2 + shown.zoom * (u - shown.u),
                            y: part.y + part.height / 2 + shown.zoom * (v - shown.v)});
  const middle = pixel(camera.cx, camera.cy);
  const lens = {fx: shown.zoom * camera.fx, fy: shown.zoom * camera.fy, skew: shown.zoom * camera.skew,
                cx: middle.x, cy: middle.y};
  return {...make_camera([e.slice(0, 3), e.slice(4, 7), e.slice(8, 11)], [e[3], e[7], e[11]], lens), pixel,
          size: {width: 2 * camera.cx, height: 2 * camera.cy}};
}

// The projection matrix for WebGL's clip space, column by column.
function clip_matrix({rows, shift, lens}, width, height) {
  const near = nearest, far = 200;
  const x = [0, 1, 2].map((i) => [rows[0][i], rows[1][i], rows[2][i]]).concat([shift]);
  return x.flatMap(([X, Y, Z], i) => [
    (2 * lens.cx / width - 1) * Z + 2 * (lens.fx * X + lens.skew * Y) / width,
    (1 - 2 * lens.cy / height) * Z - 2 * lens.fy * Y / height,
    (far + near) / (far - near) * Z - (i === 3 ? 2 * far * near / (far - near) : 0),
    Z]);
}
