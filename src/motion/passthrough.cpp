#include "motion/passthrough.h"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <string_view>

#include "core/so3.h"

namespace mimicx::motion {
namespace {

using Type = NpyArray::Type;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The rows with the indices of `source`, unchanged.
NpyArray picked(const NpyArray& array, std::size_t count,
                const std::function<std::size_t(std::size_t)>& source) {
  NpyArray out;
  out.type = array.type;
  out.shape = array.shape;
  out.shape[0] = count;
  const std::size_t rows = array.shape[0], texts = array.text.size() / rows,
                    width = array.bytes.size() / rows;
  const auto append = [](const auto& from, std::size_t row, std::size_t n, auto& to) {
    const auto first = from.begin() + static_cast<std::ptrdiff_t>(row * n);
    to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(n));
  };
  for (std::size_t k = 0; k < count; ++k) {
    append(array.text, source(k), texts, out.text);
    append(array.bytes, source(k), width, out.bytes);
  }
  return out;
}

bool has_fractions(const NpyArray& array) {
  return array.type == Type::kFloat32 || array.type == Type::kFloat64;
}

/// Numbers in the type in which they were read.
NpyArray of_type(Type type, std::vector<std::size_t> shape, const Rows& values) {
  if (type == Type::kFloat64) return NpyArray::from_double(std::move(shape), values.data());
  const std::vector<float> narrow(values.data(), values.data() + values.size());
  return NpyArray::from_float(std::move(shape), narrow.data());
}

bool contains_one_of(std::string_view name, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return name.find(word) != std::string_view::npos; });
}

/// Whether files have rotation vectors of joints under this name.
bool names_rotations(std::string_view name) {
  if (contains_one_of(name, {"keypoint", "2d", "3d", "conf", "pca", "quat", "matri"})) return false;
  for (const std::string_view whole :
       {"poses", "poses_rest", "smpl_poses", "fullpose", "full_pose", "thetas", "theta", "pose"})
    if (name == whole) return true;
  return contains_one_of(
      name, {"orient", "body_pose", "pose_body", "hand_pose", "pose_hand", "pose_lhand", "pose_rhand",
             "jaw_pose", "pose_jaw", "eye_pose", "pose_eye", "pose_leye", "pose_reye"});
}

/// Whether the rows are rotation vectors by their name, width and size: none is over a whole turn. A hand has
/// 15 joints; of other widths it is given by coefficients.
bool are_rotations(const std::string& name, const Eigen::Ref<const Rows>& rows) {
  const Eigen::Index width = name.find("hand") != std::string::npos ? 45 : 3;
  if (!names_rotations(name) || rows.cols() % width != 0) return false;
  for (Eigen::Index r = 0; r < rows.rows(); ++r)
    for (Eigen::Index c = 0; c < rows.cols(); c += 3)
      if (rows.row(r).segment<3>(c).norm() > 2.0 * std::numbers::pi) return false;
  return true;
}

NpyArray between_rows(const std::string& name, const NpyArray& array, std::size_t count, double ratio) {
  const std::vector<double> numbers = array.to_double();
  const auto rows = static_cast<Eigen::Index>(array.shape[0]);
  const auto columns = static_cast<Eigen::Index>(numbers.size()) / rows;
  const Eigen::Map<const Rows> from(numbers.data(), rows, columns);
  const bool turns = are_rotations(name, from);
  Rows to(static_cast<Eigen::Index>(count), columns);
  for (std::size_t k = 0; k < count; ++k) {
    const RowsBetween at = locate_rows(static_cast<double>(k) * ratio, array.shape[0]);
    const auto a = from.row(static_cast<Eigen::Index>(at.row)),
               b = from.row(static_cast<Eigen::Index>(at.next));
    auto row = to.row(static_cast<Eigen::Index>(k));
    row = at.share == 0.0 ? Eigen::RowVectorXd(a) : Eigen::RowVectorXd((1.0 - at.share) * a + at.share * b);
    if (!turns || at.share == 0.0) continue;
    for (Eigen::Index c = 0; c < columns; c += 3) {
      const Vector3d first = a.segment<3>(c), second = b.segment<3>(c);
      row.segment<3>(c) = log_map(slerp(exp_map(first), at.share, exp_map(second)));
    }
  }
  std::vector<std::size_t> shape = array.shape;
  shape[0] = count;
  return of_type(array.type, std::move(shape), to);
}

Passthrough frames_from(const Passthrough& members, std::size_t frames, std::size_t first,
                        std::size_t count) {
  Passthrough out = members;
  for (auto& [name, array] : out)
    if (is_per_frame(name, array, frames))
      array = picked(array, count, [first](std::size_t k) { return first + k; });
  return out;
}

}  // namespace

RowsBetween locate_rows(double at, std::size_t rows) {
  const std::size_t row = std::min(static_cast<std::size_t>(at), rows - 1);
  return {row, std::min(row + 1, rows - 1), std::clamp(at - static_cast<double>(row), 0.0, 1.0)};
}

bool is_per_frame(const std::string& name, const NpyArray& array, std::size_t frames) {
  const bool rows = frames > 0 && !array.shape.empty() && array.shape[0] == frames;
  return rows && name != "betas_rest";  // one shape, not a row per frame
}

Passthrough resampled_members(const Passthrough& members, std::size_t frames, std::size_t count,
                              double ratio) {
  Passthrough out = members;
  for (auto& [name, array] : out) {
    if (!is_per_frame(name, array, frames)) continue;
    if (has_fractions(array))
      array = between_rows(name, array, count, ratio);
    else
      array = picked(array, count, [&](std::size_t k) {
        return locate_rows(static_cast<double>(k) * ratio, frames).nearest();
      });
  }
  return out;
}

Passthrough first_frames(const Passthrough& members, std::size_t frames, std::size_t count) {
  return frames_from(members, frames, 0, count);
}

Passthrough last_frames(const Passthrough& members, std::size_t frames, std::size_t count) {
  return frames_from(members, frames, frames - count, count);
}

}  // namespace mimicx::motion
