/// The measures that a run tells on the terminal: visible faults, each by its metric of docs/metrics.md.
#pragma once

#include "core/containers.h"
#include "motion/metrics.h"

namespace mimicx::judge {

struct Headline {
  const char* name;    ///< for people
  const char* metric;  ///< of motion::metric_definitions
  motion::MetricValue motion::Metrics::*value;
  const char* unit;
  double scale;      ///< from the metric's unit to that one
  int decimals;      ///< that are printed
  double visible;    ///< smaller values, in that unit, are not mentioned
  bool always;       ///< printed also where it became better
  const char* verb;  ///< for a motion with this fault: "slides"
};

inline constexpr Array<Headline, 5> kHeadlines = {
    {{{"sliding", "slip", &motion::Metrics::slip, "mm a frame", 1.0, 1, 0.05, true, "slides"},
      {"moving of standing feet", "FS_gt", &motion::Metrics::fs_gt, "mm a frame", 1.0, 1, 0.05, false,
       "moves them"},
      {"sinking", "GP", &motion::Metrics::gp, "mm", 1.0, 1, 0.05, true, "sinks"},
      {"floating", "Float_gt", &motion::Metrics::float_gt, "mm", 1.0, 1, 0.05, true, "floats"},
      {"jitter", "Jitter", &motion::Metrics::jitter, "m/s^3", 10.0, 0, 5.0, true, "shakes"}}}};

}  // namespace mimicx::judge
