#include "pipeline/report/run_report.h"

#include <gtest/gtest.h>

#include "core/file.h"
#include "pipeline/temporary_folder.h"

namespace mimicx::pipeline::report {
namespace {

std::size_t count(const std::string& text, const std::string& words) {
  std::size_t found = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++found;
  return found;
}

TEST(RunReport, OfThousandsOfMotionsItReadsTwoHundredThoseThatFailedFirst) {
  const TemporaryFolder folder;
  record::Manifest manifest;
  for (int k = 0; k < 250; ++k) {
    record::SequenceEntry entry;
    entry.name = std::to_string(k);
    entry.input = entry.name;
    entry.ok = k < 230;
    entry.output = record::RunFolder::motion_name(entry.name, entry.ok);
    manifest.put(entry);
  }
  write_report(record::RunFolder{folder.path}, manifest);
  const std::string page = read_file(folder.path / "report.html");
  // None of the files is there, so what is read cannot be shown.
  EXPECT_EQ(count(page, "cannot be shown: "), 200u);
  EXPECT_EQ(count(page, "rejected/2"), 20u) << "all that failed are among them";
  EXPECT_EQ(count(page, "not shown: this page has the motions of 200 files"), 50u);
}

}  // namespace
}  // namespace mimicx::pipeline::report
