/// `mimicx`: one binary, a subcommand per task (commands.h).

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include "arguments.h"
#include "commands.h"
#include "core/bits.h"
#include "interrupts.h"
#include "record/commit.h"
#include "record/outputs.h"
#include "standard_streams.h"

namespace mimicx::tools {
namespace {

int run(int argc, char** argv) {
  CommandLine line(
      "mimicx", "Physically plausible human motion from noisy motion.",
      "mimicx adapt clip.bvh            # clip.clean.bvh beside it, after seconds\n"
      "mimicx adapt DIR --out out/run   # every motion in a folder; a report, forces and scores",
      std::string("mimicx ") + MIMICX_VERSION + " (" + record::commit() + "), built for " + MIMICX_TARGET +
          ", arithmetic " + kArithmetic,
      "Exit status: 0 success, 1 some inputs failed (the others are done), 2 wrong usage, 130 interrupted.");
  for (const auto declare :
       {declare_run,     declare_plan,    declare_pretrain,    declare_teach,         declare_adapt,
        declare_imitate, declare_merge,   declare_evaluate,    declare_cluster,       declare_fit,
        declare_info,    declare_convert, declare_render,      declare_corrupt,       declare_audit,
        declare_certify, declare_report,  declare_export_mjcf, declare_export_policy, declare_synth,
        declare_scene,   declare_config})
    declare(line);
  return line.run(argc, argv);
}

/// Whether everything that was printed was written.
bool is_told() {
  std::cout.flush();
  return std::cout.good() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

}  // namespace
}  // namespace mimicx::tools

int main(int argc, char** argv) {
  mimicx::tools::occupy_standard_streams();
  const mimicx::tools::ShownControls messages(std::cerr);
  mimicx::tools::handle_signals();
  try {
    const int status = mimicx::tools::run(argc, argv);
    if (mimicx::tools::is_told()) return status;
    std::cerr << "mimicx: standard output cannot be written to\n";
    return std::max(status, mimicx::tools::kSomeFailed);
  } catch (const mimicx::tools::UsageError& error) {
    std::cerr << "mimicx: " << error.what() << '\n';
    return mimicx::tools::kWrongUsage;
  } catch (const mimicx::record::OutputRefused& error) {
    std::cerr << "mimicx: " << error.what() << '\n';
    return mimicx::tools::kWrongUsage;
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << "mimicx: " << error.path1().string() << ": " << error.code().message() << '\n';
    return mimicx::tools::kSomeFailed;
  } catch (const std::bad_alloc&) {
    std::cerr << "mimicx: not enough memory\n";
    return mimicx::tools::kSomeFailed;
  } catch (const std::exception& error) {
    std::cerr << "mimicx: " << error.what() << '\n';
    return mimicx::tools::kSomeFailed;
  }
}
