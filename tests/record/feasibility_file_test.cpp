// What a reference asks for, on disk: complete, exact, refused where it is damaged.
#include "record/feasibility_file.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/npz/npz.h"
#include "core/temporary_folder.h"

namespace mimicx::record {
namespace {

FrameFeasibility example() {
  FrameFeasibility all;
  all.mass = 70.0 / 3.0;
  for (int t = 0; t < 4; ++t) {
    Vector6d wrench;
    wrench << 1.0 / 3.0, 0.0, -t, 0.0, 3.0 * t, 4.0 * t;
    all.need.push_back(wrench);
    all.wrong.emplace_back(t == 0 ? "feasible" : "hovers");
    if (t < 2) all.assistance.push_back(-wrench);
  }
  return all;
}

struct FeasibilityFile : testing::Test {
  TemporaryFolder folder;
  std::filesystem::path file = folder.path / "f.npz";
};

TEST_F(FeasibilityFile, RoundTripIsExactWithAndWithoutAssistance) {
  FrameFeasibility all = example();
  for (int assistance : {2, 0}) {
    all.assistance.resize(assistance);
    write_feasibility(file, all);
    const FrameFeasibility back = read_feasibility(file);
    EXPECT_EQ(back.mass, all.mass);
    EXPECT_EQ(back.need, all.need);
    EXPECT_EQ(back.wrong, all.wrong);
    EXPECT_EQ(back.assistance, all.assistance);
  }
}

TEST_F(FeasibilityFile, AccelerationIsForceOverMass) {
  write_feasibility(file, example());
  const Npz npz = read_npz(file);
  const std::vector<double> need = npz.at("need_acceleration").to_double();
  ASSERT_EQ(need.size(), 4u);
  EXPECT_DOUBLE_EQ(need[2], 10.0 * 3.0 / 70.0);
  EXPECT_DOUBLE_EQ(npz.at("help_acceleration").to_double().at(1), 5.0 * 3.0 / 70.0);
}

TEST_F(FeasibilityFile, DamagedFileNamesTheMember) {
  for (const char* member : {"need", "wrong", "help", "mass"}) {
    write_feasibility(file, example());
    Npz npz = read_npz(file);
    npz.set(member, NpyArray::from_double({3, 1}, std::vector<double>(3, 1.0).data()));
    write_npz(file, npz);
    try {
      read_feasibility(file);
      ADD_FAILURE() << member;
    } catch (const DataError& error) {
      EXPECT_NE(std::string(error.what()).find(member), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace mimicx::record
