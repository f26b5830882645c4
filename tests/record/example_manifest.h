/// A manifest that has one of everything.
#pragma once

#include <cmath>

#include "record/manifest.h"

namespace mimicx::record {

inline Manifest example_manifest() {
  Manifest m;
  m.version = "0.1.0";
  m.target = "x86-64-v3";
  m.seed = 18446744073709551615u;
  m.samples = 4000000;
  m.settings = {{"gamma", 0.97}, {"sigma", 0.07}};
  SequenceEntry e;
  e.name = "walk";
  e.input = "clips/walk \"slow\".npz";
  e.input_checksum = "00ff";
  e.output = "motions/walk.npz";
  e.ok = true;
  e.ending = SequenceEnding::kBudget;
  e.frames = 150;
  e.fps = 30.0;
  e.seed = m.seed;
  e.samples = 4000000;
  e.reward_before = 0.1 + 0.2;
  e.reward_after = 0.9;
  e.metrics = {{"MPJPE", 17.3}, {"Float_gt", std::nan("")}};
  e.audit = {{"root_force_max_N", 12.25}};
  e.preparation = {{"floor_shift_mm", -12.5}};
  e.feasibility = {{"infeasible_share", 0.25}};
  e.parts = {{0, 60}, {90, 149}};
  e.worse = {{"sliding", "0.4 -> 0.9 mm a frame", {{31, 40}, {77, 77}}, "its reference slides, too"}};
  e.notes = {"a note"};
  m.put(e);
  return m;
}

}  // namespace mimicx::record
