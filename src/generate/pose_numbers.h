/// A motion as rows of numbers, as a generator learns and makes them.
///
/// A row per frame, at 30 frames per second, of the standard body (`kPoseNumbers` numbers):
///
///     0, 1     m      way of the pelvis since the frame before, in that frame's heading
///     2        rad    turn of the heading since the frame before
///     3        m      height of the pelvis
///     4 … 6    rad    rotation vector of the pelvis from upright, in its own heading
///     7 … 69   rad    rotation vectors of the 21 joints, in the order of `Body`
///
/// Lengths of other bodies are scaled by the height of the pelvis over the soles at rest, so that a standing
/// foot of any body stands on the floor.
///
/// What it does not do: place and heading of the first frame are lost.
#pragma once

#include <span>
#include <string>

#include "motion/clip.h"
#include "nn/matrix.h"

namespace mimicx::generate {

inline constexpr int kPoseNumbers = 7 + 3 * (kBodies - 1);
inline constexpr double kFramesPerSecond = 30.0;

/// [frames, kPoseNumbers]; the first frame repeats way and turn of the second.
/// @throws DataError for a clip of fewer than 2 frames, or at another rate
nn::Matrix<float> pose_numbers(const motion::Clip& clip);

/// The motion of the standard body. It begins over the origin with heading 0.
motion::Clip clip_of_numbers(const std::string& name, const nn::Matrix<float>& numbers);

/// A motion and what it shows.
struct LabelledMotion {
  int label = 0;
  nn::Matrix<float> numbers;  ///< [frames, kPoseNumbers]
};

/// @throws std::invalid_argument without motions, or for one that has fewer frames or no label below `labels`
void require_learnable(std::span<const LabelledMotion> motions, int labels, int frames);

/// The rows of all motions below each other.
nn::Matrix<float> rows_of(std::span<const LabelledMotion> motions);

/// What is told about the frame that is made: the label (one-hot), the share of the motion that is done
/// (weights of kHats evenly spaced hats) and the motion's length in tens of seconds.
inline constexpr int kHats = 8;
inline int condition_numbers(int labels) { return labels + kHats + 1; }
/// @param row  [condition_numbers(labels)] overwritten
void write_condition(int label, int labels, double share, int frames, float* row);

}  // namespace mimicx::generate
