// Runs the NumPy example of docs/exported_policies.md on the archive.
#include "policy_export/numpy_arrays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/file.h"
#include "core/shell.h"
#include "core/temporary_folder.h"
#include "policy_export/small_policy.h"

namespace mimicx::policy_export {
namespace {

constexpr const char* kPython = "/usr/bin/python3";  // Debian's, which has Debian's NumPy

/// The indented lines behind the one that names the file.
std::string example() {
  const std::string page = read_file(std::filesystem::path(MIMICX_SOURCE_DIR) / "docs/exported_policies.md");
  std::size_t at = page.find("    import numpy as np\n");
  std::string code;
  while (at != std::string::npos && (page.compare(at, 4, "    ") == 0 || page[at] == '\n')) {
    const std::size_t end = page.find('\n', at);
    code += page[at] == '\n' ? "\n" : page.substr(at + 4, end + 1 - at - 4);
    at = end + 1;
  }
  return code;
}

/// Actions are small: some are beyond this bound, rad.
constexpr float kSmallBound = 0.005F;
ExportedPolicy bounded_policy() {
  files::StoredPolicy policy = small_policy();
  policy.actions.max_action = static_cast<double>(kSmallBound);
  return export_policy(policy, false);
}

TEST(PolicyArrays, RunAsTheDocumentationSays) {
  if (shell(std::string(kPython) + " -c 'import numpy' 2>&1").status != 0) GTEST_SKIP() << "no NumPy";
  const ExportedPolicy bounded = bounded_policy();
  for (const ExportedPolicy* exported : {&exported_in_float(), &exported_in_8_bits(), &bounded}) {
    const TemporaryFolder folder;
    write_npz(folder.path / "walk.npz", to_arrays(*exported));
    write_file_atomically(folder.path / "example.py", example());
    const Call call = shell("cd " + folder.path.string() + " && " + kPython + " example.py 2>&1");
    EXPECT_EQ(call.status, 0) << call.text;
    EXPECT_LT(std::stod(call.text), 1e-5) << call.text;
    EXPECT_GT(std::stod(call.text), 0.0) << "it should have computed something: " << call.text;
  }
}

TEST(PolicyArrays, RecordedActionsKeepTheBoundOfThePolicy) {
  const ExportedPolicy bounded = bounded_policy();
  const std::vector<double> actions = to_arrays(bounded).at("test_actions").to_double();
  double largest = 0.0;
  for (std::size_t k = 0; k < actions.size(); ++k) {
    const float computed = bounded.records[k / kActionCount].action[k % kActionCount];
    EXPECT_EQ(actions[k], static_cast<double>(std::clamp(computed, -kSmallBound, kSmallBound)));
    largest = std::max(largest, std::abs(actions[k]));
  }
  EXPECT_EQ(largest, static_cast<double>(kSmallBound));
}

TEST(PolicyArrays, HoldTheMotionTheBodyAndTheRecords) {
  const Npz npz = to_arrays(exported_in_8_bits());
  EXPECT_EQ(npz.at("state_q").shape, (std::vector<std::size_t>{33, 91}));
  EXPECT_EQ(npz.at("weight0").shape, (std::vector<std::size_t>{570, 32}));
  EXPECT_EQ(npz.at("joint_names").text[kLeftKnee], "left_knee");
  EXPECT_EQ(npz.at("test_observations").shape, (std::vector<std::size_t>{4, 570}));
  EXPECT_EQ(npz.at("test_targets").shape, (std::vector<std::size_t>{4, 22, 4}));
  EXPECT_EQ(number_at(npz, "physics_rate"), 240.0);
  EXPECT_EQ(number_at(npz, "max_action"), static_cast<float>(rl::tracking::ActionSettings{}.max_action));
}

}  // namespace
}  // namespace mimicx::policy_export
