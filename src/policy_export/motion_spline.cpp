#include "policy_export/motion_spline.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "physics/lanes.h"

namespace mimicx::policy_export {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kLargestCoefficient = 32766.0;  // of a 16-bit coefficient, less one for rounding
constexpr double kFastest = 127.0;               // of an 8-bit speed
constexpr double kVelocityWeight = 0.25;         // of a step's error per frame against an error of place
constexpr double kTurnedTooFar = 20.0;           // tan(angle / 4): 348°

/// The quaternion of the same rotation that is nearer to the one before.
Quaterniond nearer(const Quaterniond& q, const Quaterniond& before) {
  Quaterniond out = q;
  if (q.dot(before) < 0.0) out.coeffs() = -q.coeffs();
  return out;
}

/// Modified Rodrigues parameters m = tan(angle / 4) · axis, and their rate
///     ṁ = ¼ ( (1 − |m|²) ω + 2 m × ω + 2 (m·ω) m ),      ω in the body's own frame.
/// Source: Schaub and Junkins, "Analytical Mechanics of Space Systems", sec. 3.6.
void put_rodrigues(const Quaterniond& q, const Vector3d& omega, Vector3d& m, Vector3d& rate) {
  m = q.vec() / (1.0 + q.w());
  rate = 0.25 * ((1.0 - m.squaredNorm()) * omega + 2.0 * m.cross(omega) + 2.0 * m.dot(omega) * m);
}

/// Coordinates and their rates per frame. [frames][kChannels]
struct Coordinates {
  MatrixXd values, rates;
};

Coordinates coordinates_of(const List<physics::State<double>>& states, double fps) {
  const int frames = states.count();
  Coordinates c{MatrixXd(frames, kChannels), MatrixXd(frames, kChannels)};
  PerBody<Quaterniond> before;
  for (int t = 0; t < frames; ++t) {
    const physics::State<double>& x = states[t];
    c.values.row(t).head<3>() = physics::to_eigen(x.p_root);
    c.rates.row(t).head<3>() = physics::to_eigen(x.v_root);
    int channel = 7;
    for (int body = 0; body < kBodies; ++body) {
      Quaterniond q = physics::to_eigen(x.q[body]).normalized();
      q = nearer(q, t > 0 ? before[body] : Quaterniond::Identity());
      before[body] = q;
      const Vector3d omega = physics::to_eigen(x.omega[body]);
      if (body == 0) {
        const Quaterniond rate = q * Quaterniond(0.0, omega.x(), omega.y(), omega.z());
        c.values.row(t).segment<4>(3) << q.w(), q.x(), q.y(), q.z();
        c.rates.row(t).segment<4>(3) << 0.5 * rate.w(), 0.5 * rate.x(), 0.5 * rate.y(), 0.5 * rate.z();
        continue;
      }
      Vector3d m, rate;
      put_rodrigues(q, omega, m, rate);
      if (!(m.norm() < kTurnedTooFar))
        throw std::invalid_argument("frame " + std::to_string(t) + ": the joint of " +
                                    std::string(kBodyNames[body]) +
                                    " turns by nearly 360 degrees, which an exported motion cannot hold");
      if (is_hinge(body)) {
        c.values(t, channel) = m[hinge_entry(body)];
        c.rates(t, channel++) = rate[hinge_entry(body)];
      } else {
        c.values.row(t).segment<3>(channel) = m;
        c.rates.row(t).segment<3>(channel) = rate;
        channel += 3;
      }
    }
  }
  c.rates /= fps;
  return c;
}

/// Least squares over places and velocities. @return coefficients [knots][kChannels]
MatrixXd coefficients_of(const Coordinates& c, int spacing, int knots) {
  const int frames = static_cast<int>(c.values.rows());
  std::vector<Eigen::Triplet<double>> entries;
  MatrixXd wanted(2 * frames, kChannels);
  for (int t = 0; t < frames; ++t) {
    const SplineWeights w = spline_weights(frames, spacing, t);
    for (int k = 0; k < 4; ++k) {
      entries.emplace_back(2 * t, w.knot + k, w.value[k]);
      entries.emplace_back(2 * t + 1, w.knot + k, kVelocityWeight * w.rate[k]);
    }
    wanted.row(2 * t) = c.values.row(t);
    wanted.row(2 * t + 1) = kVelocityWeight * c.rates.row(t);
  }
  Eigen::SparseMatrix<double> A(2 * frames, knots);
  A.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseMatrix<double> normal = A.transpose() * A;
  for (int k = 0; k < knots; ++k)
    normal.coeffRef(k, k) += 1e-9;  // the outermost hardly matter where they stand
  return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(normal).solve(A.transpose() * wanted);
}

/// The velocities of a state in the order of `Motion::speeds`. [kSpeeds]
std::vector<double> speeds_of(const physics::State<double>& x) {
  std::vector<double> out = {x.v_root.x, x.v_root.y, x.v_root.z};
  for (int body = 0; body < kBodies; ++body) {
    const Vector3d omega = physics::to_eigen(x.omega[body]);
    if (is_hinge(body))
      out.push_back(omega[hinge_entry(body)]);
    else
      out.insert(out.end(), {omega.x(), omega.y(), omega.z()});
  }
  return out;
}

/// Fills in the differences between the velocities and those of the splines.
void add_speeds(const List<physics::State<double>>& states, MotionSpline& spline) {
  const auto frames = static_cast<Index>(states.size());
  spline.speeds.assign(states.size() * kSpeeds, 0);
  spline.speed_step.assign(kSpeeds, 0.0F);
  const List<physics::State<double>> smooth = states_of(spline);
  MatrixXd more(frames, kSpeeds);
  for (Index t = 0; t < frames; ++t) {
    const std::vector<double> wanted = speeds_of(states[t]), there = speeds_of(smooth[t]);
    for (std::size_t k = 0; k < kSpeeds; ++k) more(t, static_cast<Index>(k)) = wanted[k] - there[k];
  }
  for (Index k = 0; k < kSpeeds; ++k) {
    const auto step = static_cast<float>(more.col(k).cwiseAbs().maxCoeff() / kFastest);
    spline.speed_step[static_cast<std::size_t>(k)] = step;
    for (Index t = 0; t < frames && step > 0.0F; ++t)
      spline.speeds[static_cast<std::size_t>(t * kSpeeds + k)] =
          static_cast<std::int8_t>(std::clamp(std::round(more(t, k) / step), -kFastest, kFastest));
  }
}

}  // namespace

