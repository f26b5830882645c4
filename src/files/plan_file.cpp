#include "files/plan_file.h"

#include <algorithm>
#include <string_view>

#include "files/archive_members.h"
#include "files/simulation_settings.h"

namespace mimicx::files {
namespace {

constexpr std::array<std::string_view, 3> kEndings = {"followed", "lost", "stopped"};

template <int N>
void add_rows(const std::string& name, const List<Array<float, N>>& rows, Npz& npz) {
  std::vector<double> values;
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  npz.set(name, numbers_member({rows.size(), N}, values, Precision::kFloat32));
}

template <int N>
void read_rows(const Npz& npz, const std::string& name, std::size_t count, List<Array<float, N>>& rows) {
  const std::vector<double> values = read_numbers(npz, name, count, N);
  rows.resize(count);
  const double* at = values.data();
  for (auto& row : rows)
    for (float& number : row) number = static_cast<float>(*at++);
}

/// Calls add(name, field) for the plan's numbers.
template <class PlanType, class Add>
void for_each_number(PlanType& plan, const Add& add) {
  add("cost", plan.cost);
  add("worst_distance", plan.worst_distance);
  add("iterations", plan.iterations);
  add("linearised_frames", plan.linearised);
  add("backtracks", plan.backtracks);
  add("by_way_of_help", plan.by_assisted_stages);
}
template <class FailureType, class Add>
void for_each_failure_number(FailureType& failure, const Add& add) {
  add("lost_frame", failure.frame);
  add("lost_body", failure.body);
  add("lost_distance", failure.distance);
}

control::Ending ending_of(const Npz& npz) {
  const std::string text = read_text(npz, "ending");
  const auto found = std::find(kEndings.begin(), kEndings.end(), text);
  if (found == kEndings.end())
    throw DataError(npz.path, "ending", "followed, lost or stopped", "'" + text + "'");
  return static_cast<control::Ending>(found - kEndings.begin());
}

}  // namespace

void write_plan(const std::filesystem::path& path, const StoredPlan& stored) {
  const control::Plan& plan = stored.plan;
  Npz npz;
  const auto add = [&](const std::string& name, const auto& field) {
    const double value = static_cast<double>(field);
    npz.set(name, NpyArray::from_double({1}, &value));
  };
  add_rows("residuals", plan.residuals, npz);
  add_states("", plan.states, Precision::kFloat32, npz);
  add_states("reference_", stored.reference, Precision::kFloat64, npz);
  npz.set("ending", NpyArray::scalar_text(std::string(kEndings[static_cast<std::size_t>(plan.ending)])));
  for_each_number(plan, add);
  if (plan.failure) for_each_failure_number(*plan.failure, add);
  if (!plan.stage_assistance.empty()) add_rows("soft_help", plan.stage_assistance, npz);
  npz.set("input_checksum", NpyArray::scalar_text(stored.input_checksum));
  add("fps", stored.fps);
  for (const auto& [name, number] : simulation_numbers(stored.simulation)) add(name, number);
  write_npz(path, npz);
}

void write_gains(const std::filesystem::path& path, const StoredGains& stored) {
  using Rows = Eigen::Matrix<float, kDofs, control::kMemory, Eigen::RowMajor>;
  std::vector<float> values;
  values.reserve(stored.gains.size() * Rows::SizeAtCompileTime);
  for (const Eigen::MatrixXf& K : stored.gains) {
    const Rows rows = K;
    values.insert(values.end(), rows.data(), rows.data() + rows.size());
  }
  const Eigen::Matrix<float, kDofs, kDofs, Eigen::RowMajor> curvature = stored.curvature;
  Npz npz;
  npz.set("gains", NpyArray::from_float({stored.gains.size(), kDofs, control::kMemory}, values.data()));
  npz.set("curvature", NpyArray::from_float({kDofs, kDofs}, curvature.data()));
  write_npz(path, npz);
}

StoredGains read_gains(const std::filesystem::path& path) { return gains_from(read_npz(path)); }

StoredGains gains_from(const Npz& npz) {
  const std::size_t count = rows_of(npz, "gains");
  StoredGains stored;
  const std::vector<double> values = read_numbers(npz, "gains", count, kDofs * control::kMemory);
  stored.gains.assign(count, Eigen::MatrixXf(kDofs, control::kMemory));
  const double* at = values.data();
  for (Eigen::MatrixXf& K : stored.gains)
    for (Eigen::Index r = 0; r < K.rows(); ++r)
      for (Eigen::Index c = 0; c < K.cols(); ++c) K(r, c) = static_cast<float>(*at++);
  const std::vector<double> curvature = read_numbers(npz, "curvature", kDofs, kDofs);
  stored.curvature =
      Eigen::Map<const Eigen::Matrix<double, kDofs, kDofs, Eigen::RowMajor>>(curvature.data()).cast<float>();
  return stored;
}

StoredPlan read_plan(const std::filesystem::path& path) { return plan_from(read_npz(path)); }

StoredPlan plan_from(const Npz& npz) {
  StoredPlan stored;
  control::Plan& plan = stored.plan;
  const auto read = [&](const std::string& name, auto& field) { read_into(npz, name, field); };
  plan.states = read_states(npz, "");
  read_rows(npz, "residuals", std::max<std::size_t>(plan.states.size(), 1) - 1, plan.residuals);
  stored.reference = read_states(npz, "reference_");
  plan.ending = ending_of(npz);
  for_each_number(plan, read);
  if (npz.has("lost_frame")) {
    for_each_failure_number(plan.failure.emplace(), read);
    if (plan.failure->body < -1 || plan.failure->body >= kBodies)
      throw DataError(npz.path, "lost_body", "the number of a body", std::to_string(plan.failure->body));
  }
  if (npz.has("soft_help")) read_rows(npz, "soft_help", rows_of(npz, "soft_help"), plan.stage_assistance);
  stored.input_checksum = read_text(npz, "input_checksum");
  read("fps", stored.fps);
  stored.simulation = read_simulation(npz);
  return stored;
}

}  // namespace mimicx::files
