/// The kinds of synthetic motion, as plans.
///
/// A kind draws its parameters from the random stream of the request and fills one `PlanFrame` per frame.
/// Never write two draws in one argument list: compilers differ in the order of evaluation. To add a kind:
/// write its plan in a file of the folder kinds, declare it below and name it at the end of `synth_kinds()`.
/// The position in that list is the key of its random streams.
#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "core/units.h"
#include "synth/footsteps.h"

namespace mimicx::synth {

struct SynthPose;

/// The input of a kind.
struct PlanRequest {
  const Character& character;
  Random& random;
  int frames;

  double seconds() const { return (frames - 1) / kSynthFps; }
  /// A plan that repeats one frame.
  PerFrame<PlanFrame> every_frame(const PlanFrame& frame) const { return PerFrame<PlanFrame>(frames, frame); }
};

struct SynthKind {
  std::string name;
  double shortest, longest;  ///< range of the default length, s
  PerFrame<PlanFrame> (*plan)(const PlanRequest&);
};

const std::vector<SynthKind>& synth_kinds();

/// A kind that is made by geometry only, without balance (synth/sketch.h).
struct SketchedKind {
  std::string name;
  double shortest, longest;  ///< as in SynthKind
  PerFrame<SynthPose> (*draw)(const PlanRequest&);
};

const std::vector<SketchedKind>& sketched_kinds();

/// A motion on ground of its own.
struct SceneMotion {
  PerFrame<SynthPose> poses;
  Scene scene;  ///< in the plan frame
};
/// A kind on stairs, kerbs, boxes, seats and beds.
struct SceneKind {
  std::string name;
  double shortest, longest;  ///< as in SynthKind
  SceneMotion (*make)(const PlanRequest&);
};

const std::vector<SceneKind>& scene_kinds();

/// A frame of standing at ease on `feet` with slightly bent knees; its `com_height` is set.
PlanFrame standing_frame(const Character& character, const FeetTracks& feet);
PlanFrame standing_frame(const Character& character, const PerSide<FootTarget>& start);

/// Two feet at a random distance. @param narrow, wide  range of half the distance over the rest pose's
/// @param least_out, most_out  range of the angle by which the toes turn out, degrees
PerSide<FootTarget> random_stance(const PlanRequest& request, double narrow, double wide, double least_out,
                                  double most_out);

// The plans: kinds/standing.cpp
PerFrame<PlanFrame> plan_stand(const PlanRequest& request);
PerFrame<PlanFrame> plan_squat(const PlanRequest& request);
PerFrame<PlanFrame> plan_wave(const PlanRequest& request);
PerFrame<PlanFrame> plan_bow(const PlanRequest& request);
// kinds/walking.cpp
PerFrame<PlanFrame> plan_walk(const PlanRequest& request);
PerFrame<PlanFrame> plan_walk_turn(const PlanRequest& request);
PerFrame<PlanFrame> plan_side_step(const PlanRequest& request);
PerFrame<PlanFrame> plan_turn_in_place(const PlanRequest& request);
// kinds/jump.cpp
PerFrame<PlanFrame> plan_jump(const PlanRequest& request);
PerFrame<PlanFrame> plan_jumps(const PlanRequest& request);
// kinds/jog.cpp
PerFrame<PlanFrame> plan_jog(const PlanRequest& request);
// kinds/dance.cpp
PerFrame<PlanFrame> plan_dance(const PlanRequest& request);
// kinds/fighting.cpp
PerFrame<PlanFrame> plan_kick(const PlanRequest& request);
PerFrame<PlanFrame> plan_punch(const PlanRequest& request);
PerFrame<PlanFrame> plan_lunge(const PlanRequest& request);
// kinds/walking_directions.cpp
PerFrame<PlanFrame> plan_walk_back(const PlanRequest& request);
PerFrame<PlanFrame> plan_walk_diagonal(const PlanRequest& request);
PerFrame<PlanFrame> plan_walk_curve(const PlanRequest& request);
PerFrame<PlanFrame> plan_walk_stop(const PlanRequest& request);
PerFrame<PlanFrame> plan_shuffle(const PlanRequest& request);
PerFrame<PlanFrame> plan_turn_around(const PlanRequest& request);
PerFrame<PlanFrame> plan_walk_crouched(const PlanRequest& request);
// kinds/one_leg.cpp
PerFrame<PlanFrame> plan_balance(const PlanRequest& request);
PerFrame<PlanFrame> plan_kick_around(const PlanRequest& request);
PerFrame<PlanFrame> plan_march(const PlanRequest& request);
// kinds/crouching.cpp
PerFrame<PlanFrame> plan_crouch(const PlanRequest& request);
PerFrame<PlanFrame> plan_sit(const PlanRequest& request);
PerFrame<PlanFrame> plan_pick_up(const PlanRequest& request);
PerFrame<PlanFrame> plan_lunge_around(const PlanRequest& request);
// kinds/gestures.cpp
PerFrame<PlanFrame> plan_reach(const PlanRequest& request);
PerFrame<PlanFrame> plan_talk(const PlanRequest& request);
PerFrame<PlanFrame> plan_stretch(const PlanRequest& request);
PerFrame<PlanFrame> plan_arm_swings(const PlanRequest& request);
// kinds/random_sequences.cpp
PerFrame<PlanFrame> plan_martial(const PlanRequest& request);
PerFrame<PlanFrame> plan_free(const PlanRequest& request);

// The sketches: kinds/floor.cpp
/// Down on one knee, on both, gestures there, up again.
PerFrame<SynthPose> sketch_kneel(const PlanRequest& request);
/// Down on hands and knees, some steps on them, up again.
PerFrame<SynthPose> sketch_crawl(const PlanRequest& request);
/// Over hands and knees down onto the front, a rest, up again.
PerFrame<SynthPose> sketch_lie_down(const PlanRequest& request);

// On scenes, exact: kinds/stepping.cpp
SceneMotion climb_stairs(const PlanRequest& request);
SceneMotion descend_stairs(const PlanRequest& request);
/// Onto a kerb, along it and down again.
SceneMotion cross_kerb(const PlanRequest& request);
/// Onto a box with both feet and down on its other side.
SceneMotion cross_box(const PlanRequest& request);
// On scenes, sketches: kinds/seats.cpp
/// Sits down and stands up.
SceneMotion sit_down(const PlanRequest& request);
/// The same, with gestures while sitting.
SceneMotion sit_and_reach(const PlanRequest& request);
/// Sits down on the end of a bed, lies down on the back with the feet on the floor, and gets up.
SceneMotion lie_on_bed(const PlanRequest& request);

}  // namespace mimicx::synth
