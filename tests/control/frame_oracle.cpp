#include "control/frame_oracle.h"

#include "oracles/dual.h"
#include "physics/lanes.h"
#include "physics/step_in_parts.h"

namespace mimicx::control {
namespace {

/// Body and axis of one of the six or 55 rotations of half a state.
struct Joint {
  int body;
  Vec3<double> axis;
};
constexpr Vec3<double> kUnit[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
Joint joint_of(int k) {
  if (k < 6) return {0, kUnit[k - 3]};
  const Dof& dof = dofs()[static_cast<std::size_t>(k - 6)];
  return {dof.body, from_eigen(dof.axis)};
}

template <class T>
Vec3<T> times(T h, const Vec3<double>& axis) {
  return h * spread<T>(axis);
}

/// x ⊕ h e_k.
template <class T>
void move(State<T>& x, int k, T h) {
  const bool velocity = k >= kPositions;
  if (velocity) k -= kPositions;
  if (k < 3) {
    (velocity ? x.v_root : x.p_root) += times(h, kUnit[k]);
    return;
  }
  const Joint joint = joint_of(k);
  if (velocity)
    x.omega[joint.body] += times(h, joint.axis);
  else
    x.q[joint.body] = x.q[joint.body] * exp_map(times(h, joint.axis));
}

/// The reference turned by its residuals.
template <class T>
Target<T> turned(const Target<double>& reference, const Array<T, kDofs>& residual) {
  Target<T> target;
  PerBody<Vec3<T>> r;
  r.fill(zero3<T>());
  for (int dof = 0; dof < kDofs; ++dof) {
    const Joint joint = joint_of(6 + dof);
    r[joint.body] += times(residual[dof], joint.axis);
  }
  for (int i = 1; i < kBodies; ++i) {
    target.q[i] = spread<T>(reference.q[i]) * exp_map(r[i]);
    target.omega[i] = spread<T>(reference.omega[i]);
  }
  return target;
}

/// Normalised linear interpolation the shorter way.
template <class T>
Quat<T> between(const Quat<T>& a, const Quat<T>& b, T s) {
  const T cosine = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
  const T from = T(1.0) - s, to = cosine < T(0.0) ? -s : s;
  const Quat<T> q = {from * a.w + to * b.w, from * a.x + to * b.x, from * a.y + to * b.y,
                     from * a.z + to * b.z};
  const T scale = T(1.0) / sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {scale * q.w, scale * q.x, scale * q.y, scale * q.z};
}

/// Puts the assistance on the pelvis, between the two parts of a step where the forces on bodies are summed.
template <class T>
struct WithAssistance : StepParts {
  Wrench<T> assistance;

  explicit WithAssistance(const Wrench<T>& wrench) : assistance(wrench) {}
  void after_rigid_bodies(Data<T>& d) {
    d.bias[0].n -= assistance.n;
    d.bias[0].f -= assistance.f;
  }
};

/// The state at the end of a frame moved by h along a column. With T = Dual and h = (0, 1) its derivative.
template <class T>
State<T> simulate(const Model<double>& model, const ControlFrame& frame, int column, T h) {
  State<T> state;
  for_each_member(state, frame.start, [](auto& to, const auto& from) { to = spread<T>(from); });
  Array<T, kDofs> w, u;
  for (int k = 0; k < kDofs; ++k) {
    w[k] = frame.from_residual[k];
    u[k] = frame.to_residual[k];
  }
  Wrench<T> assistance = {spread<T>(frame.assistance.n), spread<T>(frame.assistance.f)};
  if (column < kTangent)
    move(state, column, h);
  else if (column < kTangent + kDofs)
    w[column - kTangent] += h;
  else if (column < kFrameColumns)
    u[column - kTangent - kDofs] += h;
  else
    (column < kFrameColumns + 3 ? assistance.n : assistance.f) +=
        times(h, kUnit[(column - kFrameColumns) % 3]);
  const Target<T> from = turned(frame.from, w), to = turned(frame.to, u);
  Data<T> d;
  WithAssistance<T> parts(assistance);
  Target<T> target;
  for (int k = 1; k <= frame.substeps; ++k) {
    const T s(static_cast<double>(k) / frame.substeps);
    for (int i = 1; i < kBodies; ++i) {
      target.q[i] = between(from.q[i], to.q[i], s);
      target.omega[i] = from.omega[i] + s * (to.omega[i] - from.omega[i]);
    }
    step_in_parts(model, target, state, d, parts);
  }
  return state;
}

}  // namespace

State<double> simulate_frame(const Model<double>& model, const ControlFrame& frame, int column, double h) {
  return simulate(model, frame, column, h);
}

Eigen::MatrixXd exact_derivative(const Model<double>& model, const ControlFrame& frame) {
  Eigen::MatrixXd F(kTangent, kFrameColumnsWithAssistance);
  const auto slope = [](const Vec3<test::Dual>& v) { return Vec3<double>{v.x.d, v.y.d, v.z.d}; };
  for (int column = 0; column < F.cols(); ++column) {
    const State<test::Dual> end = simulate(model, frame, column, test::Dual(0.0, 1.0));
    const auto put = [&](int row, const Vec3<double>& root, const auto& joint_part) {
      for (int k = 0; k < kPositions; ++k)
        F(row + k, column) =
            k < 3 ? dot(kUnit[k], root) : dot(joint_of(k).axis, joint_part(joint_of(k).body));
    };
    put(0, slope(end.p_root), [&](int i) {
      const Quat<test::Dual>& q = end.q[i];  // a change dq of q is the turn 2 vec(q⁻¹ dq)
      const Quat<double> x =
          conjugate(Quat<double>{q.w.x, q.x.x, q.y.x, q.z.x}) * Quat<double>{q.w.d, q.x.d, q.y.d, q.z.d};
      return Vec3<double>{2.0 * x.x, 2.0 * x.y, 2.0 * x.z};
    });
    put(kPositions, slope(end.v_root), [&](int i) { return slope(end.omega[i]); });
  }
  return F;
}

Eigen::MatrixXd central_differences(const Model<double>& model, const ControlFrame& frame, double h) {
  Eigen::MatrixXd F(kTangent, kFrameColumnsWithAssistance);
  const auto apart = [&](int column, double e) {
    const Tangent<double> d =
        difference(simulate(model, frame, column, e), simulate(model, frame, column, -e));
    return Eigen::Map<const Eigen::VectorXd>(d.data(), kTangent).eval();
  };
  for (int column = 0; column < F.cols(); ++column) {
    // Larger steps: a newton hardly changes the state.
    const double e = h * (column < kPositions ? 1.0 : column < kFrameColumns ? 10.0 : 1000.0);
    F.col(column) = (8.0 * apart(column, e) - apart(column, 2.0 * e)) / (12.0 * e);
  }
  return F;
}

}  // namespace mimicx::control
