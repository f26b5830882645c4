#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "commands.h"
#include "core/number_text.h"
#include "import/motion_file.h"
#include "motion/clip_file.h"
#include "pipeline/options/option_set.h"
#include "policy_export/policy_export_file.h"
#include "record/outputs.h"
#include "record/run_folder.h"
#include "shared_arguments.h"
#include "shipped_options.h"

namespace mimicx::tools {
namespace {

namespace fs = std::filesystem;

struct ExportPolicyArguments {
  std::vector<std::string> policies;
  fs::path out, body;
  bool in_8_bits = false, force = false;
};

std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i) text += (i > 0 ? ", " : "") + names[i];
  if (names.size() > kShown) text += ", and " + std::to_string(names.size() - kShown) + " more";
  return text;
}

/// The message for a policy that does not exist.
std::string what_is_missing(const fs::path& run, const std::string& name) {
  const std::string asked = run.string() + " has no policy " + name;
  if (fs::exists(options_named(run) / "options.npz"))
    return asked + ": it has options, which follow many motions: " + (run / "option0").string() +
           " is the first; `mimicx adapt --policy --options " + run.string() +
           "` makes policies of single motions";
  if (!fs::is_directory(run)) return run.string() + " is no folder: expected a policy as RUN/NAME";
  if (const auto names = record::archive_names(run / "policies"); !names.empty())
    return asked + ": it has " + some_of(names);
  if (fs::exists(run / "manifest.json"))
    return asked + ": it has no policies; `mimicx adapt --policy` teaches them";
  return asked + ": it is no folder of `mimicx adapt --out`";
}

/// RUN/policies/NAME.npz for RUN/NAME, where NAME may have folders; or that file itself; or, for another file
/// that a run has of a motion, such as RUN/motions/NAME.npz, the policy of that motion.
fs::path find_policy(const fs::path& asked) {
  if (asked.extension() == ".npz" && fs::is_regular_file(asked)) {
    fs::path below = asked.filename();
    for (fs::path at = asked.parent_path(); at.has_filename();
         below = at.filename() / below, at = at.parent_path()) {
      const fs::path run = at.parent_path();
      if (!fs::exists(run / "manifest.json")) continue;
      if (at.filename() == "policies") break;
      const std::string name = fs::path(below).replace_extension().string();
      const fs::path file = record::RunFolder{run}.policy(name);
      if (fs::is_regular_file(file)) return file;
      throw UsageError(what_is_missing(run, name));
    }
    return asked;
  }
  fs::path name = asked.filename();
  if (name.empty() || !asked.has_parent_path())
    throw UsageError(asked.string() + ": expected a policy as RUN/NAME");
  for (fs::path run = asked.parent_path();; name = run.filename() / name, run = run.parent_path()) {
    const fs::path file = record::RunFolder{run}.policy(name.string());
    if (fs::is_regular_file(file)) return file;
    if (run.filename().empty() || !run.has_parent_path()) break;
  }
  throw UsageError(what_is_missing(asked.parent_path(), asked.filename().string()));
}

/// A set of options, or one of them.
struct AskedOptions {
  fs::path file;              ///< options.npz
  std::optional<int> number;  ///< none: all
};

/// SET, or SET/optionK, of a folder or a file of options or of a set that comes with the program; else none.
std::optional<AskedOptions> find_options(const fs::path& asked) {
  const auto file_of = [](const fs::path& set) -> fs::path {
    const fs::path place = options_named(set);
    if (fs::is_regular_file(place / "options.npz")) return place / "options.npz";
    return place.filename() == "options.npz" && fs::is_regular_file(place) ? place : fs::path();
  };
  if (const fs::path file = file_of(asked); !file.empty()) return AskedOptions{file, std::nullopt};
  const std::string name = asked.filename().string(), option = "option";
  const fs::path set = asked.parent_path(), file = set.empty() ? fs::path() : file_of(set);
  if (file.empty() || !name.starts_with(option)) return std::nullopt;
  const std::optional<double> number = number_from(name.substr(option.size()));
  if (!number || *number != std::floor(*number) || *number < 0.0 || *number > 1e6) return std::nullopt;
  return AskedOptions{file, static_cast<int>(*number)};
}

