#include "pipeline/report/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace mimicx::pipeline::report {
namespace {

/// Independent of the encoder: a number of some base64 digits, from `at` on.
int number_at(const std::string& text, std::size_t at, int digits) {
  const std::string order = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  int number = 0, range = 1;
  for (int d = 0; d < digits; ++d) {
    number = 64 * number + static_cast<int>(order.find(text.at(at + static_cast<std::size_t>(d))));
    range *= 64;
  }
  return number - range / 2;
}

BodyPoses turned_pose(const Character& character, double angle, const Vector3d& place = {1.5, -2.0, 0.9}) {
  PerBody<Quaterniond> q;
  q.fill(exp_map(Vector3d(0.1 * angle, -0.2 * angle, 0.05)));
  return forward_kinematics(character, place, q);
}

Report example() {
  Report report;
  report.run = {{"clips", "1"}};
  report.metrics = {{"FS", {"feet slide", "mm/frame", "how far"}, "by itself"}};
  ReportRow row;
  row.name = "walk </script><b>";
  row.ok = true;
  row.frames = 3;
  row.values = {{1.2345678, std::nan(""), 0.25}};
  report.rows = {row};
  return report;
}

ReportClip example_clip() {
  ReportClip clip;
  clip.motions.push_back({Who::kCleaned, make_character(), {}});
  for (int i = 0; i < 3; ++i) clip.motions[0].poses.push_back(turned_pose(clip.motions[0].character, i));
  clip.charts.push_back(
      {{"reward", "", "1 is best"}, {{Who::kCleaned, "</script>", {0.5, 0.25, std::nan("")}}}, 0.1});
  clip.training.push_back({{"loss", "", ""}, {{Who::kNobody, "", {0.123456789, 0.5}}}});
  clip.training[0].x = {1024, 2048};
  clip.facts = {{"Plan", {"steps", "", ""}, 12.0}};
  clip.bars = {{"floats", "too high", true, {{0, 1}}}};
  clip.notes = {"a note"};
  return clip;
}

std::string element(const std::string& page, const std::string& id) {
  const std::string opening = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::string other = "<script id=\"" + id + "\" type=\"application/json\">";
  const std::size_t found = page.find(opening);
  const std::size_t begin =
      found == std::string::npos ? page.find(other) + other.size() : found + opening.size();
  return page.substr(begin, page.find("</script>", begin) - begin);
}

TEST(Report, CapsuleEndsAreThoseOfTheBodiesToHalfAMillimetreHoweverFarTheyAre) {
  const Character c = make_character();
  const std::vector<BodyPoses> poses = {turned_pose(c, 0.0), turned_pose(c, 2.0),
                                        turned_pose(c, 1.0, {-99.0, 120.0, 3.0})};
  const std::string text = encode_capsules(c, poses);
  const std::size_t frame = 9 + 2 * 6 * kBodies;
  ASSERT_EQ(text.size(), 3u * frame);
  for (std::size_t t = 0; t < poses.size(); ++t) {
    for (std::size_t i = 0; i < kBodies; ++i) {
      for (std::size_t k = 0; k < 6; ++k) {
        const int mm =
            number_at(text, t * frame + 3 * (k % 3), 3) + number_at(text, t * frame + 9 + 2 * (6 * i + k), 2);
        const Vector3d end = k < 3 ? c.capsule[i].a_B : c.capsule[i].b_B;
        const Vector3d world = poses[t].p_WB[i] + poses[t].q_WB[i].toRotationMatrix() * end;
        EXPECT_NEAR(1e-3 * mm, world[static_cast<int>(k % 3)], 0.501e-3);
      }
    }
  }
}

TEST(Report, ArrowsAreInMillimetresAndNewtons) {
  GroundForces frame;
  frame[1] = {{0.1234, -40.0, 0.0}, {-12.0, 3.4, 1500.0}};
  const std::string text = encode_ground({frame});
  ASSERT_EQ(text.size(), 45u);
  const std::vector<int> expected = {123, -40000, -12, 3, 1500};
  for (std::size_t k = 0; k < 15; ++k)
    EXPECT_EQ(number_at(text, 3 * k, 3), k < 5 || k >= 10 ? 0 : expected[k - 5]) << k;
}

TEST(Report, DataSurvivesTheHtmlAroundIt) {
  const std::string page = format_report(example(), {clip_json(example_clip())});
  const auto data = nlohmann::json::parse(element(page, "data"));
  ASSERT_EQ(data["rows"].size(), 1u);
  const auto& row = data["rows"][0];
  EXPECT_EQ(row["name"], "walk </script><b>");
  EXPECT_EQ(row["values"][0][0], 1.23457);
  EXPECT_TRUE(row["values"][0][1].is_null());
  EXPECT_EQ(data["metrics"][0]["key"], "FS");
  EXPECT_EQ(data["metrics"][0]["meaning"], "how far");
  const auto clip = nlohmann::json::parse(element(page, "clip-0"));
  EXPECT_EQ(clip["motions"][0]["frames"], 3);
  EXPECT_EQ(clip["charts"][0]["lines"][0]["name"], "</script>");
  EXPECT_TRUE(clip["charts"][0]["lines"][0]["values"][2].is_null());
  EXPECT_NEAR(clip["training"][0]["lines"][0]["values"][0].get<double>(), 0.123456789, 1e-4);
  EXPECT_EQ(clip["training"][0]["x"][1], 2048);
  EXPECT_EQ(clip["bars"][0]["spans"], (std::vector<std::vector<int>>{{0, 1}}));
}

TEST(Report, AClipBesideThePageIsOneCallWithTheSameData) {
  const std::string json = clip_json(example_clip());
  const std::string script = clip_script("a \"b\"/c", json);
  EXPECT_EQ(script, "mimicx_clip(\"a \\\"b\\\"/c\", " + json + ");\n");
  EXPECT_EQ(format_report(example(), {""}).find("\"clip-0\""), std::string::npos);
}

TEST(Report, NeedsOfTheReferenceAreThereFrameByFrameOrNotAtAll) {
  ReportClip clip = example_clip();
  EXPECT_FALSE(nlohmann::json::parse(clip_json(clip)).contains("needs"));
  clip.needs = {{310.123456, 0.0, 2.0}, {4.5, 0.0, 0.03}, {12.0, 0.0, 1.0}, {1.0, 0.0, 0.01}};
  clip.wrong = {"hovers", "feasible", "</script>"};
  auto data = nlohmann::json::parse(clip_json(clip));
  EXPECT_FALSE(data.contains("help"));
  EXPECT_EQ(data["needs"]["force"][0], 310.1);
  EXPECT_EQ(data["needs"]["acceleration"][0], 4.5);
  EXPECT_EQ(data["needs"]["moment"][2], 1.0);
  EXPECT_EQ(data["needs"]["bar"][2], 0.01);
  EXPECT_EQ(data["needs"]["wrong"], (std::vector<std::string>{"hovers", "feasible", "</script>"}));
  clip.help = {{100.0}, {1.5}, {3.0}, {0.3}};
  data = nlohmann::json::parse(clip_json(clip));
  EXPECT_EQ(data["help"]["force"].size(), 1u);
}

TEST(Report, NeedsNoNetwork) {
  const std::string page = format_report(example(), {clip_json(example_clip())});
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
  for (const char* forbidden : {"src=", "href=", "import(", "fetch(", "url(", "XMLHttpRequest", "@REPORT"})
    EXPECT_EQ(page.find(forbidden), std::string::npos) << forbidden;
  // The only address is the name of the SVG name space, which nothing opens.
  const std::size_t first = page.find("http");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(page.substr(first, 26), "http://www.w3.org/2000/svg");
  EXPECT_EQ(page.find("http", first + 1), std::string::npos);
}

// 14 clips of 8 seconds with four motions each, beside the page's own 60 kB.
TEST(Report, AFrameOfAMotionTakesFewerThanThreeHundredBytes) {
  ReportClip clip = example_clip();
  const std::size_t three = clip_json(clip).size();
  for (int t = 0; t < 240; ++t) clip.motions[0].poses.push_back(clip.motions[0].poses[0]);
  EXPECT_LT(clip_json(clip).size() - three, 300u * 240u);
  EXPECT_LT(format_report({}, {}).size(), 80'000u);
}

TEST(Report, IsTheSameBytesForTheSameRun) {
  EXPECT_EQ(format_report(example(), {clip_json(example_clip())}),
            format_report(example(), {clip_json(example_clip())}));
}

TEST(Report, OfNothingIsStillAPage) {
  EXPECT_TRUE(nlohmann::json::parse(element(format_report({}, {}), "data"))["rows"].empty());
}

}  // namespace
}  // namespace mimicx::pipeline::report
