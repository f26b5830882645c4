/// The needs of a motion (pose_needs.h) as summary values and in words.
///
/// A frame is infeasible if it needs an external force of more than 5 % of the weight, or an external moment
/// of more than 5 cm times the weight (`kTooMuch`). The fault is named after the largest of four: force up,
/// force down, force sideways, and moment per metre. A frame that needs nothing is also infeasible if a
/// contact point is more than 5 cm under the floor or in a side of a box (`kTooDeep`).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "audit/pose_needs.h"
#include "core/named_values.h"

namespace mimicx::audit {

inline constexpr double kTooMuch = 0.05;  ///< of the weight; as a moment: metres times the weight

inline constexpr double kTooDeep = 0.05;  ///< m

enum class Wrong {
  kNothing,
  kHovers,    ///< needs a force up: it does not fall, and no contact can carry it
  kPulled,    ///< needs a force down: it falls faster than free fall, or stops rising sooner
  kDrifts,    ///< needs a force sideways, without contact
  kTurns,     ///< needs a moment, without contact
  kSlips,     ///< needs more force sideways than friction can give
  kTipsOver,  ///< needs a moment: the needed centre of pressure is outside the contacts
  kSunk       ///< needs nothing, but is deep under the floor or in a box
};
inline constexpr int kWrongs = 8;
/// "feasible", "hovers", "pulled", "drifts", "turns", "slips", "tips", "sunk".
std::string_view name_of(Wrong wrong);
Wrong wrong_with(const PoseNeed& need, double weight);

/// Consecutive infeasible frames.
struct Stretch {
  int first = 0, last = 0;
  Wrong wrong = Wrong::kNothing;     ///< in most of them
  double force = 0.0, moment = 0.0;  ///< largest of them, N, N·m
  double depth = 0.0;                ///< of the deepest point in the floor, m
  double in_box = 0.0;               ///< of the deepest point in a side of a box, m
  int frames() const { return last - first + 1; }
};
std::vector<Stretch> infeasible_stretches(const PoseNeeds& needs);
/// "frames 61-78: the body hovers; 310 N would have to hold it". Has no commas, for CSV files.
std::string in_words(const Stretch& stretch);

struct PoseVerdict {
  NamedValues values;         ///< for tables; units are in the names
  Stretch longest;            ///< of no frames: frames() is 1 and `wrong` is kNothing
  std::string joints_over;    ///< "left_knee:12 spine1:3": joints over their bounds and in how many frames
  std::string over_in_words;  ///< the same for people: "left knee 12, spine1 3"
  std::string words;          ///< one sentence
};
PoseVerdict verdict_on(const PoseNeeds& needs);

}  // namespace mimicx::audit
