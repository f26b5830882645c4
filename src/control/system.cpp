#include "control/system.h"

#include <cmath>
#include <stdexcept>

#include "core/error.h"

namespace mimicx::control {

namespace {

Array<LegSphere, kLegSpheres> leg_spheres(const Character& character) {
  Array<LegSphere, kLegSpheres> spheres;
  for (int k = 0; k < kFootPoints; ++k) {
    const ContactPoint& point = character.contact_points[k];
    spheres[k] = {point.body, point.p_B, point.radius};
  }
  int next = kFootPoints;
  for (const int knee : {kLeftKnee, kRightKnee}) {
    const Capsule& shin = character.capsule[knee];
    for (int k = 0; k < kShinSpheres; ++k)
      spheres[next++] = {knee, shin.a_B + k / (kShinSpheres - 1.0) * (shin.b_B - shin.a_B), shin.radius};
  }
  return spheres;
}

}  // namespace

System make_system(const Character& character, const SimulationConfig& config, List<State<double>> reference,
                   double fps, const Scene& scene) {
  if (reference.size() < 2) raise(std::invalid_argument("a reference needs at least 2 frames"));
  const double substeps = config.rate / fps;
  if (!(substeps >= 1.0) || std::abs(substeps - std::round(substeps)) > 1e-9)
    raise(std::invalid_argument("the physics rate must be a multiple of the reference's frame rate"));
  System system;
  system.model = make_model<float>(character, config, scene);
  system.exact_model = make_model<double>(character, config, scene);
  for (int k = 0; k < kFootPoints; ++k) {
    const ContactPoint& point = character.contact_points[k];
    system.sole[k] = {point.body, sole_point(point)};
  }
  system.legs = leg_spheres(character);
  system.scene = scene;
  system.mass = character.total_mass();
  system.fps = fps;
  system.substeps = static_cast<int>(std::lround(substeps));
  system.reference = std::move(reference);
  return system;
}

State<double> as_floats(const State<double>& x) { return lane_of(in_all_lanes<P>(x), 0); }

Target<P> target_of(const System& system, int frame, const Control& u) {
  Target<P> out{};
  set_target(
      system, frame, [&](int dof) { return u[dof]; }, 0, out);
  return in_all_lanes<P>(lane_of(out, 0));
}

Wrench<P> assistance_of(const System& system, const Control& u) {
  Wrench<P> out;
  const auto entry = [&](int k) { return u[kDofs + k]; };
  for (int lane = 0; lane < kLanes; ++lane) set_assistance(system, entry, lane, out);
  return out;
}

MaskOf<P> advance(const System& system, const Target<P>& from, const Target<P>& to,
                  const Wrench<P>& assistance, State<P>& x, Data<P>& scratch) {
  return advance_interval<P>(
      system.model, {from, to, system.substeps, system.assisted ? &assistance : nullptr}, x, scratch);
}

}  // namespace mimicx::control
