#include <algorithm>
#include <cstdio>
#include <memory>

#include "commands.h"
#include "policy_export/policy_export_file.h"
#include "record/outputs.h"
#include "record/run_folder.h"
#include "shared_arguments.h"

namespace mimicx::tools {
namespace {

namespace fs = std::filesystem;

struct ExportPolicyArguments {
  std::vector<std::string> policies;
  fs::path out;
  bool in_8_bits = false, force = false;
};

/// The names in RUN/policies and its subfolders.
std::vector<std::string> policies_of(const fs::path& run) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(run / "policies", error))
    if (entry.path().extension() == ".npz")
      names.push_back(entry.path().lexically_relative(run / "policies").replace_extension().generic_string());
  std::sort(names.begin(), names.end());
  return names;
}

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
  if (!fs::is_directory(run)) return run.string() + " is no folder: expected a policy as RUN/NAME";
  if (const auto names = policies_of(run); !names.empty()) return asked + ": it has " + some_of(names);
  if (fs::exists(run / "options.npz"))
    return asked + ": it has options, which follow many motions; `mimicx adapt --policy --options " +
           run.string() + "` makes policies of single motions";
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
      if (!fs::exists(run / "manifest.json") || at.filename() == "policies") continue;
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

int export_policy(const ExportPolicyArguments& a) {
  std::string_view opening;
  try {
    opening = policy_export::opening_of(a.out);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--out: ") + error.what());
  }
  std::vector<std::string> files;
  for (const std::string& policy : a.policies) files.push_back(find_policy(policy).string());
  record::Outputs(files, a.force).claim(a.out, opening);
  std::vector<policy_export::ExportedPolicy> exported;
  for (const std::string& file : files) {
    const files::StoredPolicy policy = files::read_policy(file);
    try {
      exported.push_back(policy_export::export_policy(policy, a.in_8_bits));
    } catch (const std::invalid_argument& error) {
      throw DataError(file, "", "a policy that can be exported", error.what());
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
      "export-policy", "Write the policy of a motion for other programs",
      "mimicx export-policy RUN/walk RUN/wave --out both.h --int8   # one self-contained C++17 header\n"
      "mimicx export-policy RUN/walk --out walk.onnx                # or .npz, for Python");
  command.files(
      "RUN/NAME", a->policies,
      "a run of `mimicx adapt`, and a motion of it that has a policy; or a file of that motion in it");
  command.path("--out", a->out, "where to write it: .h, .onnx or .npz").required();
  command.flag("--int8", a->in_8_bits, "8-bit weights, and half as many knots of the motion");
  add_force(command, a->force);
  command.action([a] { return export_policy(*a); });
}

}  // namespace mimicx::tools
