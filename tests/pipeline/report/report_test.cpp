#include "pipeline/report/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace mimicx::pipeline::report {
namespace {

/// Independent of the encoder: a table look-up per digit.
std::vector<std::uint8_t> decode_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t word = 0;
  int bits = 0;
  for (char c : text) {
    if (c == '=') break;
    word = word << 6 | static_cast<std::uint32_t>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<std::uint8_t>(word >> bits & 0xFF));
  }
  return bytes;
}

BodyPoses turned_pose(const Character& character, double angle) {
  PerBody<Quaterniond> q;
  q.fill(exp_map(Vector3d(0.1 * angle, -0.2 * angle, 0.05)));
  return forward_kinematics(character, {1.5, -2.0, 0.9}, q);
}

ReportSequence example() {
  ReportSequence s;
  s.name = "walk </script><b>";
  s.status = "ok";
  s.character = make_character();
  for (int i = 0; i < 3; ++i) s.simulated.push_back(turned_pose(s.character, i));
  s.metric_columns = {"simulated"};
  s.metrics = {{"MPJPE, mm", {std::nan("")}}};
  s.series = {{"reward", 1.0 / 30.0, {0.5, 0.25, std::nan("")}}};
  s.log = {{"iteration", "samples", "reward"}, {{0, 1024, 0.123456789}, {1, 2048, 0.5}}};
  return s;
}

nlohmann::json data_of(const std::string& page) {
  const std::string opening = "<script id=\"data\" type=\"application/json\">";
  const std::size_t begin = page.find(opening) + opening.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(Report, CapsuleEndsAreThoseOfTheBodiesToHalfAMillimetre) {
  const Character c = make_character();
  const std::vector<BodyPoses> poses = {turned_pose(c, 0.0), turned_pose(c, 2.0)};
  const auto bytes = decode_base64(encode_capsules(c, poses));
  ASSERT_EQ(bytes.size(), 2u * kBodies * 2 * 3 * 2);
  for (std::size_t t = 0; t < poses.size(); ++t) {
    for (std::size_t i = 0; i < kBodies; ++i) {
      for (std::size_t k = 0; k < 6; ++k) {
        const std::size_t at = 2 * ((t * kBodies + i) * 6 + k);
        const auto mm = static_cast<std::int16_t>(bytes[at] | bytes[at + 1] << 8);
        const Vector3d end = k < 3 ? c.capsule[i].a_B : c.capsule[i].b_B;
        const Vector3d world = poses[t].p_WB[i] + poses[t].q_WB[i].toRotationMatrix() * end;
        EXPECT_NEAR(1e-3 * mm, world[static_cast<int>(k % 3)], 0.501e-3);
      }
    }
  }
}

TEST(Report, DataSurvivesTheHtmlAroundIt) {
  const std::string page = format_report({example(), example()});
  const auto data = data_of(page);
  ASSERT_EQ(data["sequences"].size(), 2u);
  const auto& s = data["sequences"][0];
  EXPECT_EQ(s["name"], "walk </script><b>");
  EXPECT_EQ(s["frames"], 3);
  EXPECT_TRUE(s["reference"].is_null());
  EXPECT_TRUE(s["metrics"]["rows"][0]["values"][0].is_null());
  EXPECT_TRUE(s["series"][0]["values"][2].is_null());
  EXPECT_EQ(s["log"]["rows"][1][2], 0.5);
  EXPECT_NEAR(s["log"]["rows"][0][2].get<double>(), 0.123456789, 1e-5);
}

TEST(Report, NeedsOfTheReferenceAreThereFrameByFrameOrNotAtAll) {
  ReportSequence s = example();
  EXPECT_FALSE(data_of(format_report({s}))["sequences"][0].contains("needs"));
  s.needs = {{310.123456, 0.0, 2.0}, {4.5, 0.0, 0.03}, {12.0, 0.0, 1.0}, {1.0, 0.0, 0.01}};
  s.wrong = {"hovers", "feasible", "</script>"};
  auto data = data_of(format_report({s}))["sequences"][0];
  EXPECT_FALSE(data.contains("help"));
  EXPECT_EQ(data["needs"]["force"][0], 310.12);
  EXPECT_EQ(data["needs"]["acceleration"][0], 4.5);
  EXPECT_EQ(data["needs"]["moment"][2], 1.0);
  EXPECT_EQ(data["needs"]["bar"][2], 0.01);
  EXPECT_EQ(data["needs"]["wrong"], (std::vector<std::string>{"hovers", "feasible", "</script>"}));
  s.help = {{100.0}, {1.5}, {3.0}, {0.3}};
  data = data_of(format_report({s}))["sequences"][0];
  EXPECT_EQ(data["help"]["force"].size(), 1u);
}

TEST(Report, NeedsNoNetwork) {
  const std::string page = format_report({example()});
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

TEST(Report, IsTheSameBytesForTheSameRun) {
  EXPECT_EQ(format_report({example()}), format_report({example()}));
}

TEST(Report, OfNothingIsStillAPage) { EXPECT_TRUE(data_of(format_report({}))["sequences"].empty()); }

}  // namespace
}  // namespace mimicx::pipeline::report
