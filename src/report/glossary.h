/// The words that a report has for the names in a run's files: what a number is, its unit, what it means.
///
/// A name without an entry here is shown as it is, its underscores as blanks. The tests fail for a metric, a
/// value or a column of this program that has none.
#pragma once

#include <string>

namespace mimicx::report {

struct Words {
  std::string words;
  std::string unit;     ///< empty: a count or a ratio
  std::string meaning;  ///< a sentence; may be empty where the words say it all
};

/// Of a metric of docs/metrics.md or "max_distance_mm"; the meaning is its definition.
Words words_of_metric(const std::string& name);

/// Of a value in a group of the manifest: "fit", "preparation", "feasibility", "plan", "policy", "audit".
Words words_of_value(const std::string& group, const std::string& name);
/// Of the group itself: "keypoint fit".
std::string words_of_group(const std::string& group);

/// Of a chart of the training log (a column's name, or what stands before its colon).
Words words_of_log(const std::string& title);
/// Of one of its lines (what stands behind the colon), and of the reward's factors.
std::string words_of_line(const std::string& name);

/// What made a motion, and how that ended.
std::string words_of_method(const std::string& method);

/// Whether the name has an entry of its own.
bool has_words(const std::string& group, const std::string& name);

}  // namespace mimicx::report
