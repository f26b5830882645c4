/// The kinds of synthetic motion, as plans.
///
/// A kind draws its parameters from the random stream it is given and fills one `PlanFrame` per frame. Two
/// draws never stand in one argument list: compilers differ in the order of evaluation.
/// To add a kind: write its plan beside its like (synth_kinds_standing, _walking, _jump, _fighting …) and
/// name it at the end of `synth_kinds()`: the random streams are keyed by the place in that list.
#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "core/units.h"
#include "motion/synth/plan.h"

namespace mimicx {

inline constexpr double kSynthFps = 30.0;

/// What a plan is made for.
struct PlanRequest {
  const Character& character;
  Random& random;
  int frames;

  double seconds() const { return (frames - 1) / kSynthFps; }
};

struct SynthKind {
  std::string name;
  double shortest, longest;  ///< range of the length where none is asked for, s
  std::vector<PlanFrame> (*plan)(const PlanRequest&);
};

const std::vector<SynthKind>& synth_kinds();

/// A frame that stands at ease on `feet` with slightly bent knees, and the height of its centre of mass.
PlanFrame standing_frame(const Character& character, const FeetTracks& feet);

/// Two feet apart at random. @param narrow, wide  half width in units of the rest pose's
/// @param least_out, most_out  how far the toes turn out, degrees
std::array<FootTarget, 2> random_stance(const PlanRequest& request, double narrow, double wide,
                                        double least_out, double most_out);

/// Time of a frame, s.
inline double time_of(std::size_t frame) { return static_cast<double>(frame) / kSynthFps; }

std::vector<PlanFrame> plan_stand(const PlanRequest& request);
std::vector<PlanFrame> plan_squat(const PlanRequest& request);
std::vector<PlanFrame> plan_wave(const PlanRequest& request);
std::vector<PlanFrame> plan_bow(const PlanRequest& request);
std::vector<PlanFrame> plan_walk(const PlanRequest& request);
std::vector<PlanFrame> plan_walk_turn(const PlanRequest& request);
std::vector<PlanFrame> plan_side_step(const PlanRequest& request);
std::vector<PlanFrame> plan_turn_in_place(const PlanRequest& request);
std::vector<PlanFrame> plan_jump(const PlanRequest& request);
std::vector<PlanFrame> plan_jog(const PlanRequest& request);
std::vector<PlanFrame> plan_dance(const PlanRequest& request);
std::vector<PlanFrame> plan_kick(const PlanRequest& request);
std::vector<PlanFrame> plan_punch(const PlanRequest& request);
std::vector<PlanFrame> plan_lunge(const PlanRequest& request);

}  // namespace mimicx
