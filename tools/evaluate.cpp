#include "pipeline/evaluate.h"

#include <algorithm>
#include <iostream>
#include <memory>

#include "commands.h"
#include "core/npz.h"

namespace mimicx {
namespace {

struct EvaluateOptions {
  std::string truth, motions, json;
};

int run_evaluate(const EvaluateOptions& options) {
  const Evaluation evaluation = evaluate_folders(options.truth, options.motions);
  std::cout << format_evaluation(evaluation);
  for (const auto& name : evaluation.unmatched) std::cerr << "no motion for the truth " << name << '\n';
  if (!options.json.empty()) write_file_atomically(options.json, evaluation_json(evaluation));
  const auto& motions = evaluation.motions;
  return std::all_of(motions.begin(), motions.end(), [](const auto& m) { return m.ok; }) ? kAllGood
                                                                                         : kSomeFailed;
}

}  // namespace

void add_evaluate(CLI::App& app, Run& run) {
  auto* command = app.add_subcommand("evaluate", "Score motions against their truth, pairing files by name");
  const auto options = std::make_shared<EvaluateOptions>();
  command->add_option("--truth", options->truth, "folder of true motions")->required();
  command->add_option("--motions", options->motions, "folder of motions to score")->required();
  command->add_option("--json", options->json, "also write every value, its count and its definition here");
  command->callback([&run, options] { run = [options] { return run_evaluate(*options); }; });
}

}  // namespace mimicx
