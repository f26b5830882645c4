#include "judge/evaluate.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "command_line_numbers.h"
#include "commands.h"
#include "core/npz/npz.h"
#include "judge/evaluate_protocol.h"
#include "judge/forces/force_comparison.h"
#include "record/outputs.h"
#include "record/table.h"
#include "shared_arguments.h"
#include "standard_streams.h"

namespace mimicx::tools {
namespace {

struct EvaluateArguments {
  std::filesystem::path truth, forces, json;
  std::vector<std::string> motions;
  std::string protocol;                 ///< empty: our own metrics
  std::vector<std::string> fail_above;  ///< NAME=VALUE each
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

/// A gate: the mean of a metric must not be above this.
struct Limit {
  const motion::MetricDefinition* metric;
  double most;
};

/// @throws UsageError for a text that is no NAME=VALUE of a metric
std::vector<Limit> limits_of(const std::vector<std::string>& texts) {
  std::vector<Limit> limits;
  for (const std::string& text : texts) {
    const auto equals = std::min(text.find('='), text.size() - 1);
    const std::optional<double> most = number_of(text.substr(equals + 1));
    const motion::MetricDefinition* metric = nullptr;
    std::string names;
    for (const motion::MetricDefinition& d : motion::metric_definitions()) {
      names += (names.empty() ? "" : ", ") + std::string(d.name);
      if (d.name == text.substr(0, equals)) metric = &d;
    }
    if (!most || metric == nullptr)
      throw UsageError("--fail-above: expected NAME=VALUE with a NAME of " + names + ", found '" + text +
                       "'");
    limits.push_back({metric, *most});
  }
  return limits;
}

/// Whether all means are within the limits; those that are not are told. A metric without a value is not.
bool holds(const judge::Evaluation& evaluation, const std::string& folder, const std::vector<Limit>& limits) {
  bool all = true;
  for (const Limit& limit : limits) {
    const double mean = judge::mean_of(evaluation, *limit.metric);
    if (mean <= limit.most) continue;
    std::cerr << folder << ": " << limit.metric->name << ' '
              << (std::isfinite(mean) ? "is " + record::format_number(mean) + ", above "
                                      : "has no value to be within ")
              << record::format_number(limit.most) << '\n';
    all = false;
  }
  return all;
}

void tell_decisions(const judge::Evaluation& evaluation) {
  for (const judge::EvaluatedMotion& motion : evaluation.motions)
    for (const std::string& line : motion.told) std::cerr << line << '\n';
}

void tell_unmatched(const std::vector<std::string>& truths) {
  for (const std::string& name : truths) std::cerr << "no motion for the truth " << name << '\n';
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

/// @throws UsageError for what --forces does not use: simulated motions and measurements have their units and
/// axes
void check_force_arguments(const EvaluateArguments& a) {
  if (a.motions.size() > 1)
    throw UsageError("evaluate: --forces compares one folder of --motions, or one file");
  import::ReadConfig unused = a.read;
  unused.mass.reset();
  if (!unused.text().empty())
    throw UsageError("evaluate: of the options of reading --forces uses --mass alone, found " +
                     unused.text());
}

int evaluate_against_plates(const EvaluateArguments& a) {
  const judge::ForceTable table = judge::evaluate_forces(
      a.forces, a.motions.front(), a.read.mass.value_or(std::numeric_limits<double>::quiet_NaN()));
  for (const judge::ForceRow& row : table.rows)
    for (const std::string& line : row.told) std::cerr << line << '\n';
  table_stream(a.json) << judge::format_forces(table);
  if (!a.json.empty()) write_json(a.json, judge::forces_json(table));
  return std::all_of(table.rows.begin(), table.rows.end(), [](const auto& row) { return row.reason.empty(); })
             ? kAllGood
             : kSomeFailed;
}

int evaluate(const EvaluateArguments& a) {
  if (a.truth.empty() == a.forces.empty()) throw UsageError("evaluate needs --truth, or else --forces");
  if (!a.forces.empty()) check_force_arguments(a);
  if (!is_standard_output(a.json))
    record::Outputs(files_to_read(a), a.force).claim(a.json, record::kJsonOpening);
  if (!a.forces.empty()) return evaluate_against_plates(a);
  if (!a.protocol.empty()) return evaluate_published(a);
  const std::vector<Limit> limits = limits_of(a.fail_above);
  if (a.motions.size() > 1) {
    const judge::Comparison comparison = judge::compare_folders(a.truth, a.motions, a.read);
    for (const judge::Evaluation& evaluation : comparison.evaluations) tell_decisions(evaluation);
    table_stream(a.json) << judge::format_comparison(comparison);
    for (const std::string& failure : comparison.failures) std::cerr << failure << '\n';
    tell_unmatched(comparison.unmatched);
    const bool none = comparison.evaluations.front().motions.empty();
    if (none) std::cerr << "no motion is in all of these folders and in " << a.truth.string() << '\n';
    if (!a.json.empty()) write_json(a.json, judge::comparison_json(comparison));
    const bool within = holds(comparison.evaluations.back(), comparison.labels.back(), limits);
    const bool complete = limits.empty() || comparison.left_out == 0;
    return none || !within || !complete || !comparison.failures.empty() ? kSomeFailed : kAllGood;
  }
  const judge::Evaluation evaluation = judge::evaluate_folders(a.truth, a.motions.front(), a.read);
  tell_decisions(evaluation);
  table_stream(a.json) << judge::format_evaluation(evaluation);
  tell_unmatched(evaluation.unmatched);
  if (!a.json.empty()) write_json(a.json, judge::evaluation_json(evaluation));
  const auto& scored = evaluation.motions;
  const bool within = holds(evaluation, a.motions.front(), limits);
  const bool complete = limits.empty() || evaluation.unmatched.empty();
  return within && complete && std::all_of(scored.begin(), scored.end(), [](const auto& m) { return m.ok; })
             ? kAllGood
             : kSomeFailed;
}

}  // namespace

void declare_evaluate(CommandLine& line) {
  const auto a = std::make_shared<EvaluateArguments>();
  Command command =
      line.add("evaluate", "Score motions against their truth, pairing files by name",
               "mimicx evaluate --truth truth --motions out/run/motions         # a row per motion\n"
               "mimicx evaluate --forces plates.mot --motions out/run/motions/walk.npz");
  const Option truth = command.path("--truth", a->truth, "true motions: a folder, or one file");
  command
      .path("--forces", a->forces,
            "instead, forces that plates have measured, to compare the motions' forces with: .mot or .npz, "
            "or a folder of them; or moments of OpenSim's inverse dynamics, .sto; docs/forces.md. --mass is "
            "the person's mass; the other options of reading do not go with it")
      .excludes(truth);
  command
      .paths("--motions", a->motions,
             "motions to score: a folder, or one file; several are compared by means over the motions that "
             "all of them have")
      .required();
  Option gate = command.texts("--fail-above", a->fail_above, "NAME=VALUE",
                              "exit with status 1 where the mean of this metric is above the value, or "
                              "is missing; of several --motions "
                              "the last one's; also where a truth has no motion; repeatable");
  gate.needs(truth);
  command
      .one_of("--protocol", a->protocol, motion::protocol_names(),
              "use the metrics of a published protocol instead, docs/metrics.md")
      .needs(truth)
      .excludes(gate);
  command.path("--json", a->json,
               "also write every value, its count and its definition as JSON; -: to standard output");
  add_read_arguments(command, a->read);
  add_force(command, a->force);
  command.action([a] { return evaluate(*a); });
}

}  // namespace mimicx::tools
