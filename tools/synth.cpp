#include "motion/synth.h"

#include <iostream>

#include "commands.h"

namespace mimicx {

int run_synth(const std::filesystem::path& out) {
  write_synthetic_set(out);
  std::cout << out.string() << ": " << synthetic_kinds().size()
            << " motions, each as truth and as a noisy estimate\n";
  return kAllGood;
}

}  // namespace mimicx
