// The header for its users: compiled as C++17 without any other file of this project.
#include "policy_export/cpp_header.h"

#include <gtest/gtest.h>

#include "core/file.h"
#include "core/shell.h"
#include "core/temporary_folder.h"
#include "policy_export/small_policy.h"

namespace mimicx::policy_export {
namespace {

constexpr const char* kEmbedded =
    " -std=c++17 -O1 -ffp-contract=off -fno-exceptions -fno-rtti -Wall -Wextra -Wconversion -Wshadow "
    "-Werror ";

/// Compiles one file in a folder of its own and calls it. @return its status and output
Call compiled(const TemporaryFolder& folder, const std::string& source) {
  write_file_atomically(folder.path / "main.cpp", source);
  const std::string at = folder.path.string();
  return shell(std::string(MIMICX_COMPILER) + kEmbedded + at + "/main.cpp -o " + at + "/main 2>&1 && " + at +
               "/main");
}

TEST(PolicyHeader, MatchesItsRecordsBitForBit) {
  for (const ExportedPolicy* exported : {&exported_in_float(), &exported_in_8_bits()}) {
    const TemporaryFolder folder;
    write_file_atomically(folder.path / "policy.h", to_header(*exported));
    const Call call = compiled(
        folder,
        "#include \"policy.h\"\nint main() { return policy_a_squat::self_test() == 0.0F ? 0 : 1; }\n");
    EXPECT_EQ(call.status, 0) << call.text;
  }
}

TEST(PolicyHeader, DetectsAWrongWeight) {
  const TemporaryFolder folder;
  std::string text = to_header(exported_in_8_bits());
  const std::size_t at = text.find("kBiases2[55] = {");
  ASSERT_NE(at, std::string::npos);
  text.insert(text.find('\n', at) + 1, " 0.1F +");
  write_file_atomically(folder.path / "policy.h", text);
  const Call call = compiled(
      folder, "#include \"policy.h\"\nint main() { return policy_a_squat::self_test() > 0.05F ? 0 : 1; }\n");
  EXPECT_EQ(call.status, 0) << call.text;
}

TEST(PolicyHeader, CanBeIncludedBesideAnotherAndInSeveralFiles) {
  const TemporaryFolder folder;
  ExportedPolicy other = exported_in_8_bits();
  other.meant.motion.name = "7/\"other\" one";
  write_file_atomically(folder.path / "one.h", to_header(exported_in_float()));
  write_file_atomically(folder.path / "two.h", to_header(other));
  write_file_atomically(folder.path / "more.cpp",
                        "#include \"two.h\"\nfloat more() { return policy_7_other_one::self_test(); }\n");
  const Call call = compiled(folder,
                             "#include \"one.h\"\n#include \"two.h\"\n#include \"more.cpp\"\n"
                             "int main() { return policy_a_squat::self_test() + more() == 0.0F ? 0 : 1; }\n");
  EXPECT_EQ(call.status, 0) << call.text;
}

TEST(PolicyHeader, NamespacesAreValidInCpp) {
  EXPECT_EQ(namespace_of("walk_1"), "policy_walk_1");
  EXPECT_EQ(namespace_of("sub/Walk (2)"), "policy_sub_Walk_2_");
  EXPECT_EQ(namespace_of("__x"), "policy_x");
}

TEST(PolicyHeader, HoldsGainsTorquesAndRangesOfTheBody) {
  const std::string text = to_header(exported_in_float());
  for (const char* part : {"kJointName", "\"left_knee\"", "kTorqueLimit", "kRangeHalfAxes", "kStiffness",
                           "kPhysicsRate = 240.0"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  EXPECT_TRUE(text.starts_with(kHeaderOpening));
}

}  // namespace
}  // namespace mimicx::policy_export
