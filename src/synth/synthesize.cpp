#include "synth/synthesize.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "synth/kinds.h"
#include "synth/whole_body_balance.h"

namespace mimicx::synth {
namespace {

// Purposes of the random streams.
constexpr std::uint64_t kPlanStream = 0x53594E01, kPlaceStream = 0x53594E02, kShapeStream = 0x53594E03;

std::array<double, kBetas> shape_of(const SynthConfig& config) {
  std::array<double, kBetas> betas = config.betas;
  Random random(config.seed, {kShapeStream});
  if (config.betas_from_seed)
    for (double& beta : betas) beta += std::clamp(0.7 * random.normal(), -2.0, 2.0);
  return betas;
}

template <class Kind>
const Kind* find_kind(const std::vector<Kind>& kinds, const std::string& name) {
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}

template <class Kind>
std::vector<std::string> names_of(const std::vector<Kind>& kinds) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds) names.push_back(kind.name);
  return names;
}

}  // namespace

std::uint64_t index_of_kind(const std::string& name) {
  constexpr std::uint64_t kFirstSketch = 1000;  // room for kinds to come
  if (const SynthKind* kind = find_kind(synth_kinds(), name))
    return static_cast<std::uint64_t>(kind - synth_kinds().data());
  if (const SketchedKind* kind = find_kind(sketched_kinds(), name))
    return kFirstSketch + static_cast<std::uint64_t>(kind - sketched_kinds().data());
  constexpr std::uint64_t kFirstScene = 2000;
  if (const SceneKind* kind = find_kind(scene_kinds(), name))
    return kFirstScene + static_cast<std::uint64_t>(kind - scene_kinds().data());
  throw std::invalid_argument("unknown kind of motion '" + name + "'");
}

std::vector<std::string> synthetic_kinds() { return names_of(synth_kinds()); }
std::vector<std::string> floor_kinds() { return names_of(sketched_kinds()); }
std::vector<std::string> ground_kinds() { return names_of(scene_kinds()); }

std::vector<std::string> basic_kinds() {
  constexpr std::ptrdiff_t kBasicKinds = 14;
  std::vector<std::string> names = synthetic_kinds();
  names.erase(names.begin() + kBasicKinds, names.end());
  return names;
}

std::string name_of(const SynthConfig& config) { return config.kind + "_" + std::to_string(config.seed); }

motion::Clip synthesize(const SynthConfig& config) {
  const std::uint64_t index = index_of_kind(config.kind);
  Random random(config.seed, {kPlanStream, index}), place(config.seed, {kPlaceStream, index});
  const auto exact = find_kind(synth_kinds(), config.kind);
  const auto sketched = find_kind(sketched_kinds(), config.kind);
  const auto on_scene = find_kind(scene_kinds(), config.kind);
  const auto [shortest, longest] = exact != nullptr      ? std::pair(exact->shortest, exact->longest)
                                   : sketched != nullptr ? std::pair(sketched->shortest, sketched->longest)
                                                         : std::pair(on_scene->shortest, on_scene->longest);
  const double chosen = random.uniform(shortest, longest);
  const double seconds = config.seconds == 0.0 ? chosen : config.seconds;
  if (!(seconds >= 4.0 && seconds <= 60.0))
    throw std::invalid_argument("synthesize: the length must be 4 to 60 s");
  const Character character = make_character(shape_of(config));
  const int frames = static_cast<int>(std::lround(seconds * kSynthFps)) + 1;
  const PlanRequest request{character, random, frames};
  const SceneMotion drawn = exact != nullptr
                                ? SceneMotion{solve_plan(character, exact->plan(request), kSynthFps), {}}
                            : sketched != nullptr ? SceneMotion{sketched->draw(request), {}}
                                                  : on_scene->make(request);

  const double yaw = place.uniform(-std::numbers::pi, std::numbers::pi);
  const Quaterniond heading = rotation_z(yaw);
  const double x = place.uniform(-1.0, 1.0), y = place.uniform(-1.0, 1.0);
  const Vector3d origin(x, y, 0.0);
  PerFrame<Vector3d> p_root;
  PerFrame<PerBody<Quaterniond>> q;
  for (const SynthPose& pose : drawn.poses) {
    p_root.push_back(origin + heading * pose.p_root);
    q.push_back(pose.q);
    q.back()[kPelvis] = heading * pose.q[kPelvis];
  }
  motion::Clip clip = motion::to_clip(name_of(config), kSynthFps, character, p_root, q);
  for (Plate plate : drawn.scene.plates) {
    const Vector3d centre = origin + heading * Vector3d(plate.centre.x(), plate.centre.y(), 0.0);
    plate.centre = centre.head<2>();
    plate.yaw += yaw;
    clip.scene.plates.push_back(plate);
  }
  return clip;
}

}  // namespace mimicx::synth
