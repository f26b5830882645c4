/// OpenSim's marker files (.trc): where the markers of a motion capture were.
///
/// Five lines of header and a row per frame, divided by tabs: "PathFileType …", the keys DataRate, NumFrames,
/// NumMarkers and Units, their values, "Frame# Time" with the markers' names above their x columns, X1 Y1 Z1
/// … A cell that is blank or no number ("nan"), and a marker at (0, 0, 0), say that a marker was not seen.
/// Format: OpenSim, "Marker (.trc) Files" of its User's Guide.
///
/// What it does not do: axes stay as they are (y up by OpenSim's custom). Frame# and Time only show that no
/// row is missing or out of order; the rate is DataRate.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/containers.h"
#include "core/so3.h"

namespace mimicx::import {

/// Where a point was in each frame, m.
using Track = PerFrame<Vector3d>;

struct Markers {
  std::string path;      ///< of the file, for messages
  double fps = 0.0;      ///< DataRate
  double seconds = 0.0;  ///< from the first to the last row, by the Time column; 0: it does not say
  double unit = 1.0;     ///< metres per unit of the file
  std::vector<std::string> names;
  std::vector<Track> tracks;  ///< of each marker; NaN where it was not seen
};

/// @param path   for messages
/// @param metres  per unit of the file, whatever Units says; none: by Units
/// @throws DataError for a header that lacks one of these, for rows of another number or length, and where
/// Frame# or Time does not go on by one step
Markers parse_trc(std::string_view text, const std::string& path, std::optional<double> metres = {});

/// Fills gaps of at most 0.2 s: between two frames by the cubic with the speeds around the gap, at the ends
/// by the nearest frame. @return how long the longest gap that stays is, s; 0: none
double fill_gaps(double fps, Track& track);

}  // namespace mimicx::import
