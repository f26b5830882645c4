/// The numbers of the simulation by their names in manifests and files.
#pragma once

#include "physics/model.h"

namespace mimicx::files {

/// Calls add(name, field) for every one of them.
template <class Config, class Add>
void for_each_simulation_setting(Config& s, const Add& add) {
  add("physics_rate", s.rate);
  add("physics_passes", s.passes);
  add("gravity", s.gravity);
  add("ground_stiffness", s.ground_stiffness);
  add("ground_damping", s.ground_damping);
  add("friction", s.friction);
  add("slip_speed", s.slip_speed);
  add("skin", s.skin);
  add("self_contact", s.self_contact);
  add("self_stiffness", s.self_stiffness);
  add("self_damping", s.self_damping);
  add("limit_stiffness", s.limit_stiffness);
  add("limit_damping", s.limit_damping);
  add("max_speed", s.max_speed);
  add("max_joint_speed", s.max_joint_speed);
}

}  // namespace mimicx::files
