#include "report/report.h"

#include <gtest/gtest.h>

#include <cmath>

#include "record/json.h"

namespace mimicx::report {
namespace {

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
  clip.motions.push_back({Who::kCleaned, make_character(), {}, {}, "4d"});
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

TEST(Report, DataIsEscapedForHtml) {
  const std::string page = format_report(example(), {clip_json(example_clip())});
  const auto data = record::Json::parse(element(page, "data"));
  ASSERT_EQ(data.at("rows").elements().size(), 1u);
  const auto& row = data.at("rows").at(0);
  EXPECT_EQ(row.at("name").get<std::string>(), "walk </script><b>");
  EXPECT_EQ(row.at("values").at(0).at(0).get<double>(), 1.23457);
  EXPECT_TRUE(row.at("values").at(0).at(1).is_null());
  EXPECT_EQ(data.at("metrics").at(0).at("key").get<std::string>(), "FS");
  EXPECT_EQ(data.at("metrics").at(0).at("meaning").get<std::string>(), "how far");
  const auto clip = record::Json::parse(element(page, "clip-0"));
  EXPECT_EQ(clip.at("motions").at(0).at("frames").get<int>(), 3);
  EXPECT_EQ(clip.at("motions").at(0).at("body").get<std::string>(), "4d");
  EXPECT_EQ(clip.at("charts").at(0).at("lines").at(0).at("name").get<std::string>(), "</script>");
  EXPECT_TRUE(clip.at("charts").at(0).at("lines").at(0).at("values").at(2).is_null());
  EXPECT_NEAR(clip.at("training").at(0).at("lines").at(0).at("values").at(0).get<double>(), 0.123456789,
              1e-4);
  EXPECT_EQ(clip.at("training").at(0).at("x").at(1).get<double>(), 2048);
  EXPECT_EQ(clip.at("bars").at(0).at("spans").get<std::vector<std::vector<int>>>(),
            (std::vector<std::vector<int>>{{0, 1}}));
}

// "<!--" with "<script" behind it would keep the element open to the end of the page.
TEST(Report, NamesCannotEndTheirElementOrKeepItOpen) {
  const std::string name = "walk <!-- <script> </script>";
  Report report = example();
  report.rows[0].name = name;
  ReportClip clip = example_clip();
  clip.notes = {name};
  const std::string page = format_report(report, {clip_json(clip)});
  for (const char* id : {"data", "clip-0"}) EXPECT_EQ(element(page, id).find('<'), std::string::npos) << id;
  EXPECT_EQ(record::Json::parse(element(page, "data")).at("rows").at(0).at("name").get<std::string>(), name);
  EXPECT_EQ(record::Json::parse(element(page, "clip-0")).at("notes").at(0).get<std::string>(), name);
  EXPECT_EQ(clip_script(name, "{}", {}).find('<'), std::string::npos);
}

TEST(Report, ClipScriptIsOneCallWithDataAndBodies) {
  const std::string json = clip_json(example_clip());
  EXPECT_EQ(clip_script("a \"b\"/c", json, {{"0a", "{\"x\":1}"}, {"4b", "{}"}}),
            "mimicx_clip(\"a \\\"b\\\"/c\", " + json + ", {\"0a\": {\"x\":1}, \"4b\": {}});\n");
  EXPECT_EQ(format_report(example(), {""}).find("\"clip-0\""), std::string::npos);
}

TEST(Report, OmitsMissingData) {
  ReportClip clip = example_clip();
  const auto without = record::Json::parse(clip_json(clip));
  for (const char* key : {"ground", "torques", "camera", "options", "needs"})
    EXPECT_FALSE(without.contains(key)) << key;
  EXPECT_FALSE(without.at("motions").at(0).contains("support"));
  clip.torques.resize(3);
  clip.options = {{0, 1, 3}, {2, 2, 0}};
  clip.motions[0].support.resize(3);
  const auto with = record::Json::parse(clip_json(clip));
  EXPECT_EQ(with.at("options").get<std::vector<std::vector<int>>>(),
            (std::vector<std::vector<int>>{{0, 1, 3}, {2, 2, 0}}));
  EXPECT_EQ(with.at("torques").get<std::string>().size(), 3u * 2u * kBodies);
  EXPECT_EQ(with.at("motions").at(0).at("support").get<std::string>().size(), 3u);
}

TEST(Report, EachBodyIsInThePageOnce) {
  Report report = example();
  report.skin = "{\"parents\":[-1]}";
  report.bodies = {{"0a", "{\"a\":1}"}, {"1b", "{\"a\":2}"}};
  report.map = "{\"clips\":[]}";
  const std::string page = format_report(report, {clip_json(example_clip())});
  EXPECT_EQ(record::Json::parse(element(page, "skin")).at("parents").at(0).get<int>(), -1);
  EXPECT_EQ(record::Json::parse(element(page, "body-1b")).at("a").get<int>(), 2);
  EXPECT_TRUE(record::Json::parse(element(page, "data")).at("map").at("clips").elements().empty());
}

TEST(Report, PlatesAreThereOnlyIfTheSceneHasSome) {
  ReportClip clip = example_clip();
  EXPECT_FALSE(record::Json::parse(clip_json(clip)).contains("plates"));
  clip.scene.plates = {{{1.0, -2.0}, 0.5, {0.25, 0.125}, 0.5}, {{0.0, 0.0}, 0.0, {1.0, 1.0}, 0.25}};
  const auto plates = record::Json::parse(clip_json(clip)).at("plates");
  EXPECT_EQ(plates.get<std::vector<std::vector<double>>>(),
            (std::vector<std::vector<double>>{{1, -2, 0.5, 0.25, 0.125, 0.5}, {0, 0, 0, 1, 1, 0.25}}));
}

TEST(Report, ReferenceNeedsAreThereForAllFramesOrNone) {
  ReportClip clip = example_clip();
  EXPECT_FALSE(record::Json::parse(clip_json(clip)).contains("needs"));
  clip.needs = {{310.123456, 0.0, 2.0}, {4.5, 0.0, 0.03}, {12.0, 0.0, 1.0}, {1.0, 0.0, 0.01}};
  clip.wrong = {"hovers", "feasible", "</script>"};
  auto data = record::Json::parse(clip_json(clip));
  EXPECT_FALSE(data.contains("help"));
  EXPECT_EQ(data.at("needs").at("force").at(0).get<double>(), 310.1);
  EXPECT_EQ(data.at("needs").at("acceleration").at(0).get<double>(), 4.5);
  EXPECT_EQ(data.at("needs").at("moment").at(2).get<double>(), 1.0);
  EXPECT_EQ(data.at("needs").at("bar").at(2).get<double>(), 0.01);
  EXPECT_EQ(data.at("needs").at("wrong").get<std::vector<std::string>>(),
            (std::vector<std::string>{"hovers", "feasible", "</script>"}));
  clip.assistance = {{100.0}, {1.5}, {3.0}, {0.3}};
  data = record::Json::parse(clip_json(clip));
  EXPECT_EQ(data.at("help").at("force").elements().size(), 1u);
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

// 14 clips of 8 seconds with four motions each, beside the page's own 90 kB and 15 kB a body.
TEST(Report, AFrameOfAMotionTakesFewerThanTwoHundredBytes) {
  ReportClip clip = example_clip();
  const std::size_t three = clip_json(clip).size();
  for (int t = 0; t < 240; ++t) clip.motions[0].poses.push_back(clip.motions[0].poses[0]);
  clip.motions[0].support.assign(243, Polygon(8));
  EXPECT_LT(clip_json(clip).size() - three, 200u * 240u);
  EXPECT_LT(format_report({}, {}).size(), 130'000u);
}

TEST(Report, IsDeterministic) {
  EXPECT_EQ(format_report(example(), {clip_json(example_clip())}),
            format_report(example(), {clip_json(example_clip())}));
}

TEST(Report, IsAPageWithoutClips) {
  EXPECT_TRUE(record::Json::parse(element(format_report({}, {}), "data")).at("rows").elements().empty());
}

}  // namespace
}  // namespace mimicx::report
