/// The plots and the timeline bars of a clip.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "audit/audit_result.h"
#include "audit/load_sharing/load_sharing.h"
#include "audit/pose_needs.h"
#include "core/npz/npz.h"
#include "report/report.h"

namespace mimicx::report {

/// The data to draw; null or empty where a run has none.
struct ChartSources {
  std::vector<std::pair<Who, const MeasuredMotion*>> motions;  ///< at one frame rate
  const audit::PoseNeeds* needs_of_input = nullptr;            ///< by its poses alone
  const audit::Audit* audit_of_cleaned = nullptr;              ///< by its recorded forces
  const std::vector<files::FloorArrows>* ground = nullptr;
  const std::vector<audit::LoadSharing>* sharing = nullptr;  ///< a row per row of `ground`
  double weight = 0.0;                                       ///< N
  const Npz* members = nullptr;  ///< of the cleaned motion: reward and its factors
};

/// Whose motion, in words.
std::string title_of(Who who);

/// Over the clip's time.
std::vector<ReportChart> charts_of(const ChartSources& sources);

/// A chart per column of a training log, over its samples; columns "title:part" share one.
std::vector<ReportChart> training_charts(const record::Table& log);

/// Share of the visits of a frame in training that ended in a fall. @param falls  training/NAME.falls.csv
ReportChart falls_chart(const record::Table& falls, double fps);

/// Frames in which the input sinks, floats, slides and shakes, and in which the feet of the cleaned motion
/// are in contact: pushed by the floor, or, without recorded forces, touching it. @param input  null: no
/// flaws
std::vector<ReportBars> bars_of(const MeasuredMotion* input, const MeasuredMotion& cleaned,
                                const std::vector<files::FloorArrows>& ground, double weight);

}  // namespace mimicx::report
