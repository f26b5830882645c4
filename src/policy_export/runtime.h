/// What runs an exported policy: C++17, no heap, no exceptions, of the standard library <cmath> (the square
/// root alone, which is exact everywhere) and <cstdint>.
///
/// `mimicx export-policy` copies this file into every header it writes; the program itself compiles it, too,
/// to record what a header must repeat. The arithmetic is +, −, ·, / and √ in a fixed order, so that every
/// machine of IEEE 754 gets the same bits where the compiler fuses nothing (-ffp-contract=off). It is that of
/// the program (rl/tracking/state.h, physics/kinematics.h, nn/mlp.h) in a build without fused operations:
/// observations in double, rounded to float at the end; bodies and network in float.
/// docs/exported_policies.md
#pragma once

#include <cmath>
#include <cstdint>

namespace mimicx::policy_export {

inline constexpr int kBodyCount = 22, kActionCount = 55, kPoseCount = 186, kStateCount = 570,
                     kShapeCount = 10;
/// Of a motion: place 3, quaternion of the pelvis 4, ball joints 17 · 3, hinges 4; of its velocities one
/// less.
inline constexpr int kChannels = 62, kSpeeds = 61;
inline constexpr int kParentOf[kBodyCount] = {-1, 0, 0, 0, 1,  2,  3,  4,  5,  6,  7,
                                              8,  9, 9, 9, 12, 13, 14, 16, 17, 18, 19};
inline constexpr int kHandsAndFeet[4] = {20, 21, 10, 11};

/// Knees (about x) and elbows (about −y and y) turn about one axis.
constexpr bool turns_about_one_axis(int body) { return body == 4 || body == 5 || body == 18 || body == 19; }
constexpr int hinge_entry(int body) { return body < 18 ? 0 : 1; }
constexpr double hinge_sign(int body) { return body == 18 ? -1.0 : 1.0; }

/// The character at one moment. World: z up, m, s, rad; quaternions are w x y z.
struct State {
  float p_root[3];             ///< pelvis in the world, m
  float v_root[3];             ///< its velocity, m/s
  float q[kBodyCount][4];      ///< [0] pelvis → world; joints: child → parent
  float omega[kBodyCount][3];  ///< [0] pelvis; joints relative to the parent; in the body's own frame, rad/s
};

/// What the joints' PD controllers aim at, at the end of the control step. Entries 0 are not used.
struct Targets {
  float q[kBodyCount][4];      ///< child → parent
  float omega[kBodyCount][3];  ///< feed-forward of the joint's velocity, child's frame, rad/s
};

/// The motion that the policy follows: uniform cubic B-splines through `kChannels` coordinates, and what its
/// velocities differ from theirs.
struct Motion {
  int frames, spacing;        ///< frames from knot to knot
  double fps;                 ///< frames per second
  const std::int16_t* knots;  ///< [(frames − 2) / spacing + 4][kChannels], coefficient = middle + step · knot
  const float *middle, *step;  ///< [kChannels]
  const std::int8_t* speeds;   ///< [frames][kSpeeds], difference = speed_step · speed
  const float* speed_step;     ///< [kSpeeds]
};

template <class Weight>
struct Layer {
  int inputs, outputs;
  const Weight* weights;  ///< [inputs][outputs]
  const float* scales;    ///< [outputs] that int8 weights are multiplied by; of float weights there are none
  const float* biases;    ///< [outputs]
};

template <class Weight>
struct Policy {
  Motion motion;
  const double* joint_offset;  ///< [kBodyCount][3] joint in its parent's frame at rest, m
  const float* shape;          ///< [kShapeCount] β
  const std::int16_t* input;   ///< [inputs of the first layer] which numbers of the observation s it sees:
  const float *mean, *factor;  ///< [the same] (s − mean) · factor …
  float limit;                 ///< … within ± this …
  const std::int8_t* power;    ///< … times 2 to the power of this; null: times 1
  int layers;                  ///< exponential linear units (ELU) between them
  const Layer<Weight>* layer;  ///< [layers]
  float max_action;            ///< entries of an action are kept within ± this, rad
};

/// A policy that sees its target through an auto-encoder: z = E(P) in place of P, D(z) in place of P in the
/// difference. E and D see poses in their own heading frame.
template <class Weight>
struct CodedPolicy : Policy<Weight> {
  const float *pose_mean, *pose_factor;  ///< [kPoseCount] (P − mean) · factor …
  float pose_limit;                      ///< … within ± this
  int encoder_layers, decoder_layers;    ///< of at most kStateCount inputs and outputs each
  const Layer<Weight>*encoder, *decoder;

