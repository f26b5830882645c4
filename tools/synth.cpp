#include <filesystem>
#include <iostream>
#include <memory>

#include "commands.h"
#include "motion/synth.h"

namespace mimicx {

void add_synth(CLI::App& app, Run& run) {
  auto* command =
      app.add_subcommand("synth", "Write the synthetic motions: truth/ and noisy/, a file per kind");
  const auto out = std::make_shared<std::string>();
  command->add_option("--out", *out, "folder to write to")->required();
  command->callback([&run, out] {
    run = [out] {
      write_synthetic_set(*out);
      std::cout << *out << ": " << synthetic_kinds().size()
                << " motions, each as truth and as a noisy estimate\n";
      return kAllGood;
    };
  });
}

}  // namespace mimicx
