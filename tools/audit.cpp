#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "commands.h"
#include "core/npz.h"
#include "pipeline/audit/audit_file.h"
#include "pipeline/preparation.h"

namespace mimicx::tools {
namespace {

struct Arguments {
  std::vector<std::string> inputs;
  bool poses_alone = false;
  std::string json;
};

int audit(const Arguments& a) {
  std::vector<pipeline::audit::AuditedFile> files;
  bool all_good = true;
  std::cout << pipeline::audit::audit_table_head();
  for (const std::string& path : pipeline::expand_inputs(a.inputs)) {
    try {
      files.push_back({path, pipeline::audit::audit_file(path, a.poses_alone)});
      for (const pipeline::audit::Audit& audit : files.back().audits) {
        std::cout << pipeline::audit::format_audit(path, audit);
        all_good = all_good && audit.failures.empty();
      }
    } catch (const std::exception& error) {
      std::cerr << path << ": left out: " << error.what() << '\n';
      all_good = false;
    }
  }
  if (!a.json.empty()) write_file_atomically(a.json, pipeline::audit::audit_json(files));
  return all_good ? kAllGood : kSomeFailed;
}

}  // namespace

void declare_audit(CLI::App& app, Action& action) {
  const auto a = std::make_shared<Arguments>();
  auto* command = app.add_subcommand("audit", "Do the forces in a file explain the motion in it?");
  command->add_option("FILE", a->inputs, "motions and physics steps (.npz), and folders of them")->required();
  command->add_flag("--poses", a->poses_alone,
                    "look at the poses alone, under the best ground reaction that is physically possible");
  command->add_option("--json", a->json, "also write every row and every value here");
  command->callback([a, &action] { action = [a] { return audit(*a); }; });
}

}  // namespace mimicx::tools
