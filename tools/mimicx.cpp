/// `mimicx`: one binary, a subcommand per task.

#include <exception>
#include <iostream>

#include "commands.h"

int main(int argc, char** argv) {
  using namespace mimicx;
  CLI::App app("Physically plausible human motion from noisy motion.");
  app.name("mimicx");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("mimicx ") + MIMICX_VERSION + ", built for " + MIMICX_TARGET);
  app.footer("Exit status: 0 all good, 1 some inputs failed (the rest is done), 2 wrong usage.");
  Run run;
  add_imitate(app, run);
  add_evaluate(app, run);
  add_info(app, run);
  add_convert(app, run);
  add_synth(app, run);
  try {
    app.parse(argc, argv);
    return run();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kAllGood : kWrongUsage;  // --help and --version end here as well
  } catch (const UsageError& error) {
    std::cerr << "mimicx: " << error.what() << '\n';
    return kWrongUsage;
  } catch (const std::exception& error) {
    std::cerr << "mimicx: " << error.what() << '\n';
    return kSomeFailed;
  }
}
