// The header for its users: compiled as C++17 without any other file of this project.
#include "policy_export/cpp_header.h"

#include <gtest/gtest.h>

#include <sstream>

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

/// A header, its policy called by this name.
std::string header_of(ExportedPolicy policy, const std::string& name) {
  policy.meant.motion.name = name;
  return to_header(policy);
}

TEST(PolicyHeader, MatchesItsRecordsBitForBitBesideOthersAndInSeveralFiles) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path / "one.h", header_of(exported_in_float(), "float"));
  write_file_atomically(folder.path / "two.h", header_of(exported_in_8_bits(), "7/\"other\" one"));
  write_file_atomically(folder.path / "three.h", header_of(exported_option(), "option"));
  write_file_atomically(folder.path / "more.cpp",
                        "#include \"two.h\"\nfloat more() { return policy_7_other_one::self_test(); }\n");
  std::string wrong = header_of(exported_in_8_bits(), "wrong");
  const std::size_t at = wrong.find("kBiases2[55] = {");
  ASSERT_NE(at, std::string::npos);
  wrong.insert(wrong.find('\n', at) + 1, " 0.1F +");
  write_file_atomically(folder.path / "wrong.h", wrong);
  const Call call = compiled(folder,
                             "#include \"one.h\"\n#include \"two.h\"\n#include \"three.h\"\n#include "
                             "\"wrong.h\"\n#include \"more.cpp\"\n"
                             "int main() {\n"
                             "  if (policy_float::self_test() != 0.0F) return 1;\n"
                             "  if (more() != 0.0F) return 2;\n"
                             "  if (policy_option::self_test() != 0.0F) return 3;\n"
                             "  return policy_wrong::self_test() > 0.05F ? 0 : 4;\n"
                             "}\n");
  EXPECT_EQ(call.status, 0) << call.text << "4: a wrong weight is not detected";
}

TEST(PolicyHeader, OptionsFollowTargetsFromOutside) {
  const TemporaryFolder folder;
  const ExportedPolicy standing = export_policy(
      standing_policy("option 3", exported_option().meant.agent, make_character()), false, small_coder());
  write_file_atomically(folder.path / "all.h",
                        to_header(std::vector<ExportedPolicy>{standing, exported_in_float()}));
  const Call call = compiled(
      folder,
      "#include \"all.h\"\n"
      "namespace option = policies::policy_option_3;\n"
      "namespace squat = policies::policy_a_squat;\n"
      "int main() {\n"
      "  policies::State now = option::reference(0), next = squat::reference(20);\n"
      "  const policies::Targets stand = option::follow(0, now), down = option::follow(next, now);\n"
      "  float turned = 0.0F;\n"
      "  for (int k = 0; k < 4; ++k) turned += (stand.q[4][k] - down.q[4][k]) * (stand.q[4][k] - "
      "down.q[4][k]);\n"
      "  const policies::Targets by_frame = squat::follow(19, now), by_state = squat::follow(next, now);\n"
      "  for (int k = 0; k < 4; ++k) if (by_frame.q[4][k] != by_state.q[4][k]) return 1;\n"
      "  return option::kFrames == 2 && turned > 0.01F && option::self_test() == 0.0F ? 0 : 1;\n"
      "}\n");
  EXPECT_EQ(call.status, 0) << call.text;
}

TEST(PolicyHeader, SeveralPoliciesShareTheTypesOfOneHeader) {
  const TemporaryFolder folder;
  ExportedPolicy other = exported_in_8_bits();
  other.meant.motion.name = "other";
  write_file_atomically(folder.path / "all.h",
                        to_header(std::vector<ExportedPolicy>{exported_in_float(), other}));
  const Call call = compiled(folder,
                             "#include \"all.h\"\n"
                             "int main() {\n"
                             "  policies::State body = policies::policy_a_squat::reference(0);\n"
                             "  policies::Targets targets = policies::policy_other::follow(1, body);\n"
                             "  targets = policies::policy_a_squat::follow(0, body);\n"
                             "  return targets.q[1][0] <= 1.0F && policies::policy_a_squat::self_test() +\n"
                             "      policies::policy_other::self_test() == 0.0F ? 0 : 1;\n"
                             "}\n");
  EXPECT_EQ(call.status, 0) << call.text;
  EXPECT_THROW(to_header(std::vector<ExportedPolicy>{exported_in_float(), exported_in_8_bits()}),
               std::invalid_argument);  // of one name
  EXPECT_EQ(to_header(std::vector<ExportedPolicy>{exported_in_float()}), to_header(exported_in_float()));
}

/// A program of a page: the indented block under its name in bold.
std::string program_of(const std::string& page, const std::string& name) {
  const std::string text = read_file(std::string(MIMICX_SOURCE_DIR) + "/docs/" + page),
                    title = "**" + name + "**\n\n";
  std::istringstream lines(text.substr(text.find(title) + title.size()));
  std::string program;
  for (std::string line; std::getline(lines, line) && (line.empty() || line.starts_with("    "));)
    program += (line.empty() ? line : line.substr(4)) + '\n';
  return program;
}

/// A body that is where the motion is, and whose motors count what they are told.
constexpr const char* kBoard = R"(
#include "policy.h"
static int commands = 0;
extern "C" {
void sense(int t, float* root, float* q, float* omega) {
  const policy_a_squat::State at = policy_a_squat::reference(t);
  for (int k = 0; k < 3; ++k) root[k] = at.p_root[k], root[3 + k] = at.v_root[k];
  for (int k = 0; k < 88; ++k) q[k] = at.q[k / 4][k % 4];
  for (int k = 0; k < 66; ++k) omega[k] = at.omega[k / 3][k % 3];
}
void command(const float* q) {
  const float norm = q[4] * q[4] + q[5] * q[5] + q[6] * q[6] + q[7] * q[7];
  if (norm > 0.999F && norm < 1.001F) ++commands;
}
void wait_for_frame() {}
int board_main(void);
}
int main() { return board_main() == 0 && commands == policy_a_squat::kFrames - 1 ? 0 : 1; }
)";

TEST(PolicyHeader, IsCalledFromCAsThePageShows) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path / "policy.h", to_header(exported_in_8_bits()));
  for (const std::string name : {"policy_in_c.cpp", "main.c"})
    write_file_atomically(folder.path / name, program_of("new_board.md", name));
  write_file_atomically(folder.path / "board.cpp", kBoard);
  const Call call =
      shell("cd " + folder.path.string() +
            " && cc -std=c99 -Wall -Wextra -Werror -Dmain=board_main -c main.c -o main.o 2>&1 && " +
            MIMICX_COMPILER + kEmbedded + "policy_in_c.cpp board.cpp main.o -o all 2>&1 && ./all");
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
