#include "judge/evaluate.h"

#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>
#include <stdexcept>

#include "commands.h"
#include "core/npz/npz.h"
#include "judge/evaluate_protocol.h"
#include "judge/forces/force_comparison.h"
#include "record/outputs.h"
#include "shared_arguments.h"
#include "standard_streams.h"

namespace mimicx::tools {
namespace {

struct EvaluateArguments {
  std::filesystem::path truth, forces, json;
  std::vector<std::string> motions;
  std::string protocol;  ///< empty: our own metrics
  import::ReadConfig read;
  bool force = false;
};

/// The motions of the given files and folders. @throws DataError if one of these holds none
std::vector<std::string> files_to_read(const EvaluateArguments& a) {
  std::vector<std::string> files, named = a.motions;
  if (!a.truth.empty()) named.push_back(a.truth.string());
  if (!a.forces.empty()) files.push_back(a.forces.string());
  for (const std::string& path : named)
    for (const auto& [name, file] : judge::named_motions(path)) files.push_back(file.string());
  return files;
}

int evaluate_published(const EvaluateArguments& a) {
  const auto& names = motion::protocol_names();
  const auto protocol =
      static_cast<motion::Protocol>(std::find(names.begin(), names.end(), a.protocol) - names.begin());
  std::vector<judge::ProtocolTable> tables;
  bool all_good = true;
  for (const std::string& folder : a.motions) {
    tables.push_back(judge::evaluate_protocol(protocol, a.truth, folder, a.read));
    for (const judge::ProtocolRow& row : tables.back().rows) {
      if (row.reason.empty()) continue;
      std::cerr << folder << '/' << row.name << ": left out: " << row.reason << '\n';
      all_good = false;
    }
  }
  table_stream(a.json) << judge::format_protocol(tables);
  if (!a.json.empty()) write_json(a.json, judge::protocol_json(tables));
  return all_good ? kAllGood : kSomeFailed;
}

int evaluate_against_plates(const EvaluateArguments& a) {
  if (a.motions.size() > 1)
    throw std::invalid_argument("--forces compares one folder of --motions, or one file");
  const auto rows = judge::evaluate_forces(a.forces, a.motions.front(),
                                           a.read.mass.value_or(std::numeric_limits<double>::quiet_NaN()));
  table_stream(a.json) << judge::format_forces(rows);
  if (!a.json.empty()) write_json(a.json, judge::forces_json(rows));
  return std::all_of(rows.begin(), rows.end(), [](const auto& row) { return row.reason.empty(); })
             ? kAllGood
             : kSomeFailed;
}

int evaluate(const EvaluateArguments& a) {
  if (a.truth.empty() == a.forces.empty())
    throw std::invalid_argument("evaluate needs --truth, or else --forces");
  if (!is_standard_output(a.json))
    record::Outputs(files_to_read(a), a.force).claim(a.json, record::kJsonOpening);
  if (!a.forces.empty()) return evaluate_against_plates(a);
  if (!a.protocol.empty()) return evaluate_published(a);
  if (a.motions.size() > 1) {
    const judge::Comparison comparison = judge::compare_folders(a.truth, a.motions, a.read);
    table_stream(a.json) << judge::format_comparison(comparison);
    for (const std::string& failure : comparison.failures) std::cerr << failure << '\n';
    const bool none = comparison.evaluations.front().motions.empty();
    if (none) std::cerr << "no motion is in all of these folders and in " << a.truth.string() << '\n';
    if (!a.json.empty()) write_json(a.json, judge::comparison_json(comparison));
    return none || !comparison.failures.empty() ? kSomeFailed : kAllGood;
  }
  const judge::Evaluation evaluation = judge::evaluate_folders(a.truth, a.motions.front(), a.read);
  table_stream(a.json) << judge::format_evaluation(evaluation);
  for (const auto& name : evaluation.unmatched) std::cerr << "no motion for the truth " << name << '\n';
  if (!a.json.empty()) write_json(a.json, judge::evaluation_json(evaluation));
  const auto& scored = evaluation.motions;
  return std::all_of(scored.begin(), scored.end(), [](const auto& m) { return m.ok; }) ? kAllGood
                                                                                       : kSomeFailed;
}

}  // namespace

void declare_evaluate(CommandLine& line) {
  const auto a = std::make_shared<EvaluateArguments>();
  Command command =
      line.add("evaluate", "Score motions against their truth, pairing files by name",
               "mimicx evaluate --truth truth --motions out/run/motions         # a row per motion\n"
               "mimicx evaluate --truth truth --motions noisy out/run/motions   # means, side by side\n"
               "mimicx evaluate --forces plates.mot --motions out/run/motions/walk.npz");
  const Option truth = command.path("--truth", a->truth, "true motions: a folder, or one file");
  command
      .path("--forces", a->forces,
            "instead, forces that plates have measured, to compare the motions' forces with: .mot or .npz, "
            "or a "
            "folder of them, docs/forces.md; --mass is the mass of the person on the plates")
      .excludes(truth);
  command
      .paths("--motions", a->motions,
             "motions to score: a folder, or one file; several are compared by means over the motions that "
             "that "
             "all of them have")
      .required();
  command
      .one_of("--protocol", a->protocol, motion::protocol_names(),
              "use the metrics of a published protocol instead, docs/metrics.md")
      .needs(truth);
  command.path("--json", a->json,
               "also write every value, its count and its definition as JSON; -: to standard output");
  add_read_arguments(command, a->read);
  add_force(command, a->force);
  command.action([a] { return evaluate(*a); });
}

}  // namespace mimicx::tools
