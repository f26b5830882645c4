#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "commands.h"
#include "pipeline/configurations.h"

namespace mimicx::tools {

void declare_config(CLI::App& app, Action& action) {
  const auto json = std::make_shared<bool>(false);
  auto* command = app.add_subcommand(
      "config", "Every setting of imitate, adapt and pretrain, by the name that manifests and --set use");
  command->add_flag("--json", *json, "print JSON instead of a table");
  command->callback([json, &action] {
    action = [json] {
      std::cout << (*json ? pipeline::configurations_json() : pipeline::format_configurations());
      return kAllGood;
    };
  });
}

}  // namespace mimicx::tools