MotionSpline fit_spline(const List<physics::State<double>>& states, double fps, int spacing) {
  if (states.size() < 2 || spacing < 1)
    throw std::invalid_argument("an exported motion has at least 2 frames, and knots at least a frame apart");
  MotionSpline spline;
  spline.frames = states.count();
  spline.spacing = spacing;
  spline.fps = fps;
  const int knots = (spline.frames - 2) / spacing + 4;
  const MatrixXd coefficients = coefficients_of(coordinates_of(states, fps), spacing, knots);
  spline.knots.resize(static_cast<std::size_t>(knots) * kChannels);
  for (Index c = 0; c < kChannels; ++c) {
    const double least = coefficients.col(c).minCoeff(), most = coefficients.col(c).maxCoeff();
    const auto middle = static_cast<float>(0.5 * (least + most));
    const auto step = static_cast<float>(std::max(0.5 * (most - least), 1e-6) / kLargestCoefficient);
    spline.middle.push_back(middle);
    spline.step.push_back(step);
    for (Index k = 0; k < knots; ++k)
      spline.knots[static_cast<std::size_t>(k * kChannels + c)] =
          static_cast<std::int16_t>(std::lround((coefficients(k, c) - middle) / step));
  }
  add_speeds(states, spline);
  return spline;
}

List<physics::State<double>> states_of(const MotionSpline& spline) {
  List<physics::State<double>> states;
  for (int t = 0; t < spline.frames; ++t) states.push_back(to_physics(motion_at(spline.view(), t)));
  return states;
}

physics::State<double> to_physics(const State& state) {
  physics::State<double> out;
  out.p_root = {state.p_root[0], state.p_root[1], state.p_root[2]};
  out.v_root = {state.v_root[0], state.v_root[1], state.v_root[2]};
  for (int i = 0; i < kBodies; ++i) {
    out.q[i] = {state.q[i][0], state.q[i][1], state.q[i][2], state.q[i][3]};
    out.omega[i] = {state.omega[i][0], state.omega[i][1], state.omega[i][2]};
  }
  return out;
}

}  // namespace mimicx::policy_export
