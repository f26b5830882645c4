/// `report.html`: what a run did, to look at. One file that needs no network: a player of the reference
/// and the simulated motion drawn from the characters' capsules, the metrics, and the training curves.
///
/// The page itself (HTML, CSS, JavaScript) stands in src/pipeline/report/ and is embedded at build time.
/// Motions are embedded as the capsules' ends in whole millimetres (int16, base64): 352 bytes a frame, and a
/// page that needs no rotations. It does not compute anything: numbers arrive as they are to be shown.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "character/character.h"
#include "pipeline/record/table.h"

namespace mimicx::pipeline::report {

/// A row of the metrics table: one value per column.
struct ReportMetric {
  std::string name;            ///< with its unit
  std::vector<double> values;  ///< NaN: shown as a dash
};

/// A curve over the clip's own time.
struct ReportSeries {
  std::string title;
  double step = 0.0;  ///< seconds between values; the first is at 0
  std::vector<double> values;
};

/// What the reference asks for that no body has, a value per frame.
struct ReportNeeds {
  std::vector<double> force, acceleration, moment;  ///< N, m/s², N·m
  std::vector<double> bar;                          ///< height of its bar in the band, in [0, 1]
};

struct ReportSequence {
  std::string name;
  std::string status;  ///< "ok" or "failed"
  std::string reason;  ///< why it failed
  double fps = 30.0;
  Character character;
  std::vector<BodyPoses> reference;  ///< may be empty
  std::vector<BodyPoses> simulated;  ///< may be empty
  std::vector<std::string> metric_columns;
  std::vector<ReportMetric> metrics;
  std::vector<std::string> notes;  ///< one line each
  ReportNeeds needs;               ///< from outside, by the poses; may be empty
  std::vector<std::string> wrong;  ///< with each of these frames, in a word
  ReportNeeds help;                ///< left in a plan's soft stage; may be empty, and shorter than the motion
  std::vector<ReportSeries> series;
  /// A column per quantity, a row per iteration, with a column "samples". Columns named "title:part" share
  /// one chart.
  record::Table log;
};

std::string format_report(const std::vector<ReportSequence>& sequences);
/// The same of sequences that are made one by one, so that 10,000 need not be held at once.
std::string format_report(std::size_t count, const std::function<ReportSequence(std::size_t)>& sequence);

/// Ends of every capsule in mm, [frame][body][2][3] little-endian int16, in base64. Exposed for its test.
std::string encode_capsules(const Character& character, const std::vector<BodyPoses>& poses);

}  // namespace mimicx::pipeline::report
