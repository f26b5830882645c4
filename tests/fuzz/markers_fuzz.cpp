// Target: OpenSim's marker files (.trc): read, turned into joints and retargeted.
#include "core/error.h"
#include "fuzz/driver.h"
#include "import/made_markers.h"
#include "import/motion_file.h"
#include "motion/made_motions.h"

namespace mimicx::fuzz::markers {
namespace {

/// The file with markers of other names, which the reader does not know.
std::string without(std::string text, const std::string& name) {
  for (std::size_t at; (at = text.find(name)) != std::string::npos;) text[at] = 'x';
  return text;
}

}  // namespace

std::vector<std::string> seeds() {
  const std::string whole = test::format_trc(test::markers_of(test::random_clip(1, 4, 0.3))),
                    metres = test::format_trc(test::markers_of(test::random_clip(2, 3, 0.3)), "m");
  const std::string lateral = without(without(metres, "Knee.Med"), "Ankle.Med"),
                    segments =
                        without(without(test::format_trc(test::markers_of(test::random_clip(3, 6, 0.5, 5.0))),
                                        "Knee"),
                                "Ankle");
  const std::vector<std::string> seeds = {whole, metres, lateral, segments};
  for (const std::string& seed : seeds) import::motion_from(seed, "seed.trc");  // each is read
  return seeds;
}

void feed(const std::string& bytes) {
  try {
    import::motion_from(bytes, "fuzz.trc");
  } catch (const DataError&) {
  }
}

const Target target("markers", seeds, feed);

}  // namespace mimicx::fuzz::markers
