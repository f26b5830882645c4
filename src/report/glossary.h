/// Words of the report for the names in a run's files: title, unit and meaning of every number.
///
/// A name without an entry is shown with blanks for its underscores. The tests fail if a metric, a value or a
/// column of this program has no entry.
#pragma once

#include <string>

namespace mimicx::report {

struct Words {
  std::string words;
  std::string unit;     ///< empty: a count or a ratio
  std::string meaning;  ///< a sentence; may be empty
};

/// For a metric of docs/metrics.md or "max_distance_mm"; the meaning is its definition.
Words words_of_metric(const std::string& name);

/// For a value in a group of the manifest: "fit", "preparation", "feasibility", "plan", "policy", "audit".
Words words_of_value(const std::string& group, const std::string& name);
/// For the group itself: "keypoint fit".
std::string words_of_group(const std::string& group);

/// For a chart of the training log (a column's name up to its colon).
Words words_of_log(const std::string& title);
/// For one of its lines (the name after the colon), and for the reward's factors.
std::string words_of_line(const std::string& name);

/// For the method that made a motion.
std::string words_of_method(const std::string& method);

/// Whether the name has an entry.
bool has_words(const std::string& group, const std::string& name);

}  // namespace mimicx::report
