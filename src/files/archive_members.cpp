#include "files/archive_members.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "files/simulation_settings.h"

namespace mimicx::files {
namespace {

constexpr std::size_t kRowVelocities = 6 + kDofs;

void append_joints(const PerBody<Vector3d>& row, std::vector<double>& values) {
  for (int body = 1; body < kBodies; ++body) {
    const Vector3d& v = row[body];
    if (is_hinge(body))
      values.push_back(v.dot(hinge_axis(body)));
    else
      append(v, values);
  }
}

/// Entry 0 is not changed.
void take_joints(const double* values, PerBody<Vector3d>& row) {
  for (int body = 1; body < kBodies; ++body) {
    Vector3d& v = row[body];
    if (is_hinge(body)) {
      v = *values * hinge_axis(body);
      values += 1;
    } else {
      v = Eigen::Map<const Vector3d>(values);
      values += 3;
    }
  }
}

constexpr std::size_t kPositionNumbers = 3 + 4 * kBodies;
constexpr std::size_t kVelocityNumbers = 3 + 3 * kBodies;

/// Calls visit(number) for every number of a state's positions, or of its velocities.
template <class StateType, class Visit>
void for_each_position(StateType& x, const Visit& visit) {
  for (auto* p : {&x.p_root.x, &x.p_root.y, &x.p_root.z}) visit(*p);
  for (auto& q : x.q)
    for (auto* p : {&q.w, &q.x, &q.y, &q.z}) visit(*p);
}
template <class StateType, class Visit>
void for_each_velocity(StateType& x, const Visit& visit) {
  for (auto* p : {&x.v_root.x, &x.v_root.y, &x.v_root.z}) visit(*p);
  for (auto& w : x.omega)
    for (auto* p : {&w.x, &w.y, &w.z}) visit(*p);
}

}  // namespace

NpyArray numbers_member(std::vector<std::size_t> shape, const std::vector<double>& values,
                        Precision precision) {
  if (precision == Precision::kFloat64) return NpyArray::from_double(std::move(shape), values.data());
  const std::vector<float> narrow(values.begin(), values.end());
  return NpyArray::from_float(std::move(shape), narrow.data());
}

NpyArray joints_member(const VectorRows& rows, Precision precision) {
  std::vector<double> values;
  for (const auto& row : rows) append_joints(row, values);
  return numbers_member({rows.size(), kDofs}, values, precision);
}

NpyArray wrenches_member(const WrenchRows& rows, Precision precision) {
  std::vector<double> values;
  for (const auto& row : rows)
    for (const Vector6d& w : row) values.insert(values.end(), w.data(), w.data() + 6);
  return numbers_member({rows.size(), kBodies, 6}, values, precision);
}

NpyArray velocities_member(const std::vector<motion::ReferenceFrame>& frames, Precision precision) {
  std::vector<double> values;
  for (const motion::ReferenceFrame& frame : frames) {
    append(frame.v_root, values);
    append(frame.omega[0], values);
    append_joints(frame.omega, values);
  }
  return numbers_member({frames.size(), kRowVelocities}, values, precision);
}

std::vector<double> read_numbers(const Npz& npz, const std::string& key, std::size_t rows,
                                 std::size_t columns) {
  const NpyArray& array = npz.at(key);
  const std::string expected = std::to_string(rows) + " rows of " + std::to_string(columns) + " numbers";
  if (array.type == NpyArray::Type::kText) throw DataError(npz.path, key, expected, "text");
  if (array.shape.empty() || array.shape[0] != rows || array.size() != rows * columns)
    throw DataError(npz.path, key, expected, std::to_string(array.size()) + " numbers");
  std::vector<double> values = array.to_double();
  if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
    throw DataError(npz.path, key, "finite numbers", "one that is not");
  return values;
}

VectorRows read_joints(const Npz& npz, const std::string& key, std::size_t rows) {
  const std::vector<double> values = read_numbers(npz, key, rows, kDofs);
  VectorRows out(rows);
  for (std::size_t r = 0; r < rows; ++r) {
    out[r][0].setZero();
    take_joints(values.data() + r * kDofs, out[r]);
  }
  return out;
}

WrenchRows read_wrenches(const Npz& npz, const std::string& key, std::size_t rows) {
  const std::vector<double> values = read_numbers(npz, key, rows, kBodies * 6);
  WrenchRows out(rows);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t i = 0; i < kBodies; ++i)
      out[r][i] = Eigen::Map<const Vector6d>(values.data() + (r * kBodies + i) * 6);
  return out;
}

void read_velocities(const Npz& npz, const std::string& key, std::vector<motion::ReferenceFrame>& frames) {
  const std::vector<double> values = read_numbers(npz, key, frames.size(), kRowVelocities);
  for (std::size_t t = 0; t < frames.size(); ++t) {
    const double* row = values.data() + t * kRowVelocities;
    frames[t].v_root = Eigen::Map<const Vector3d>(row);
    frames[t].omega[0] = Eigen::Map<const Vector3d>(row + 3);
    take_joints(row + 6, frames[t].omega);
  }
}

void add_states(const std::string& prefix, const std::vector<physics::State<double>>& states,
                Precision precision, Npz& npz) {
  std::vector<double> q, v;
  for (const physics::State<double>& x : states) {
    for_each_position(x, [&](double number) { q.push_back(number); });
    for_each_velocity(x, [&](double number) { v.push_back(number); });
  }
  npz.set(prefix + "q", numbers_member({states.size(), kPositionNumbers}, q, precision));
  npz.set(prefix + "v", numbers_member({states.size(), kVelocityNumbers}, v, precision));
}

std::size_t rows_of(const Npz& npz, const std::string& name) {
  const NpyArray& member = npz.at(name);
  return member.shape.empty() ? 0 : member.shape[0];
}

std::vector<physics::State<double>> read_states(const Npz& npz, const std::string& prefix) {
  const std::size_t count = rows_of(npz, prefix + "q");
  const std::vector<double> q = read_numbers(npz, prefix + "q", count, kPositionNumbers);
  const std::vector<double> v = read_numbers(npz, prefix + "v", count, kVelocityNumbers);
  std::vector<physics::State<double>> states(count);
  const double *q_at = q.data(), *v_at = v.data();
  for (physics::State<double>& x : states) {
    for_each_position(x, [&](double& number) { number = *q_at++; });
    for_each_velocity(x, [&](double& number) { number = *v_at++; });
  }
  return states;
}

double read_number(const Npz& npz, const std::string& name) { return read_numbers(npz, name, 1, 1)[0]; }

physics::SimulationConfig read_simulation(const Npz& npz) {
  physics::SimulationConfig simulation;
  visit_settings(simulation,
                 [&](const std::string& name, auto& field, auto...) { read_into(npz, name, field); });
  try {
    physics::make_model<double>(make_character(), simulation);  // checks the values
  } catch (const std::invalid_argument& error) {
    throw DataError(npz.path, "", "the settings of a simulation", error.what());
  }
  return simulation;
}

std::string read_text(const Npz& npz, const std::string& name) {
  const NpyArray& member = npz.at(name);
  if (member.type != NpyArray::Type::kText || member.text.size() != 1)
    throw DataError(npz.path, name, "a text", "something else");
  return member.text[0];
}

}  // namespace mimicx::files
