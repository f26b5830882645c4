/// Target: DeepMimic's JSON, read and retargeted.
#include "core/error.h"
#include "fuzz/driver.h"
#include "import/deepmimic.h"
#include "import/retarget/retarget.h"

namespace mimicx::fuzz::deepmimic {

std::vector<std::string> seeds() {
  const std::string quaternion = ", 1, 0, 0, 0", hinge = ", 0.5";
  const std::string leg = quaternion + hinge + quaternion, arm = quaternion + hinge;
  const std::string row =
      "[0.02, 0, 0.9, 0" + quaternion + quaternion + quaternion + leg + arm + leg + arm + "]";
  return {"{\"Loop\": \"wrap\", \"Frames\": [" + row + "]}",
          "{\n\"Loop\": \"none\",\n\"Frames\":\n[\n" + row + ",\n" + row + "\n]\n}\n",
          "{\"Other\": {\"a\": [1, 2.5e-3, \"x\\\"y\", null, true, {}]}, \"Frames\": [" + row + "," + row +
              "," + row + "]}"};
}

void feed(const std::string& bytes) {
  try {
    import::retarget(import::parse_deepmimic(bytes, "fuzz.txt"));
  } catch (const DataError&) {
  }
}

const Target target("deepmimic", seeds, feed);

}  // namespace mimicx::fuzz::deepmimic
