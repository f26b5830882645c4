/// Measures of a motion by which reading decides: its floor, its speeds.
///
/// A file that is read with the wrong axes, unit or frame rate still holds valid numbers, but its motion is
/// implausible. The decisions themselves stand in import/evidence, one file each.
///
/// What it does not do: no change of the clip (world_transform.h does), no repair of single frames
/// (motion/prepare/glitches.h).
#pragma once

#include <string>
#include <vector>

#include "motion/clip.h"

namespace mimicx::import {

/// A number with three significant digits, for sentences.
std::string short_number(double value);

/// Quantile of the finite values; 0 without any. Absurd input can give values that are not finite.
double finite_quantile(std::vector<double> values, double share);

/// Median over the frames of the speed of the slowest joint, m/s: the joint that supports the body hardly
/// moves.
double support_speed(const motion::Clip& clip);
/// The same of its poses.
double support_speed(const PerFrame<BodyPoses>& poses, double fps);

/// Steps of the fastest joint, m/s; entry t is from frame t to frame t + 1.
PerFrame<double> joint_speeds(const PerFrame<BodyPoses>& poses, double fps);

/// Height of the floor: a low percentile of the heights of the body's lowest point, m.
double detect_floor(const motion::Clip& clip);

/// Warnings of speeds that no human reaches.
std::vector<std::string> implausible_speeds(const motion::Clip& clip);

}  // namespace mimicx::import
