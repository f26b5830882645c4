/// The needs of a motion in a few numbers and in words.
///
/// A frame is infeasible where more than 5 % of the weight, or 5 cm times the weight as a moment, would have
/// to come from outside (`kTooMuch`). What is wrong with it is named after the largest of the four: force up,
/// down, sideways, and moment per metre. A frame that needs nothing is infeasible all the same where a
/// contact point is deeper than 5 cm in the floor (`kTooDeep`): the floor that carries it there is none.
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
  kHovers,    ///< needs a force up: it does not fall, and nothing touches that could carry it
  kPulled,    ///< needs a force down: it falls faster than free fall, or stops rising sooner
  kDrifts,    ///< needs a force sideways, nothing touches
  kTurns,     ///< needs a moment, nothing touches
  kSlips,     ///< needs a force sideways beyond the floor's friction
  kTipsOver,  ///< needs a moment: what must push lies outside of where it touches
  kSunk       ///< needs nothing, but is deep in the floor
};
inline constexpr int kWrongs = 8;
/// "feasible", "hovers", "pulled", "drifts", "turns", "slips", "tips", "sunk".
std::string_view name_of(Wrong wrong);
Wrong wrong_with(const PoseNeed& need, double weight);

/// Frames in a row that are infeasible.
struct Stretch {
  int first = 0, last = 0;
  Wrong wrong = Wrong::kNothing;     ///< in most of them
  double force = 0.0, moment = 0.0;  ///< largest of them, N, N·m
  double depth = 0.0;                ///< of the deepest point in the floor, m
  int frames() const { return last - first + 1; }
};
std::vector<Stretch> infeasible_stretches(const PoseNeeds& needs);
/// "frames 61-78: the body hovers; 310 N would have to hold it". No commas, so that it can stand in a CSV.
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
