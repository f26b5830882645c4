#include "record/json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/random.h"

namespace mimicx::record {
namespace {

using Oracle = nlohmann::ordered_json;

/// The same value twice, made of the same random numbers.
std::pair<Json, Oracle> random_value(Random& random, int depth) {
  const auto kind = static_cast<int>(random.uniform() * (depth > 0 ? 8 : 6));
  const double number = (random.uniform() - 0.5) * std::pow(10.0, 40.0 * (random.uniform() - 0.5));
  const auto whole = static_cast<std::int64_t>(1e18 * (random.uniform() - 0.5));
  switch (kind) {
    case 0:
      return {nullptr, nullptr};
    case 1:
      return {number > 0.0, number > 0.0};
    case 2:
      return {number, number};
    case 3:
      return {whole, whole};
    case 4:
      return {std::floor(number), std::floor(number)};
    case 5: {
      const std::string text = "a\"\\\n\x01 ü\xff" + std::to_string(whole);
      return {text, text};
    }
    default:
      break;
  }
  Json json = kind == 6 ? Json::array() : Json::object();
  Oracle oracle = kind == 6 ? Oracle::array() : Oracle::object();
  for (int i = static_cast<int>(4 * random.uniform()); i > 0; --i) {
    const auto [a, b] = random_value(random, depth - 1);
    if (kind == 6) {
      json.push_back(a);
      oracle.push_back(b);
    } else {
      json["m " + std::to_string(i)] = a;
      oracle["m " + std::to_string(i)] = b;
    }
  }
  return {json, oracle};
}

TEST(Json, DumpMatchesNlohmannAndParsesBack) {
  Random random(17);
  for (int k = 0; k < 500; ++k) {
    const auto [json, oracle] = random_value(random, 5);
    for (const int indent : {-1, 0, 1, 3})
      ASSERT_EQ(json.dump(indent), oracle.dump(indent, ' ', false, Oracle::error_handler_t::replace));
    const Json back = Json::parse(json.dump());
    EXPECT_EQ(back.dump(1), json.dump(1));
    EXPECT_EQ(back, json);
  }
}

TEST(Json, BracesOfTextPairsAreObjects) {
  const Json json = {{"name", "walk"},  {"list", {1, 2.5, "x"}}, {"pairs", {{"a", 1}}},
                     {"none", nullptr}, {"yes", true},           {"vector", std::vector<double>{1.0, 0.5}}};
  EXPECT_EQ(json.dump(), R"({"name":"walk","list":[1,2.5,"x"],"pairs":{"a":1},"none":null,"yes":true,)"
                         R"("vector":[1.0,0.5]})");
  EXPECT_EQ(Json({1, 2}).dump(), "[1,2]");
}

TEST(Json, ReadsEachTypeAndNamesTheExpectedOne) {
  const Json json = Json::parse(R"({"n": 3, "x": -2.5, "t": "text", "l": [[1, 2], [3, 4]], "b": true})");
  const int n = json.at("n");
  const double x = json.at("x"), whole = json.at("n");
  EXPECT_EQ(n, 3);
  EXPECT_EQ(x, -2.5);
  EXPECT_EQ(whole, 3.0);
  EXPECT_EQ(json.at("t").get<std::string>(), "text");
  EXPECT_EQ((json.at("l").get<std::vector<std::array<int, 2>>>()),
            (std::vector<std::array<int, 2>>{{1, 2}, {3, 4}}));
  EXPECT_EQ(json.at("l").at(1).at(0).get<int>(), 3);
  EXPECT_TRUE(json.at("b").get<bool>());
  EXPECT_EQ(json.value("m", 7).get<int>(), 7);
  EXPECT_THROW(json.at("m"), JsonError);
  EXPECT_THROW(json.at("t").get<double>(), JsonError);
  EXPECT_THROW(json.at("x").get<int>(), JsonError);
  EXPECT_THROW(json.at("x").get<std::uint64_t>(), JsonError);
  EXPECT_THROW(json.at("n").get<std::string>(), JsonError);
  EXPECT_THROW(json.at("l").get<std::vector<double>>(), JsonError);
  EXPECT_THROW((json.at("l").get<std::array<std::array<int, 2>, 3>>()), JsonError);
}

TEST(Json, ErrorsSayWhatWasFound) {
  const auto found = [](const char* text, const auto& use) -> std::string {
    try {
      use(Json::parse(text));
      return "all is well";
    } catch (const JsonError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(found("{}", [](const Json& j) { j.at("run"); }), "no member run");
  EXPECT_EQ(found("[3]", [](const Json& j) { j.at(1); }), "no element 1");
  EXPECT_EQ(found("{}", [](const Json& j) { j.at(0); }), "a value that is no array");
  EXPECT_EQ(found("3", [](const Json& j) { j.items(); }), "a value that is no object");
  EXPECT_EQ(found("{\n\"a\": 1,\n\"b\" 2}", [](const Json&) {}), "no JSON at line 3");
  EXPECT_EQ(found(R"({"a": 1, "a": 2})", [](const Json&) {}), "\"a\" twice");
  EXPECT_EQ(found("-3", [](const Json& j) { j.get<std::uint64_t>(); }), "a negative number");
}

TEST(Json, RejectsInvalidJson) {
  for (const std::string text : {"", "{", "[1,]", "{\"a\" 1}", "nul", "1 2", "\"\xff\"", "{\"a\":1}}"})
    EXPECT_THROW(Json::parse(text), JsonError) << text;
  EXPECT_THROW(Json::parse(std::string(100'000, '[')), JsonError) << "no stack is deep enough";
}

}  // namespace
}  // namespace mimicx::record
