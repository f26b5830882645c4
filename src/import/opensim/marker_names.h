/// What the markers of a person sit on, by their names.
///
/// Case, blanks and punctuation do not matter, nor what stands before a ':'. A side is "r", "l", "right" or
/// "left" in front or behind ("R.ASIS", "RASI", "r_knee_study", "Ankle_L"). The rest is a word of the table
/// in marker_names.cpp (docs/formats.md, "Markers"): those of OpenSim's examples (Gait10dof18musc,
/// Rajagopal), Plug-in Gait and OpenCap.
#pragma once

#include "import/opensim/markers.h"

namespace mimicx::import {

/// Knees, ankles, elbows and wrists: the lateral marker.
enum Landmark {
  kAsis,
  kPsis,
  kSacrum,
  kKneeMarker,
  kMedialKnee,
  kAnkleMarker,
  kMedialAnkle,
  kHeel,
  kToe,
  kFirstToe,
  kFifthToe,
  kShoulderMarker,
  kElbowMarker,
  kMedialElbow,
  kWristMarker,
  kMedialWrist,
  kHeadMarker,
  kThighMarker,
  kShankMarker,
  kLandmarks
};

/// The markers of a person, their gaps filled (`fill_gaps`).
class NamedMarkers {
 public:
  explicit NamedMarkers(const Markers& markers);

  /// @param side  0 left, 1 right; the sacrum is on both
  const std::vector<Track>& all(Landmark landmark, int side) const { return tracks_[landmark][side]; }
  bool has(Landmark landmark, int side) const { return !all(landmark, side).empty(); }
  /// The first marker of its name. @throws DataError that says what is missing, or how long it was not seen
  const Track& one(Landmark landmark, int side) const;
  /// @param expected  in words, behind "left" or "right"
  [[noreturn]] void fail(Landmark landmark, int side, const std::string& expected) const;

  int used = 0;                       ///< number of markers that have a landmark and are seen
  std::vector<std::string> warnings;  ///< one line of the markers that are left out

 private:
  std::string path_;
  Array<Array<std::vector<Track>, 2>, kLandmarks> tracks_;
  Array<Array<std::string, 2>, kLandmarks> unseen_;  ///< "R.ASIS, unseen for 0.4 s"
};

}  // namespace mimicx::import
