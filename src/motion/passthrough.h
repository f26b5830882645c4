/// Members of a file that the program does not use, such as hands, face and soft tissue, after a change of
/// the frames.
///
/// A member whose first dimension is the number of frames is resampled or cut with the frames; every other
/// member stays unchanged.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/npz/npz.h"

namespace mimicx::motion {

using Passthrough = std::vector<std::pair<std::string, NpyArray>>;

/// A time between two rows, or frames, of the input.
struct RowsBetween {
  std::size_t row, next;
  double share;  ///< of the next row
  std::size_t nearest() const { return share < 0.5 ? row : next; }
};
/// @param at  in rows
RowsBetween locate_rows(double at, std::size_t rows);

/// Whether a member has one row per frame.
bool is_per_frame(const std::string& name, const NpyArray& array, std::size_t frames);

/// Members at another frame rate: row k of the result is row k · ratio of the input. Rotations (axis-angle,
/// by the names that files use for orientations and for poses of body, hands, jaw and eyes, and only where no
/// angle is over a whole turn) are interpolated by slerp, other floating-point numbers linearly; integers and
/// texts are taken from the nearer frame. @param frames  of the input @param count  frames of the result
Passthrough resampled_members(const Passthrough& members, std::size_t frames, std::size_t count,
                              double ratio);

/// Members of the first frames of a clip.
Passthrough first_frames(const Passthrough& members, std::size_t frames, std::size_t count);
/// Members of the last frames of a clip.
Passthrough last_frames(const Passthrough& members, std::size_t frames, std::size_t count);

}  // namespace mimicx::motion
