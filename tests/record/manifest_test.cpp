#include "record/manifest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/error.h"
#include "core/temporary_folder.h"
#include "record/example_manifest.h"

namespace mimicx::record {
namespace {

TEST(Manifest, ReadsBackAsTheSameBytes) {
  const TemporaryFolder folder;
  const std::string text = format_manifest(example_manifest());
  std::ofstream(folder.path / "manifest.json") << text;
  const Manifest back = read_manifest(folder.path / "manifest.json");
  EXPECT_EQ(format_manifest(back), text);
  EXPECT_EQ(back.seed, 18446744073709551615u);
  EXPECT_EQ(back.sequences.at(0).reward_before, 0.1 + 0.2);
  EXPECT_TRUE(std::isnan(back.sequences.at(0).metrics.at(1).second));
}

TEST(Manifest, IsOneIndentedDocumentForAnyNumberOfEntries) {
  Manifest m = example_manifest();
  for (const std::size_t count : {0u, 1u, 3u}) {
    m.sequences.resize(count, example_manifest().sequences[0]);
    const std::string text = format_manifest(m);
    EXPECT_EQ(Json::parse(text).dump(1) + "\n", text) << count;
  }
}

TEST(Manifest, OrderPutsTheInputsLastInTheirOrder) {
  Manifest m = example_manifest();
  for (const char* input : {"c", "b", "x", "a"}) {
    SequenceEntry e;
    e.input = input;
    m.put(e);
  }
  m.order({"a", "b", "c", "not there"});
  std::string inputs;
  for (std::size_t i = 1; i < m.sequences.size(); ++i) inputs += m.sequences[i].input;
  EXPECT_EQ(inputs, "xabc");
}

TEST(Manifest, KeepsOneEntryPerInput) {
  Manifest m = example_manifest();
  SequenceEntry again = m.sequences[0];
  again.ok = false;
  again.reason = "fell";
  m.put(again);
  ASSERT_EQ(m.sequences.size(), 1u);
  EXPECT_EQ(m.find(again.input)->reason, "fell");
  EXPECT_EQ(m.find("other.npz"), nullptr);
}

TEST(Manifest, ResultIsFinishedUnlessMissingOrStoppedByTheTimeLimit) {
  SequenceEntry e = example_manifest().sequences[0];
  EXPECT_TRUE(e.finished());
  e.ok = false;  // it fell: spending the same samples again gives the same fall
  EXPECT_TRUE(e.finished());
  e.ending = SequenceEnding::kLimitSeconds;
  EXPECT_FALSE(e.finished());
  e.ending = SequenceEnding::kNone;
  e.output.clear();
  EXPECT_FALSE(e.finished());
}

TEST(Manifest, DifferencesCompareEverySetting) {
  const Manifest m = example_manifest();
  EXPECT_TRUE(m.differences(example_manifest()).empty());
  const auto differs = [&](auto change) {
    Manifest other = example_manifest();
    change(other);
    return m.differences(other).size() == 1;
  };
  EXPECT_TRUE(differs([](Manifest& o) { o.seed = 2; }));
  EXPECT_TRUE(differs([](Manifest& o) { o.samples = 2; }));
  EXPECT_TRUE(differs([](Manifest& o) { o.version = "0.2.0"; }));
  EXPECT_TRUE(differs([](Manifest& o) { o.target = "x86-64-v4"; }));
  EXPECT_TRUE(differs([](Manifest& o) { o.settings[0].second = 0.98; }));
  EXPECT_TRUE(differs([](Manifest& o) { o.settings.pop_back(); }));
}

TEST(Manifest, SettingThatIsNoneTodayIsADifference) {
  Manifest today = example_manifest(), before = today;
  before.settings.insert(before.settings.begin(), {"step_factor", 2.0});
  EXPECT_EQ(in_words(today.differences(before)), "step_factor is 2 there, not set here");
  before.settings.front() = {"never_a_setting", 1.5};
  EXPECT_EQ(today.differences(before).size(), 1u);
}

TEST(Manifest, RejectsOtherFilesByName) {
  const TemporaryFolder folder;
  for (const char* bad : {"", "{", "[]", "{\"run\": {}, \"sequences\": []}"}) {
    std::ofstream(folder.path / "manifest.json") << bad;
    try {
      read_manifest(folder.path / "manifest.json");
      ADD_FAILURE() << "accepted: " << bad;
    } catch (const DataError& error) {
      EXPECT_NE(std::string(error.what()).find("manifest.json"), std::string::npos);
    }
  }
}

TEST(Manifest, RecognisesTheManifestOfTrainedOptions) {
  try {
    parse_manifest(R"({"run": {"samples": 1}, "options": []})", "o/manifest.json");
    FAIL();
  } catch (const DataError& error) {
    EXPECT_STREQ(
        error.what(),
        "o/manifest.json: expected the manifest of a run over motions, found that of trained options "
        "(mimicx pretrain or teach)");
  }
}

TEST(Manifest, RejectsUnknownEnding) {
  std::string text = format_manifest(example_manifest());
  const std::string word = "\"ending\": \"budget\"";
  text.replace(text.find(word), word.size(), "\"ending\": \"unheard of\"");
  try {
    parse_manifest(text, "manifest.json");
    FAIL() << "its number would be behind the last of them";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("'unheard of'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace mimicx::record
