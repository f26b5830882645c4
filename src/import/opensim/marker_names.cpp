#include "import/opensim/marker_names.h"

#include <cctype>
#include <optional>

#include "core/error.h"
#include "import/plausibility.h"

namespace mimicx::import {
namespace {

struct LandmarkWords {
  Landmark landmark;
  const char* place;  ///< for messages
  std::vector<std::string_view> words;
};

const std::vector<LandmarkWords>& rows() {
  static const std::vector<LandmarkWords> table = {
      {kAsis, "anterior superior iliac spine (ASIS)", {"asis", "asi"}},
      {kPsis, "posterior superior iliac spine (PSIS)", {"psis", "psi"}},
      {kSacrum, "sacrum", {"sacrum", "sacral", "vsacral", "sacr", "s2"}},
      {kKneeMarker, "knee", {"knee", "kne", "kneelat", "latknee", "lfe", "lfc"}},
      {kMedialKnee, "medial knee", {"kneemed", "medknee", "mknee", "kneem", "mfe", "mfc"}},
      {kAnkleMarker, "ankle", {"ankle", "ank", "anklelat", "latankle", "lmal"}},
      {kMedialAnkle, "medial ankle", {"anklemed", "medankle", "mankle", "anklem", "mmal"}},
      {kHeel, "heel", {"heel", "hee", "calc"}},
      {kToe, "toe", {"toe", "toetip", "bigtoe", "mt2"}},
      {kFirstToe, "first metatarsal", {"toemed", "mt1", "mtp1", "d1m"}},
      {kFifthToe, "fifth metatarsal", {"toelat", "mt5", "mtp5", "5meta", "d5m"}},
      {kShoulderMarker, "shoulder", {"acromium", "acromion", "shoulder", "sho", "sae", "acr"}},
      {kElbowMarker, "elbow", {"elbow", "elb", "elbowlat", "lelbow", "lhe"}},
      {kMedialElbow, "medial elbow", {"elbowmed", "melbow", "elbowm", "mhe"}},
      {kWristMarker, "wrist", {"wrist", "wri", "wristlat", "lwrist", "wra"}},
      {kMedialWrist, "medial wrist", {"wristmed", "mwrist", "wristm", "wrb"}},
      {kHeadMarker, "head", {"temple", "head", "fhd", "bhd"}},
      {kThighMarker, "thigh", {"thigh", "thi", "th"}},
      {kShankMarker, "shank", {"shank", "tibia", "tib", "sh"}}};
  return table;
}

/// Lower-case letters and digits behind the last ':'.
std::string core_of(const std::string& name) {
  std::string core;
  for (const char c : name.substr(name.find_last_of(':') + 1))
    if (std::isalnum(static_cast<unsigned char>(c)))
      core += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const std::string_view end : {"study", "augmenter"})
    if (core.size() > end.size() && core.ends_with(end)) core.resize(core.size() - end.size());
  return core;
}

/// A segment's markers have numbers and places behind their word: "TH1", "Thigh.Upper".
bool names_segment(std::string_view core, std::string_view word) {
  if (!core.starts_with(word)) return false;
  const std::string_view rest = core.substr(word.size());
  return rest.find_first_not_of("0123456789") == std::string_view::npos || rest == "upper" ||
         rest == "front" || rest == "rear";
}

std::optional<Landmark> landmark_of(std::string_view core) {
  for (const LandmarkWords& row : rows())
    for (const std::string_view word : row.words)
      if (core == word ||
          ((row.landmark == kThighMarker || row.landmark == kShankMarker) && names_segment(core, word)))
        return row.landmark;
  return std::nullopt;
}

/// Landmark and side of a name.
std::optional<std::pair<Landmark, int>> meaning_of(const std::string& name) {
  const std::string core = core_of(name);
  if (landmark_of(core) == kSacrum) return std::pair(kSacrum, 0);
  for (const auto& [mark, side] :
       {std::pair<std::string_view, int>{"left", 0}, {"right", 1}, {"l", 0}, {"r", 1}}) {
    const std::string_view whole = core;
    if (whole.starts_with(mark))
      if (const auto found = landmark_of(whole.substr(mark.size()))) return std::pair(*found, side);
    if (whole.ends_with(mark))
      if (const auto found = landmark_of(whole.substr(0, whole.size() - mark.size())))
        return std::pair(*found, side);
  }
  return std::nullopt;
}

}  // namespace

NamedMarkers::NamedMarkers(const Markers& markers) : path_(markers.path) {
  std::string left_out;
  for (std::size_t i = 0; i < markers.names.size(); ++i) {
    const auto meaning = meaning_of(markers.names[i]);
    if (!meaning) continue;
    const auto [landmark, side] = *meaning;
    Track track = markers.tracks[i];
    const double unseen = fill_gaps(markers.fps, track);
    if (unseen > 0.0) {
      unseen_[landmark][side] = markers.names[i] + ", unseen for " + short_number(unseen) + " s";
      left_out += (left_out.empty() ? "" : ", ") + markers.names[i];
      continue;
    }
    ++used;
    tracks_[landmark][side].push_back(track);
    if (landmark == kSacrum) tracks_[landmark][1].push_back(track);
  }
  if (!left_out.empty())
    warnings.push_back("markers that were not seen for more than 0.2 s are left out: " + left_out);
}

const Track& NamedMarkers::one(Landmark landmark, int side) const {
  if (!has(landmark, side))
    fail(landmark, side,
         std::string("a marker on the ") + (side == 0 ? "left " : "right ") + rows()[landmark].place);
  return all(landmark, side)[0];
}

void NamedMarkers::fail(Landmark landmark, int side, const std::string& expected) const {
  const std::string& unseen = unseen_[landmark][side];
  throw DataError(path_, "markers", expected,
                  unseen.empty() ? "none by its name (docs/formats.md, \"Markers\")" : unseen);
}

}  // namespace mimicx::import
