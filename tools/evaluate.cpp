#include "pipeline/evaluate.h"

#include <algorithm>
#include <iostream>

#include "commands.h"
#include "core/npz.h"

namespace mimicx {

int run_evaluate(const std::filesystem::path& truth, const std::vector<std::string>& motions,
                 const std::filesystem::path& json) {
  if (motions.size() > 1) {
    const Comparison comparison = compare_folders(truth, motions);
    std::cout << format_comparison(comparison);
    for (const std::string& failure : comparison.failures) std::cerr << failure << '\n';
    const bool none = comparison.evaluations.front().motions.empty();
    if (none) std::cerr << "no motion is in all of these folders and in " << truth.string() << '\n';
    if (!json.empty()) write_file_atomically(json, comparison_json(comparison));
    return none || !comparison.failures.empty() ? kSomeFailed : kAllGood;
  }
  const Evaluation evaluation = evaluate_folders(truth, motions.front());
  std::cout << format_evaluation(evaluation);
  for (const auto& name : evaluation.unmatched) std::cerr << "no motion for the truth " << name << '\n';
  if (!json.empty()) write_file_atomically(json, evaluation_json(evaluation));
  const auto& scored = evaluation.motions;
  return std::all_of(scored.begin(), scored.end(), [](const auto& m) { return m.ok; }) ? kAllGood
                                                                                       : kSomeFailed;
}

}  // namespace mimicx
