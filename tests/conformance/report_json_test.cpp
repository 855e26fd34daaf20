// The judgement as JSON: every number is there, and nothing is there that JSON cannot hold.
#include "conformance/report_json.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "conformance/example_judgement.h"

namespace rainref::conformance {
namespace {

using Json = nlohmann::json;

TEST(ReportJson, HoldsTheWholeJudgement) {
  const Json j = Json::parse(report_json(example_judgement(), 1));
  EXPECT_EQ(j["format"], "rainref.judgement");
  EXPECT_EQ(j["version"], 1);
  EXPECT_EQ(j["status"], "FAIL");
  EXPECT_EQ(j["exit_code"], 1);
  EXPECT_EQ(j["first_bad_pass"], "shade");
  EXPECT_EQ(j["device"], (Json{{"api", "Vulkan 1.3"}, {"name", "Test & <Device>"}, {"driver", ""}}));
  EXPECT_EQ(j["command"], "rainref validate pack --port port");
  EXPECT_EQ(j["notes"], (Json{"port/x.exr: one note"}));
  ASSERT_EQ(j["passes"].size(), 4u);

  const Json& hit = j["passes"][1];
  EXPECT_EQ(hit["status"], "WARN");
  EXPECT_EQ(hit["cases"][0]["ambiguous"], 4);
  EXPECT_EQ(hit["cases"][0]["other_branch"], 1);
  const Json& out = hit["cases"][0]["outputs"][0];
  EXPECT_EQ(out["bounded"], 7);
  EXPECT_EQ(out["vacuous"], 1);
  EXPECT_EQ(out["loose"], 2);
  EXPECT_EQ(out["atypical"], 2);
  EXPECT_EQ(out["median_width"], 7);
  EXPECT_EQ(out["p99_width"], 4e9);
  EXPECT_EQ(out["map"], (Json{0, 1, 2, 2, 0, 4, 1, 1}));
  EXPECT_FALSE(j["passes"][0]["cases"][0]["outputs"][0].contains("map"));

  const Json& shade = j["passes"][3];
  EXPECT_EQ(shade["half_mode"], "rtz");
  EXPECT_EQ(shade["half_votes"], (Json{{"rne", 8}, {"rtz", 2}, {"either", 2}}));
  EXPECT_EQ(shade["causes"][0], (Json{{"name", "upside down"}, {"sentence", "the buffer is stored from the bottom up"}, {"explained", 2}, {"of", 2}, {"inside", 1}}));
  const Json& worst = shade["cases"][0]["outputs"][0]["worst"];
  ASSERT_EQ(worst.size(), 2u);
  EXPECT_EQ(worst[0]["got"], (Json{{"value", nullptr}, {"bits", "0x7e01"}, {"code", 0x7e01}}));
  EXPECT_EQ(worst[0]["distance"], nullptr);
  EXPECT_EQ(worst[0]["not_a_number"], true);
  EXPECT_EQ(worst[1]["x"], 0);
  EXPECT_EQ(worst[1]["y"], 1);
  EXPECT_EQ(worst[1]["channel"], 3);
  EXPECT_EQ(worst[1]["low"], (Json{{"value", 1.0}, {"bits", "0x3c00"}, {"code", 0x3c00}}));
  EXPECT_EQ(worst[1]["distance"], 3);
}

TEST(ReportJson, TheRunsOfAMapAreTheMap) {
  PortJudgement j = example_judgement();
  OutputJudgement& o = j.passes[3].cases[0].outputs[0];
  const Json runs = Json::parse(report_json(j, 1))["passes"][3]["cases"][0]["outputs"][0]["map"];
  std::vector<std::uint8_t> map;
  for (std::size_t k = 0; k < runs.size(); k += 2) map.insert(map.end(), runs[k + 1].get<std::size_t>(), runs[k].get<std::uint8_t>());
  EXPECT_EQ(map, o.map);
}

TEST(ReportJson, NamesThatAreNoUtf8AndRangesWithoutEnds) {
  PortJudgement j = example_judgement();
  j.port = "bad \xff name";
  Failure& f = j.passes[3].cases[0].outputs[0].worst[1];
  f.low = INT64_MIN;
  f.high = INT64_MAX;
  f.got = -0x7c00;
  const Json out = Json::parse(report_json(j, 1));
  EXPECT_EQ(out["port"], "bad \xef\xbf\xbd name");
  const Json& worst = out["passes"][3]["cases"][0]["outputs"][0]["worst"][1];
  EXPECT_EQ(worst["low"], nullptr);
  EXPECT_EQ(worst["high"], nullptr);
  EXPECT_EQ(worst["got"], (Json{{"value", nullptr}, {"bits", "0xfc00"}, {"code", -0x7c00}}));
}

TEST(ReportJson, RecordsAndKnownFailures) {
  PortJudgement j = example_judgement();
  OutputJudgement& o = j.passes[3].cases[0].outputs[0];
  o.records = true;
  o.map.clear();
  o.known = "a reason";
  const Json out = Json::parse(report_json(j, 1))["passes"][3]["cases"][0]["outputs"][0];
  EXPECT_EQ(out["format"], "records");
  EXPECT_EQ(out["worst"][0], (Json{{"record", 2}}));
  EXPECT_EQ(out["known"], "a reason");
  EXPECT_FALSE(out.contains("width"));
}

}  // namespace
}  // namespace rainref::conformance
