#include "control/frame_oracle.h"

namespace mimicx::control {
namespace {

/// A degree of freedom as body and axis.
struct Axis {
  std::size_t body;
  Vec3<double> axis;
};
Axis axis_of_dof(int dof) {
  int body = kBodies - 1;
  while (first_dof(body) > dof) --body;
  const Vector3d axis = is_hinge(body) ? hinge_axis(body) : Vector3d(Vector3d::Unit(dof - first_dof(body)));
  return {static_cast<std::size_t>(body), {axis.x(), axis.y(), axis.z()}};
}

template <class T>
Vec3<T> times(T h, const Vec3<double>& axis) {
  return h * spread<T>(axis);
}
template <class T>
void put(Quat<T>& out, const Quat<double>& q) {
  out = spread<T>(q);
}
template <class T>
void put(Vec3<T>& out, const Vec3<double>& v) {
  out = spread<T>(v);
}
constexpr Vec3<double> kUnit[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// x ⊕ h e_k.
template <class T>
void move(State<T>& x, int k, T h) {
  const int half = k < 61 ? 0 : 61, row = k - half;
  if (row < 3) {
    Vec3<T>& v = half == 0 ? x.p_root : x.v_root;
    v = v + times(h, kUnit[row]);
    return;
  }
  const Axis joint = row < 6 ? Axis{0, kUnit[row - 3]} : axis_of_dof(row - 6);
  const std::size_t i = joint.body;
  if (half == 0)
    x.q[i] = x.q[i] * exp_map(times(h, joint.axis));
  else
    x.omega[i] = x.omega[i] + times(h, joint.axis);
}

/// The reference turned by its residuals.
template <class T>
Target<T> turned(const Target<double>& reference, const std::array<T, kDofs>& residual) {
  Target<T> target;
  for (std::size_t i = 0; i < kBodies; ++i) {
    put(target.q[i], reference.q[i]);
    put(target.omega[i], reference.omega[i]);
  }
  std::array<Vec3<T>, kBodies> r;
  r.fill(zero3<T>());
  for (int dof = 0; dof < kDofs; ++dof) {
    const Axis joint = axis_of_dof(dof);
    r[joint.body] = r[joint.body] + times(residual[static_cast<std::size_t>(dof)], joint.axis);
  }
  for (std::size_t i = 1; i < kBodies; ++i) target.q[i] = target.q[i] * exp_map(r[i]);
  return target;
}

template <class T>
Quat<T> between(const Quat<T>& a, const Quat<T>& b, T s) {
  const T cosine = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
  const T from = T(1.0) - s, to = cosine < T(0.0) ? -s : s;
  const Quat<T> q = {from * a.w + to * b.w, from * a.x + to * b.x, from * a.y + to * b.y,
                     from * a.z + to * b.z};
  const T scale = T(1.0) / sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {scale * q.w, scale * q.x, scale * q.y, scale * q.z};
}

/// Puts a wrench on the root, between the two parts of a step where the forces on bodies are summed.
template <class T>
struct WithPush : StepParts {
  Data<T>& d;
  Wrench<T> push;

  WithPush(Data<T>& data, const Wrench<T>& wrench) : d(data), push(wrench) {}
  void finished(Stage stage) {
    if (stage != kKinematics) return;
    d.bias[0].n -= push.n;
    d.bias[0].f -= push.f;
  }
};

Eigen::VectorXd tangent(const Vec3<double>& p, const Vec3<double>& v,
                        const std::array<Vec3<double>, kBodies>& turn,
                        const std::array<Vec3<double>, kBodies>& spin) {
  Eigen::VectorXd out(122);
  for (int half = 0; half < 2; ++half) {
    const Vec3<double>& root = half == 0 ? p : v;
    const auto& joints = half == 0 ? turn : spin;
    for (int k = 0; k < 3; ++k) {
      out(61 * half + k) = dot(root, kUnit[k]);
      out(61 * half + 3 + k) = dot(joints[0], kUnit[k]);
    }
    for (int dof = 0; dof < kDofs; ++dof) {
      const Axis joint = axis_of_dof(dof);
      out(61 * half + 6 + dof) = dot(joints[joint.body], joint.axis);
    }
  }
  return out;
}

}  // namespace

template <class T>
State<T> simulate_frame(const Model<double>& model, const ControlFrame& frame, int column, T h) {
  State<T> state;
  put(state.p_root, frame.start.p_root);
  put(state.v_root, frame.start.v_root);
  for (std::size_t i = 0; i < kBodies; ++i) {
    put(state.q[i], frame.start.q[i]);
    put(state.omega[i], frame.start.omega[i]);
  }
  std::array<T, kDofs> w, u;
  for (std::size_t k = 0; k < kDofs; ++k) {
    w[k] = frame.from_residual[k];
    u[k] = frame.to_residual[k];
  }
  Wrench<T> push = {spread<T>(frame.push.n), spread<T>(frame.push.f)};
  if (column < 122)
    move(state, column, h);
  else if (column < 177)
    w[static_cast<std::size_t>(column - 122)] += h;
  else if (column < 232)
    u[static_cast<std::size_t>(column - 177)] += h;
  else
    (column < 235 ? push.n : push.f) += times(h, kUnit[(column - 232) % 3]);
  const Target<T> from = turned(frame.from, w), to = turned(frame.to, u);
  Data<T> d;
  WithPush<T> parts(d, push);
  Target<T> target = to;
  for (int k = 1; k <= frame.substeps; ++k) {
    const T s(static_cast<double>(k) / frame.substeps);
    for (std::size_t i = 1; i < kBodies; ++i) {
      target.q[i] = between(from.q[i], to.q[i], s);
      target.omega[i] = from.omega[i] + s * (to.omega[i] - from.omega[i]);
    }
    step_in_parts(model, target, state, d, parts);
  }
  return state;
}

Eigen::VectorXd state_difference(const State<double>& a, const State<double>& b) {
  std::array<Vec3<double>, kBodies> turn, spin;
  for (std::size_t i = 0; i < kBodies; ++i) {
    turn[i] = log_map(conjugate(b.q[i]) * a.q[i]);
    spin[i] = a.omega[i] - b.omega[i];
  }
  return tangent(a.p_root - b.p_root, a.v_root - b.v_root, turn, spin);
}

Eigen::MatrixXd exact_derivative(const Model<double>& model, const ControlFrame& frame) {
  Eigen::MatrixXd F(122, 238);
  const auto d = [](const Vec3<Dual>& v) { return Vec3<double>{v.x.d, v.y.d, v.z.d}; };
  for (int column = 0; column < 238; ++column) {
    const State<Dual> end = simulate_frame(model, frame, column, Dual(0.0, 1.0));
    std::array<Vec3<double>, kBodies> turn, spin;
    for (std::size_t i = 0; i < kBodies; ++i) {
      const Quat<Dual>& q = end.q[i];  // of a change dq of q the turn is 2 vec(q⁻¹ dq)
      const Quat<double> x =
          Quat<double>{q.w.x, -q.x.x, -q.y.x, -q.z.x} * Quat<double>{q.w.d, q.x.d, q.y.d, q.z.d};
      turn[i] = {2.0 * x.x, 2.0 * x.y, 2.0 * x.z};
      spin[i] = d(end.omega[i]);
    }
    F.col(column) = tangent(d(end.p_root), d(end.v_root), turn, spin);
  }
  return F;
}

Eigen::MatrixXd central_differences(const Model<double>& model, const ControlFrame& frame, double h) {
  Eigen::MatrixXd F(122, 238);
  for (int column = 0; column < 238; ++column) {
    const double e = column < 61 ? h : column < 232 ? 10.0 * h : 1e3 * h;  // the state hardly feels a newton
    F.col(column) =
        state_difference(simulate_frame(model, frame, column, e), simulate_frame(model, frame, column, -e)) /
        (2.0 * e);
  }
  return F;
}

template State<double> simulate_frame(const Model<double>&, const ControlFrame&, int, double);

}  // namespace mimicx::control
