#include "record/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "core/random.h"
#include "core/temporary_folder.h"

namespace mimicx::record {
namespace {

TEST(Table, NumbersRoundTripExactly) {
  const TemporaryFolder folder;
  Random random(1, {7});
  Table table{{"a", "b"}, {}};
  for (int i = 0; i < 500; ++i)
    table.rows.push_back({random.normal() * std::pow(10.0, random.uniform(-300.0, 300.0)), random.normal()});
  std::ofstream(folder.path / "t.csv") << format_csv(table);
  const Table back = read_csv(folder.path / "t.csv");
  EXPECT_EQ(back.columns, table.columns);
  EXPECT_EQ(back.rows, table.rows);
}

TEST(Table, MissingValuesAreEmptyFields) {
  const TemporaryFolder folder;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string text = format_csv({{"a", "b", "c"}, {{1.0, nan, 0.5}}});
  EXPECT_EQ(text, "a,b,c\n1,,0.5\n");
  std::ofstream(folder.path / "t.csv") << text;
  EXPECT_TRUE(std::isnan(read_csv(folder.path / "t.csv").rows.at(0).at(1)));
}

TEST(Table, BadLineIsReportedWithFileAndLine) {
  const TemporaryFolder folder;
  for (const char* bad : {"a,b\n1,2\n1\n", "a,b\n1,2\n1,x\n", "a,b\n1,2\n1,2,3\n"}) {
    std::ofstream(folder.path / "t.csv") << bad;
    try {
      read_csv(folder.path / "t.csv");
      ADD_FAILURE() << "accepted: " << bad;
    } catch (const DataError& error) {
      EXPECT_NE(std::string(error.what()).find("t.csv: line 3"), std::string::npos) << error.what();
    }
  }
}

TEST(Table, RejectsUnknownColumn) {
  EXPECT_EQ((Table{{"a", "b"}, {}}).column("b"), 1u);
  EXPECT_THROW((Table{{"a"}, {}}).column("b"), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::record