/// @throws DataError for options that no header can hold
void export_options(const AskedOptions& asked, const Character& body,
                    std::vector<policy_export::ExportedPolicy>& exported) {
  const auto set = pipeline::options::read_options(asked.file);
  const std::string file = asked.file.string();
  const auto expected = policy_export::exported_actions(set->actions.max_action);
  if (set->actions != expected)
    throw DataError(file, "", "policies trained with " + pipeline::options::actions_in_words(expected),
                    pipeline::options::actions_in_words(set->actions));
  const int count = set->options.count();
  if (asked.number && *asked.number >= count)
    throw UsageError(file + " has the options 0 to " + std::to_string(count - 1) + ", no option" +
                     std::to_string(*asked.number));
  for (int k = asked.number.value_or(0); k < (asked.number ? *asked.number + 1 : count); ++k) {
    const pipeline::options::Option& option = set->options[k].option;
    try {
      files::StoredPolicy standing =
          policy_export::standing_policy("option" + std::to_string(k), option.agent, body);
      standing.actions = set->actions;
      exported.push_back(policy_export::export_policy(standing, false, option.encoder));
    } catch (const std::invalid_argument& error) {
      throw DataError(file, "option" + std::to_string(k), "an option that can be exported", error.what());
    }
  }
}

int export_policy(const ExportPolicyArguments& a) {
  std::string_view opening;
  try {
    opening = policy_export::opening_of(a.out);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--out: ") + error.what());
  }
  std::vector<std::string> files;
  std::vector<std::optional<AskedOptions>> options;
  for (const std::string& policy : a.policies) {
    options.push_back(find_options(policy));
    files.push_back(options.back() ? options.back()->file.string() : find_policy(policy).string());
  }
  const bool any =
      std::any_of(options.begin(), options.end(), [](const auto& asked) { return asked.has_value(); });
  if (any && a.in_8_bits)
    throw UsageError("--int8: rounding suits the weights to a motion, and options follow many");
  if (!a.body.empty()) {
    if (!any) throw UsageError("--body: a policy of a motion is for the body of that motion");
    files.push_back(a.body.string());
  }
  record::Outputs(files, a.force).claim(a.out, opening);
  const Character body =
      a.body.empty() ? make_character() : motion::character_of(import::read_motion(a.body));
  std::vector<policy_export::ExportedPolicy> exported;
  for (std::size_t i = 0; i < options.size(); ++i) {
    if (options[i]) {
      export_options(*options[i], body, exported);
      continue;
    }
    const files::StoredPolicy policy = files::read_policy(files[i]);
    try {
      exported.push_back(policy_export::export_policy(policy, a.in_8_bits));
    } catch (const std::invalid_argument& error) {
      throw DataError(files[i], "", "a policy that can be exported", error.what());
    }
  }
  std::string bytes;
  try {
    bytes = policy_export::bytes_of(exported, a.out);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("export-policy: ") + error.what());
  }
  make_folder(a.out.parent_path());
  write_file_atomically(a.out, bytes);
  return kAllGood;
}

}  // namespace

void declare_export_policy(CommandLine& line) {
  const auto a = std::make_shared<ExportPolicyArguments>();
  Command command = line.add(
      "export-policy", "Write policies of motions, and options, for other programs",
      "mimicx export-policy RUN/walk RUN/wave --out both.h --int8   # one self-contained C++17 header\n"
      "mimicx export-policy taught/option7 --out walks.h            # an option: for motions of your own");
  command.files(
      "RUN/NAME", a->policies,
      "a run of `mimicx adapt`, and a motion of it that has a policy; or a file of that motion in it; or "
      "SET, a set of options as of `adapt --options`, or SET/optionK, one of it");
  command.path("--out", a->out, "where to write it: .h, .onnx or .npz").required();
  command.flag("--int8", a->in_8_bits, "8-bit weights, and half as many knots of the motion");
  command.path("--body", a->body, "of options: a motion for whose body they are; default: the standard body");
  add_force(command, a->force);
  command.action([a] { return export_policy(*a); });
}

}  // namespace mimicx::tools
