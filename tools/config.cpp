#include <iostream>
#include <memory>

#include "arguments.h"
#include "commands.h"
#include "program/configurations.h"

namespace mimicx::tools {

void declare_config(CommandLine& line) {
  const auto json = std::make_shared<bool>(false);
  Command command = line.add(
      "config", "List the settings of trainings, plans and the fit, by their names in manifests and --set",
      "mimicx config          # a table\n"
      "mimicx config --json   # the same for programs");
  command.flag("--json", *json, "print JSON instead of a table");
  command.action([json] {
    std::cout << (*json ? program::configurations_json() : program::format_configurations());
    return kAllGood;
  });
}

}  // namespace mimicx::tools
