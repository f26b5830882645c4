#include "import/opensim/measured_forces.h"

#include <algorithm>
#include <cmath>

#include "core/file.h"
#include "core/npz/npz.h"
#include "core/number_text.h"
#include "import/opensim/storage_table.h"

namespace mimicx::import {
namespace {

Vector3d from_ground(const Vector3d& v) { return {v.x(), -v.z(), v.y()}; }

using AxisColumns = Array<std::size_t, 3>;

/// Three columns of a foot, "_vx", "_vy", "_vz" behind the names' common part.
struct FootColumns {
  AxisColumns force, pressure;
};

/// @param name  of the first but for its axis
AxisColumns three_columns(const StorageTable& table, const std::string& path, const std::string& name) {
  AxisColumns columns{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = table.find(name + "xyz"[axis]);
    if (!at) throw DataError(path, name + "xyz"[axis], "a column of this name", "none");
    columns[axis] = *at;
  }
  return columns;
}

FootColumns foot_columns(const StorageTable& table, const std::string& path,
                         std::initializer_list<const char*> prefixes) {
  for (const std::string prefix : prefixes)
    if (table.find(prefix + "vx"))
      return {three_columns(table, path, prefix + "v"), three_columns(table, path, prefix + "p")};
  throw DataError(path, std::string(*prefixes.begin()) + "vx", "a column of this name", "none");
}

/// @throws DataError for a column of forces that is none of `taken` and not all zero
void refuse_further_plates(const StorageTable& table, const std::string& path,
                           const std::vector<AxisColumns>& taken) {
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const std::string& name = table.columns[k];
    const bool is_force = name.ends_with("_vx") || name.ends_with("_vy") || name.ends_with("_vz");
    const bool is_taken = std::any_of(taken.begin(), taken.end(), [&](const AxisColumns& columns) {
      return std::find(columns.begin(), columns.end(), k) != columns.end();
    });
    if (!is_force || is_taken) continue;
    if (std::any_of(table.rows.begin(), table.rows.end(), [&](const auto& row) { return row[k] != 0.0; }))
      throw DataError(path, name, "forces of the right and of the left foot alone",
                      "those of a further plate");
  }
}

/// Marks the samples in which a foot may be on the floor beside the plates.
void mark_unseen(MeasuredForces& measured) {
  const double begin = measured.samples.front().time, end = measured.samples.back().time;
  for (int foot = 0; foot < 2; ++foot) {
    const auto presses = [&](const ForceSample& sample) { return sample.force[foot].z() > kLeastPress; };
    const auto first = std::find_if(measured.samples.begin(), measured.samples.end(), presses);
    const auto last = std::find_if(measured.samples.rbegin(), measured.samples.rend(), presses);
    const std::string name = foot == 0 ? "the left foot" : "the right foot";
    const bool never = first == measured.samples.end();
    const double from = never ? HUGE_VAL : std::max(first->time - kSwing, begin),
                 to = never ? -HUGE_VAL : std::min(last->time + kSwing, end);
    for (ForceSample& sample : measured.samples)
      sample.valid[foot] = sample.time >= from && sample.time <= to;
    if (!never && from <= begin && to >= end) continue;
    measured.told += measured.told.empty() ? "" : ", ";
    measured.told +=
        name + (never ? " presses no plate" : formatted(" counts from %.2f to %.2f s", from, to));
  }
  if (!measured.told.empty()) measured.told += "; otherwise a foot may stand beside the plates";
}

MeasuredForces from_mot(const std::string& text, const std::string& path) {
  const StorageTable table = parse_storage(text, path);
  const FootColumns feet[] = {foot_columns(table, path, {"ground_force_l_", "1_ground_force_"}),
                              foot_columns(table, path, {"ground_force_r_", "ground_force_"})};
  std::vector<AxisColumns> taken = {feet[0].force, feet[1].force};
  const bool whole = table.find("ground_force_o_vx").has_value();
  if (whole) taken.push_back(three_columns(table, path, "ground_force_o_v"));
  refuse_further_plates(table, path, taken);
  MeasuredForces measured;
  for (const std::vector<double>& row : table.rows) {
    const auto vector = [&](const AxisColumns& at) {
      return from_ground({row[at[0]], row[at[1]], row[at[2]]});
    };
    ForceSample& sample = measured.samples.emplace_back();
    sample.time = row[0];
    if (whole) sample.rest = vector(taken[2]);
    for (int foot = 0; foot < 2; ++foot) {
      sample.force[foot] = vector(feet[foot].force);
      sample.pressure[foot] = vector(feet[foot].pressure);
    }
  }
  if (!whole && !measured.samples.empty()) mark_unseen(measured);
  return measured;
}

/// A member of three numbers a row, not finite ones included.
std::vector<Vector3d> vectors(const Npz& npz, const std::string& name) {
  const NpyArray& array = npz.at(name);
  if (array.shape.size() != 2 || array.shape[1] != 3)
    throw DataError(npz.path, name, "three numbers a row", "another shape");
  const std::vector<double> values = array.to_double();
  std::vector<Vector3d> rows;
  for (std::size_t i = 0; i < array.shape[0]; ++i)
    rows.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  return rows;
}

double positive_number(const Npz& npz, const std::string& name) {
  const std::vector<double> value = npz.at(name).to_double();
  if (value.size() != 1 || !(value[0] > 0.0)) throw DataError(npz.path, name, "a positive number", "another");
  return value[0];
}

MeasuredForces from_npz(const Npz& npz) {
  const std::vector<Vector3d> force[] = {vectors(npz, "grf_left"), vectors(npz, "grf_right")},
                              pressure[] = {vectors(npz, "cop_left"), vectors(npz, "cop_right")};
  const std::size_t samples = force[0].size();
  for (const auto* other : {&force[1], &pressure[0], &pressure[1]})
    if (other->size() != samples)
      throw DataError(npz.path, "grf_left", std::to_string(other->size()) + " rows, as its other foot has",
                      std::to_string(samples));
  std::vector<double> valid(2 * samples, 1.0);
  if (npz.has("valid")) valid = npz.at("valid").to_double();
  if (valid.size() != 2 * samples) throw DataError(npz.path, "valid", "two values a sample", "others");
  const double rate = positive_number(npz, "grf_fps");
  MeasuredForces measured;
  for (std::size_t i = 0; i < samples; ++i) {
    ForceSample& sample = measured.samples.emplace_back();
    sample.time = static_cast<double>(i) / rate;
    for (int foot = 0; foot < 2; ++foot) {
      sample.force[foot] = force[foot][i];
      sample.pressure[foot] = pressure[foot][i];
      sample.valid[foot] = valid[2 * i + static_cast<std::size_t>(foot)] != 0.0;
    }
  }
  if (!npz.has("valid") && samples > 0) mark_unseen(measured);
  if (npz.has("mass")) measured.mass = positive_number(npz, "mass");
  if (!npz.has("joints")) return measured;
  const NpyArray& joints = npz.at("joints");
  if (joints.shape.size() != 3 || joints.shape[1] != kBodies || joints.shape[2] != 3)
    throw DataError(npz.path, "joints", "(frames, 22, 3)", "another shape");
  const std::vector<double> values = joints.to_double();
  measured.joints.resize(joints.shape[0]);
  measured.joints_fps = positive_number(npz, "fps");
  for (std::size_t t = 0; t < joints.shape[0]; ++t)
    for (std::size_t b = 0; b < kBodies; ++b)
      measured.joints[t][b] = Eigen::Map<const Vector3d>(&values[3 * (kBodies * t + b)]);
  return measured;
}

}  // namespace

MeasuredForces read_measured_forces(const std::filesystem::path& path) {
  return measured_forces_from(read_file(path), path);
}

MeasuredForces measured_forces_from(const std::string& bytes, const std::filesystem::path& path) {
  const MeasuredForces measured = bytes.starts_with("PK\x03\x04") ? from_npz(parse_npz(bytes, path.string()))
                                                                  : from_mot(bytes, path.string());
  if (measured.samples.empty()) throw DataError(path.string(), "", "at least one sample of forces", "none");
  for (std::size_t i = 0; i < measured.samples.size(); ++i)
    for (const Vector3d& force :
         {measured.samples[i].force[0], measured.samples[i].force[1], measured.samples[i].rest})
      if (!force.allFinite())
        throw DataError(path.string(), "sample " + std::to_string(i), "finite forces", "one that is not");
  return measured;
}

}  // namespace mimicx::import