  int code_size() const { return encoder[encoder_layers - 1].outputs; }
};

// ---- rotations, in double -----------------------------------------------------------------------

struct Vector {
  double x, y, z;
};
struct Quaternion {
  double w, x, y, z;
};

constexpr Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr double dot(Vector a, Vector b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }
constexpr Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr Quaternion operator*(Quaternion a, Quaternion b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z, a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}
constexpr Vector rotated(Quaternion q, Vector v) {
  const Vector axis{q.x, q.y, q.z};
  const Vector twice = 2.0 * cross(axis, v);
  return v + q.w * twice + cross(axis, twice);
}
inline Quaternion normalised(Quaternion q) {
  const double size = std::sqrt((q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w));
  return {q.w / size, q.x / size, q.y / size, q.z / size};
}
inline Quaternion unit(const float* q) { return normalised({q[0], q[1], q[2], q[3]}); }
constexpr Vector vector_of(const float* v) { return {v[0], v[1], v[2]}; }

/// Rotation vector → quaternion, by the series of cos and sin x / x: to 1e-15 for angles up to 4.4.
inline Quaternion exponential(Vector r) {
  const double h = 0.25 * dot(r, r);  // (angle / 2)²
  double cosine = 1.0, sinc = 1.0;
  for (int k = 14; k >= 1; --k) {
    cosine = 1.0 - h * cosine / ((2.0 * k - 1.0) * (2.0 * k));
    sinc = 1.0 - h * sinc / ((2.0 * k) * (2.0 * k + 1.0));
  }
  const Vector v = (0.5 * sinc) * r;
  return normalised({cosine, v.x, v.y, v.z});
}

/// The angle whose sine is y ≥ 0 and whose cosine is x ≥ 0, times any length: its tangent is halved three
/// times, then comes the series of the arc tangent.
inline double arc(double y, double x) {
  double t = y / (x + std::sqrt(x * x + y * y));
  for (int k = 0; k < 2; ++k) t = t / (1.0 + std::sqrt(1.0 + t * t));
  const double u = t * t;
  double sum = 0.0;
  for (int k = 12; k >= 0; --k) sum = 1.0 / (2.0 * k + 1.0) - u * sum;
  return 8.0 * t * sum;
}

/// Angle of a hinge, rad.
inline double hinge_angle(Quaternion q, int body) {
  const double along = hinge_sign(body) * (hinge_entry(body) == 0 ? q.x : q.y);
  const double sine = std::sqrt(q.x * q.x + (q.y * q.y + q.z * q.z)), sign = q.w < 0.0 ? -1.0 : 1.0;
  return sine < 1e-8 ? sign * 2.0 * along : sign * (2.0 * arc(sine, sign * q.w) / sine) * along;
}

// ---- the motion ---------------------------------------------------------------------------------

/// Rotation u / |u| and its angular velocity in the body's own frame, of a quaternion of any length that
/// changes by `rate`.
inline void put_rotation(Quaternion u, Quaternion rate, float* q, double* omega) {
  const Quaternion n = normalised(u);
  const double scale = 2.0 / (u.w * u.w + u.x * u.x + u.y * u.y + u.z * u.z);
  const Quaternion product = Quaternion{u.w, -u.x, -u.y, -u.z} * rate;
  const double values[4] = {n.w, n.x, n.y, n.z};
  for (int k = 0; k < 4; ++k) q[k] = static_cast<float>(values[k]);
  omega[0] = scale * product.x;
  omega[1] = scale * product.y;
  omega[2] = scale * product.z;
}

/// Joints are modified Rodrigues parameters, tan(angle / 4) along the axis: m is that of ((1 − |m|²), 2 m).
inline void put_joint(Vector m, Vector rate, float* q, double* omega) {
  put_rotation({1.0 - dot(m, m), 2.0 * m.x, 2.0 * m.y, 2.0 * m.z},
               {-2.0 * dot(m, rate), 2.0 * rate.x, 2.0 * rate.y, 2.0 * rate.z}, q, omega);
}

/// What the four coefficients from `knot` on count for a frame's value and for its rate, per frame.
struct SplineWeights {
  int knot;
  double value[4], rate[4];
};
inline SplineWeights spline_weights(int frames, int spacing, int frame) {
  int knot = frame / spacing;
  if (frame == frames - 1 && knot * spacing == frame && knot > 0) --knot;  // the end of the last piece
  const double s = static_cast<double>(frame - knot * spacing) / spacing, r = 1.0 - s, n = spacing;
  return {knot,
          {r * r * r / 6.0, (s * s * (3.0 * s - 6.0) + 4.0) / 6.0, (r * r * (3.0 * r - 6.0) + 4.0) / 6.0,
           s * s * s / 6.0},
          {-0.5 * r * r / n, s * (1.5 * s - 2.0) / n, -r * (1.5 * r - 2.0) / n, 0.5 * s * s / n}};
}

/// The motion at a frame; from `frames` on its last pose, at rest.
inline State motion_at(const Motion& motion, int frame) {
  const int last = motion.frames - 1, t = frame < 0 ? 0 : frame > last ? last : frame;
  const SplineWeights weights = spline_weights(motion.frames, motion.spacing, t);
  const double per_second = frame > last ? 0.0 : motion.fps;
  double value[kChannels], rate[kChannels];
  for (int c = 0; c < kChannels; ++c) {
    value[c] = rate[c] = 0.0;
    for (int k = 0; k < 4; ++k) {
      const double coefficient =
          static_cast<double>(motion.middle[c]) +
          static_cast<double>(motion.step[c]) * motion.knots[(weights.knot + k) * kChannels + c];
      value[c] += weights.value[k] * coefficient;
      rate[c] += weights.rate[k] * coefficient;
    }
    rate[c] *= per_second;
  }
  State out{};
  const auto add_speed = [&](int which, double of_spline) {
    const double more =
        frame > last ? 0.0
                     : static_cast<double>(motion.speed_step[which]) * motion.speeds[t * kSpeeds + which];
    return static_cast<float>(of_spline + more);
  };
  for (int k = 0; k < 3; ++k) {
    out.p_root[k] = static_cast<float>(value[k]);
    out.v_root[k] = add_speed(k, rate[k]);
  }
  int c = 3, speed = 3;
  for (int body = 0; body < kBodyCount; ++body) {
    const double *v = value + c, *r = rate + c;
    double omega[3];
    if (turns_about_one_axis(body)) {
      const int k = hinge_entry(body);
      put_joint({k == 0 ? v[0] : 0.0, k == 1 ? v[0] : 0.0, 0.0},
                {k == 0 ? r[0] : 0.0, k == 1 ? r[0] : 0.0, 0.0}, out.q[body], omega);
      out.omega[body][k] = add_speed(speed++, omega[k]);
      c += 1;
      continue;
    }
    if (body == 0)
      put_rotation({v[0], v[1], v[2], v[3]}, {r[0], r[1], r[2], r[3]}, out.q[0], omega);
    else
      put_joint({v[0], v[1], v[2]}, {r[0], r[1], r[2]}, out.q[body], omega);
    for (int k = 0; k < 3; ++k) out.omega[body][k] = add_speed(speed++, omega[k]);
    c += body == 0 ? 4 : 3;
  }
  return out;
}

// ---- what the policy sees -----------------------------------------------------------------------

/// Joint centres of hands and feet in the world, m, by the simulator's kinematics: in float.
inline void hands_and_feet(const double* joint_offset, const State& state, Vector* p) {
  float q[kBodyCount][4], at[kBodyCount][3];
  for (int k = 0; k < 4; ++k) q[0][k] = state.q[0][k];
  for (int k = 0; k < 3; ++k) at[0][k] = state.p_root[k];
  for (int body = 1; body < kBodyCount; ++body) {
    const float *a = q[kParentOf[body]], *b = state.q[body];
    const float w = a[0], x = a[1], y = a[2], z = a[3];
    const float x2 = 2.0F * x, y2 = 2.0F * y, z2 = 2.0F * z;
    const float xx = x * x2, yy = y * y2, zz = z * z2, wx = w * x2, wy = w * y2, wz = w * z2;
    const float R[3][3] = {{1.0F - (yy + zz), x * y2 - wz, x * z2 + wy},
                           {x * y2 + wz, 1.0F - (xx + zz), y * z2 - wx},
                           {x * z2 - wy, y * z2 + wx, 1.0F - (xx + yy)}};
    float offset[3];
    for (int k = 0; k < 3; ++k) offset[k] = static_cast<float>(joint_offset[3 * body + k]);
    for (int k = 0; k < 3; ++k)
      at[body][k] =
          at[kParentOf[body]][k] + (R[k][0] * offset[0] + (R[k][1] * offset[1] + R[k][2] * offset[2]));
    q[body][0] = w * b[0] - (x * b[1] + (y * b[2] + z * b[3]));
    q[body][1] = w * b[1] + (x * b[0] + (y * b[3] - z * b[2]));
    q[body][2] = w * b[2] + (y * b[0] + (z * b[1] - x * b[3]));
    q[body][3] = w * b[3] + (z * b[0] + (x * b[2] - y * b[1]));
  }
  for (int e = 0; e < 4; ++e) p[e] = vector_of(at[kHandsAndFeet[e]]);
}

/// The same of the motion that is followed, as the program places it: in double.
inline void hands_and_feet_exactly(const double* joint_offset, const State& state, Vector* p) {
  Quaternion q[kBodyCount];
  Vector at[kBodyCount];
  q[0] = unit(state.q[0]);
  at[0] = vector_of(state.p_root);
  for (int body = 1; body < kBodyCount; ++body) {
    const int parent = kParentOf[body];
    const double* offset = joint_offset + 3 * body;
    at[body] = at[parent] + rotated(q[parent], {offset[0], offset[1], offset[2]});
    q[body] = q[parent] * unit(state.q[body]);
  }
  for (int e = 0; e < 4; ++e) p[e] = at[kHandsAndFeet[e]];
}

struct Heading {
  double x, y;  ///< cosine and sine
};

/// Where a pelvis looks: along its z axis; where that is upright, along its y axis.
inline Heading heading_of(Quaternion q) {
  Vector forward = rotated(q, {0.0, 0.0, 1.0});
  if (std::sqrt(forward.x * forward.x + forward.y * forward.y) < 1e-3) forward = rotated(q, {0.0, 1.0, 0.0});
  const double size = std::sqrt(forward.x * forward.x + forward.y * forward.y);
  return {forward.x / size, forward.y / size};
}

/// Writes v as it is seen in a frame that looks along `heading`.
inline float* put_turned(Vector v, Heading heading, float* out) {
  out[0] = static_cast<float>(heading.x * v.x + heading.y * v.y);
  out[1] = static_cast<float>(heading.x * v.y - heading.y * v.x);
  out[2] = static_cast<float>(v.z);
  return out + 3;
}

inline Vector first_column(Quaternion q) {
  const double ty = 2.0 * q.y, tz = 2.0 * q.z;
  return {1.0 - (ty * q.y + tz * q.z), ty * q.x + tz * q.w, tz * q.x - ty * q.w};
}
inline Vector second_column(Quaternion q) {
  const double tx = 2.0 * q.x, ty = 2.0 * q.y, tz = 2.0 * q.z;
  return {ty * q.x - tz * q.w, 1.0 - (tx * q.x + tz * q.z), tz * q.y + tx * q.w};
}

/// Height 1, rotation 6, velocity 3, angular velocity 3 of the pelvis; joint rotations 106, joint velocities
/// 55; hands and feet 12. @param out  [kPoseCount]
inline void put_pose(const State& state, const Vector* hands_feet, Heading heading, float* out) {
  const Quaternion root = unit(state.q[0]);
  const Vector place = vector_of(state.p_root);
  *out++ = static_cast<float>(place.z);
  out = put_turned(first_column(root), heading, out);
  out = put_turned(second_column(root), heading, out);
  out = put_turned(vector_of(state.v_root), heading, out);
  out = put_turned(rotated(root, vector_of(state.omega[0])), heading, out);
  float* velocity = out + 106;
  for (int body = 1; body < kBodyCount; ++body) {
    const Quaternion q = unit(state.q[body]);
    const float* omega = state.omega[body];
    if (turns_about_one_axis(body)) {
      *out++ = static_cast<float>(hinge_angle(q, body));
      *velocity++ = static_cast<float>(hinge_sign(body)) * omega[hinge_entry(body)];
    } else {
      const Vector x = first_column(q), y = second_column(q);
      const double columns[6] = {x.x, x.y, x.z, y.x, y.y, y.z};
      for (const double value : columns) *out++ = static_cast<float>(value);
      for (int k = 0; k < 3; ++k) *velocity++ = omega[k];
    }
  }
  out = velocity;
  for (int e = 0; e < 4; ++e) out = put_turned(hands_feet[e] - place, heading, out);
}

/// The rest of s_t, after the target: the shape, the pose that there is, the difference of `wanted` from it,
/// and the way to the next place of the pelvis.
/// @param wanted  [kPoseCount] the target in the frame `heading`, or what the policy sees of it
/// @param out     [kStateCount − kPoseCount]
template <class Weight>
void put_rest(const Policy<Weight>& policy, const State& next, const State& now, Heading heading,
              const float* wanted, float* out) {
  float *shape = out, *is = shape + kShapeCount, *difference = is + kPoseCount;
  Vector of_now[4];
  hands_and_feet(policy.joint_offset, now, of_now);
  put_pose(now, of_now, heading, is);
  for (int k = 0; k < kShapeCount; ++k) shape[k] = policy.shape[k];
  for (int k = 0; k < kPoseCount; ++k) difference[k] = wanted[k] - is[k];
  float way[3];
  put_turned(vector_of(next.p_root) - vector_of(now.p_root), heading, way);
  difference[kPoseCount] = way[0];
  difference[kPoseCount + 1] = way[1];
}

/// s_t: the pose that is asked for at the next frame, the shape, the pose that there is, their difference,
/// and the way to the next place of the pelvis. All directions are relative to where the pelvis looks.
/// @param out  [kStateCount]
template <class Weight>
void observe(const Policy<Weight>& policy, const State& next, const State& now, float* out) {
  const Heading heading = heading_of(unit(now.q[0]));
  Vector of_next[4];
  hands_and_feet_exactly(policy.joint_offset, next, of_next);
  put_pose(next, of_next, heading, out);
  put_rest(policy, next, now, heading, out, out + kPoseCount);
}

// ---- the network --------------------------------------------------------------------------------

/// e^x − 1 for x ≤ 0: x = n ln 2 + r, the series of e^r − 1, and 2ⁿ by repeated halving.
inline float exponential_minus_one(float x) {
  x = x < -87.0F ? -87.0F : x;
  const float shifted = x * 1.44269504088896340736F + 12582912.0F;  // 1.5 · 2²³ rounds to a whole number
  const float n = shifted - 12582912.0F;
  const float r = (x - n * 0.693359375F) - n * -2.12194440e-4F;
  float tail = static_cast<float>(1.0 / 5040.0);
  tail = tail * r + static_cast<float>(1.0 / 720.0);
  tail = tail * r + static_cast<float>(1.0 / 120.0);
  tail = tail * r + static_cast<float>(1.0 / 24.0);
  tail = tail * r + static_cast<float>(1.0 / 6.0);
  tail = tail * r + 0.5F;
  const float fraction = r + r * r * tail;
  float scale = 1.0F;
  for (int k = static_cast<int>(n); k < 0; ++k) scale *= 0.5F;
  return (scale - 1.0F) + scale * fraction;
}

constexpr float weight_of(const Layer<float>&, const float* row, int o) { return row[o]; }
constexpr float weight_of(const Layer<std::int8_t>& layer, const std::int8_t* row, int o) {
  return layer.scales[o] * static_cast<float>(row[o]);
}

/// y = W x + b. Sums of 16 inputs first, then the sum of these, as the program's products are blocked; of
/// fewer than 128 inputs there is one block.
/// @param place  [inputs] among `all` inputs, where some have no weights; null: there are all
/// @param part   [outputs] scratch
template <class Weight>
void apply_layer(const Layer<Weight>& layer, const float* x, const std::int16_t* place, int all, float* y,
                 float* part) {
  const int block = all < 128 ? all : 16;
  for (int o = 0; o < layer.outputs; ++o) y[o] = layer.biases[o];
  int i = 0;
  for (int end = block; i < layer.inputs; end += block) {
    for (int o = 0; o < layer.outputs; ++o) part[o] = 0.0F;
    for (; i < layer.inputs && (place == nullptr ? i : place[i]) < end; ++i) {
      const Weight* row = layer.weights + i * layer.outputs;
      const float in = x[i];
      for (int o = 0; o < layer.outputs; ++o) part[o] = weight_of(layer, row, o) * in + part[o];
    }
    for (int o = 0; o < layer.outputs; ++o) y[o] += part[o];
  }
}

/// The outputs of a network in place of its inputs x.
/// @tparam kWidest  largest number of inputs or outputs of a layer
/// @param place, all  as of `apply_layer`, for the first layer
template <int kWidest, class Weight>
void apply_network(const Layer<Weight>* layers, int count, const std::int16_t* place, int all, float* x) {
  float y[kWidest], part[kWidest];
  for (int l = 0; l < count; ++l) {
    const Layer<Weight>& layer = layers[l];
    const bool first = l == 0, last = l + 1 == count;
    apply_layer(layer, x, first ? place : nullptr, first ? all : layer.inputs, y, part);
    for (int o = 0; o < layer.outputs; ++o)
      x[o] = last || !(y[o] < 0.0F) ? y[o] : exponential_minus_one(y[o]);
  }
}

/// (x − mean) · factor within ± limit.
inline float scaled_input(float x, float mean, float factor, float limit) {
  const float scaled = (x - mean) * factor;
  const float raised = scaled < -limit ? -limit : scaled;
  return raised > limit ? limit : raised;
}

/// The action [kActionCount] for an observation [kStateCount].
/// @tparam kWidest  as of `apply_network`
template <int kWidest, class Weight>
void decide(const Policy<Weight>& policy, const float* observation, float* action) {
  float x[kWidest];
  for (int i = 0; i < policy.layer[0].inputs; ++i) {
    x[i] = scaled_input(observation[policy.input[i]], policy.mean[i], policy.factor[i], policy.limit);
    const int power = policy.power == nullptr ? 0 : policy.power[i];
    for (int k = 0; k < power; ++k) x[i] *= 2.0F;
    for (int k = 0; k > power; --k) x[i] *= 0.5F;
  }
  apply_network<kWidest>(policy.layer, policy.layers, policy.input, kStateCount, x);
  for (int k = 0; k < kActionCount; ++k) action[k] = x[k];
}

/// s_t of a policy with an auto-encoder: z, and the rest with D(z). @param out  [kStateCount]
template <class Weight>
void observe(const CodedPolicy<Weight>& policy, const State& next, const State& now, float* out) {
  const Heading own = heading_of(unit(next.q[0])), heading = heading_of(unit(now.q[0]));
  Vector of_next[4];
  hands_and_feet_exactly(policy.joint_offset, next, of_next);
  float x[kStateCount];
  put_pose(next, of_next, own, x);
  for (int k = 0; k < kPoseCount; ++k)
    x[k] = scaled_input(x[k], policy.pose_mean[k], policy.pose_factor[k], policy.pose_limit);
  apply_network<kStateCount>(policy.encoder, policy.encoder_layers, nullptr, kPoseCount, x);
  for (int k = 0; k < policy.code_size(); ++k) out[k] = x[k];
  apply_network<kStateCount>(policy.decoder, policy.decoder_layers, nullptr, policy.code_size(), x);
  for (int k = 0; k < kPoseCount; ++k) {
    const bool constant = policy.pose_factor[k] == 0.0F;
    x[k] = constant ? policy.pose_mean[k] : x[k] / policy.pose_factor[k] + policy.pose_mean[k];
  }
  // What depends on the heading turns from the target's own into that of the body.
  const Heading turn{heading.x * own.x + heading.y * own.y, heading.y * own.x - heading.x * own.y};
  constexpr int kRootVectors = 4, kHandsAndFeetAt = kPoseCount - 12;
  for (int k = 1; k < kPoseCount; k += 3) {
    if (k == 1 + 3 * kRootVectors) k = kHandsAndFeetAt;
    put_turned({x[k], x[k + 1], x[k + 2]}, turn, x + k);
  }
  put_rest(policy, next, now, heading, x, out + policy.code_size());
}

/// What an action means: rotations on top of the pose of the next frame.
template <class Weight>
Targets targets_of(const Policy<Weight>& policy, const State& next, const float* action) {
  const auto entry = [&](int k) {
    const float a = action[k], limit = policy.max_action;
    if (!(a - a == 0.0F)) return 0.0;  // no number, or an infinity
    return static_cast<double>(a < -limit ? -limit : a > limit ? limit : a);
  };
  Targets out{};
  int k = 0;
  for (int body = 1; body < kBodyCount; ++body) {
    Vector r{};
    if (turns_about_one_axis(body)) {
      const double angle = hinge_sign(body) * entry(k++);
      r = hinge_entry(body) == 0 ? Vector{angle, 0.0, 0.0} : Vector{0.0, angle, 0.0};
    } else {
      r = {entry(k), entry(k + 1), entry(k + 2)};
      k += 3;
    }
    const Quaternion q = unit(next.q[body]) * exponential(r);
    const double values[4] = {q.w, q.x, q.y, q.z};
    for (int e = 0; e < 4; ++e) out.q[body][e] = static_cast<float>(values[e]);
    for (int e = 0; e < 3; ++e) out.omega[body][e] = next.omega[body][e];
  }
  return out;
}

/// What the PD controllers shall aim at on the way from `now` to `next`, a frame later.
/// @tparam kWidest  as of `decide`
template <int kWidest, class AnyPolicy>
Targets follow(const AnyPolicy& policy, const State& next, const State& now) {
  float observation[kStateCount], action[kActionCount];
  observe(policy, next, now, observation);
  decide<kWidest>(policy, observation, action);
  return targets_of(policy, next, action);
}

}  // namespace mimicx::policy_export
