// The judgement as JSON: every number is there, and nothing is there that JSON cannot hold.
#include "reports/json.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "faults/diagnose.h"
#include "judge/validate.h"
#include "reports/example_judgement.h"
#include "source_folder.h"

namespace rainref::reports {
namespace {

using namespace judge;

using Json = nlohmann::json;

TEST(ReportJson, HoldsTheWholeJudgement) {
  const Json j = Json::parse(report_json(example_judgement(), 1, {}));
  EXPECT_EQ(j["format"], "rainref.judgement");
  EXPECT_EQ(j["version"], 1);
  EXPECT_EQ(j["status"], "FAIL");
  EXPECT_EQ(j["exit_code"], 1);
  EXPECT_EQ(j["first_bad_pass"], "shade");
  EXPECT_EQ(j["device"], (Json{{"api", "Vulkan 1.3"}, {"name", "Test & <Device>"}, {"driver", ""}}));
  EXPECT_EQ(j["command"], "rainref validate pack --port port");
  EXPECT_EQ(j["notes"], (Json{"port/x.exr: one note"}));
  EXPECT_EQ(j["counts"], "1 FAIL, 1 UNTESTED, 1 WARN, 1 PASS");
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
  EXPECT_EQ(out["shape"], "r32f 4x2");
  EXPECT_EQ(out["median_text"], "7 codes");
  EXPECT_EQ(out["p99_text"], "vacuous");
  EXPECT_EQ(out["worst_quantity"], nullptr);
  EXPECT_EQ(out["median_width"], 7);
  EXPECT_EQ(out["p99_width"], 4e9);
  EXPECT_EQ(out["map"], (Json{0, 1, 2, 2, 0, 4, 1, 1}));
  EXPECT_FALSE(j["passes"][0]["cases"][0]["outputs"][0].contains("map"));

  const Json& shade = j["passes"][3];
  EXPECT_EQ(shade["half_mode"], "rtz");
  EXPECT_EQ(shade["half_votes"], (Json{{"rne", 8}, {"rtz", 2}, {"either", 2}}));
  EXPECT_EQ(shade["causes"][0], (Json{{"name", "upside down"},
                                      {"sentence", "the buffer is stored from the bottom up"},
                                      {"counted", "texels"},
                                      {"explained", 2},
                                      {"of", 2},
                                      {"inside", 1},
                                      {"is_likely", true},
                                      {"repeats_first", false},
                                      {"lines", Json::array({Json{{"file", "a.comp"}, {"line", 7}, {"until", 0}, {"text", "x = y;"}}})},
                                      {"line_texts", Json::array({"a.comp:7: x = y;"})}}));
  EXPECT_EQ(shade["figures"]["failing"], 2);
  EXPECT_EQ(shade["figures"]["invocations"], 16);  // of two cases
  EXPECT_EQ(shade["figures"]["outside"], 6);
  EXPECT_EQ(shade["figures"]["elements"], 64);
  EXPECT_EQ(shade["figures"]["median_text"], "2 codes");
  EXPECT_THAT(shade["half_text"].get<std::string>(), testing::HasSubstr("toward zero: 2"));
  EXPECT_EQ(shade["where"], "only channel y of colour");
  EXPECT_EQ(j["passes"][0]["where"], "");
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
  EXPECT_EQ(worst[1]["text"], (Json{{"place", "(0, 1).w"},
                                    {"got", "1.00391 (0x3c04)"},
                                    {"accepted", "1 (0x3c00) to 1.00098 (0x3c01)"},
                                    {"expected", "1 (0x3c00)"},
                                    {"off", "0.00293"}}));
}

// What fails worst in the first failing case, as a share of its range.
TEST(ReportJson, SaysWhatFailsWorst) {
  PortJudgement j = example_judgement();
  OutputJudgement& colour = j.passes[3].cases[0].outputs[0];
  colour.quantities = {{"x", "1", 2, 32, 2, 0, 0, 0, 0, 0, 0, 0, 1.5}, {"y", "m", 0.5, 32, 1, 0, 0, 0, 0, 0, 0, 0, 0.5}};
  const auto worst = [&] { return Json::parse(report_json(j, 1, {}))["passes"][3]["worst"]; };
  EXPECT_EQ(worst(), (Json{{"case", "rain.shade/0000.0"}, {"output", "colour"}, {"quantity", "y"}, {"off", "0.5 m"}}));
  colour.quantities[0].farthest = std::numeric_limits<double>::infinity();
  EXPECT_EQ(worst(), (Json{{"case", "rain.shade/0000.0"}, {"output", "colour"}, {"quantity", "x"}, {"off", nullptr}}));
  const Json pass = Json::parse(report_json(j, 1, {}))["passes"][3];
  EXPECT_EQ(pass["cases"][0]["outputs"][0]["worst_quantity"], "x");
  ASSERT_EQ(pass["quantities"].size(), 2u);
  EXPECT_EQ(pass["quantities"][1]["output"], "colour");
  EXPECT_EQ(pass["quantities"][1]["name"], "y");
  EXPECT_EQ(pass["quantities"][1]["counted"], "values");
  j.passes[3].cases[0].failing = 0;
  EXPECT_EQ(worst(), nullptr);
}

TEST(ReportJson, SaysWhatAPassDoesAndTakes) {
  PageSource source;
  source.edges = {{"shade", "hit", "hit", false}, {"wave", "wave", "wave", true}, {"shade", "bed", "host", false}};
  source.sentences["shade"] = "what it does";
  const Json passes = Json::parse(report_json(example_judgement(), 1, source))["passes"];
  EXPECT_EQ(passes[3]["sentence"], "what it does");
  EXPECT_EQ(passes[0]["sentence"], "");
  EXPECT_EQ(passes[0]["takes"], (Json{{{"input", "wave"}, {"from", "wave"}, {"previous", true}}}));
  EXPECT_EQ(passes[3]["takes"],
            (Json{{{"input", "hit"}, {"from", "hit"}, {"previous", false}}, {{"input", "bed"}, {"from", "host"}, {"previous", false}}}));
  EXPECT_EQ(passes[1]["takes"], Json::array());
}

TEST(ReportJson, TheRunsOfAMapAreTheMap) {
  PortJudgement j = example_judgement();
  OutputJudgement& o = j.passes[3].cases[0].outputs[0];
  const Json runs = Json::parse(report_json(j, 1, {}))["passes"][3]["cases"][0]["outputs"][0]["map"];
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
  const Json out = Json::parse(report_json(j, 1, {}));
  EXPECT_EQ(out["port"], "bad \xef\xbf\xbd name");
  const Json& worst = out["passes"][3]["cases"][0]["outputs"][0]["worst"][1];
  EXPECT_EQ(worst["low"], nullptr);
  EXPECT_EQ(worst["text"]["accepted"], "any number");
  EXPECT_EQ(worst["high"], nullptr);
  EXPECT_EQ(worst["got"], (Json{{"value", nullptr}, {"bits", "0xfc00"}, {"code", -0x7c00}}));
}

TEST(ReportJson, RecordsAndKnownFailures) {
  PortJudgement j = example_judgement();
  OutputJudgement& o = j.passes[3].cases[0].outputs[0];
  o.records = true;
  o.map.clear();
  o.known = "a reason";
  const Json out = Json::parse(report_json(j, 1, {}))["passes"][3]["cases"][0]["outputs"][0];
  EXPECT_EQ(out["format"], "records");
  EXPECT_EQ(out["worst"][0], (Json{{"record", 2}}));
  EXPECT_EQ(out["known"], "a reason");
  EXPECT_FALSE(out.contains("width"));
}

/// Keys as the document writes them: those of a section's objects, "passes[].cases[].id", and of the objects that these
/// hold, "device.api".
void add_keys(const Json& j, const std::string& prefix, std::set<std::string>& keys) {
  if (j.is_array()) {
    for (const Json& element : j) add_keys(element, prefix + "[]", keys);
    return;
  }
  if (!j.is_object()) return;
  for (const auto& [key, value] : j.items()) {
    const std::string path = prefix.empty() ? key : prefix + "." + key;
    const bool has_own_row = !value.is_object() && !(value.is_array() && !value.empty() && value[0].is_object());
    if (has_own_row) keys.insert(path);
    add_keys(value, path, keys);
    if (value.is_array()) keys.insert(path);
  }
}
std::set<std::string> documented_keys() {
  std::istringstream document(contents(std::filesystem::path(rainref::test::source_folder()) / "docs/reports.md"));
  std::set<std::string> keys;
  std::string prefix;
  bool is_json = false;
  for (std::string line; std::getline(document, line);) {
    if (line.starts_with("## ")) is_json = line == "## JSON";
    if (!is_json) continue;
    if (line.starts_with("### `")) {
      prefix = line.substr(5, line.find('`', 5) - 5);
      prefix = prefix == "." ? "" : prefix + ".";
    }
    if (!line.starts_with("| `")) continue;
    const std::string cell = line.substr(2, line.find(" |", 2) - 2);
    for (std::size_t at = 0; (at = cell.find('`', at)) != std::string::npos;) {
      const std::size_t end = cell.find('`', at + 1);
      keys.insert(prefix + cell.substr(at + 1, end - at - 1));
      at = end + 1;
    }
  }
  return keys;
}

TEST(ReportJson, QuantitiesAndWhatWasNotJudged) {
  PortJudgement j = example_judgement();
  QuantityJudgement q{"y", "m/s", 4, 40, 2, 5, 6, 1, 11, 12, 0.25, 0.5, std::numeric_limits<double>::infinity()};
  j.passes[0].cases[0].outputs[0].quantities = {q};
  j.passes.push_back(example_pass("display", Status::not_judged, {}));
  j.files = {{ExitCode::io, "wave", "rain.wave/0001.0", "out.height", "cannot be read"}};
  const Json out = Json::parse(report_json(j, 4, {}));
  EXPECT_EQ(out["passes"][0]["cases"][0]["outputs"][0]["quantities"], (Json{{{"name", "y"},
                                                                             {"unit", "m/s"},
                                                                             {"extent", 4.0},
                                                                             {"elements", 40},
                                                                             {"failing", 2},
                                                                             {"vacuous", 5},
                                                                             {"loose", 6},
                                                                             {"free", 1},
                                                                             {"sampled", 39},
                                                                             {"median_codes", 11.0},
                                                                             {"p99_codes", 12.0},
                                                                             {"median_width", 0.25},
                                                                             {"p99_width", 0.5},
                                                                             {"farthest", nullptr}}}));
  EXPECT_EQ(out["not_judged"], (Json{"display"}));
  EXPECT_EQ(out["passes"][4]["status"], "NOT JUDGED");
  EXPECT_EQ(
      out["files"],
      (Json{{{"pass", "wave"}, {"case", "rain.wave/0001.0"}, {"buffer", "out.height"}, {"exit_code", 4}, {"error", "cannot be read"}}}));
  const Json& worst = out["passes"][3]["cases"][0]["outputs"][0]["worst"];
  EXPECT_EQ(worst[0]["value_distance"], nullptr);  // a NaN
  EXPECT_EQ(worst[1]["value_distance"], 3 * 0x1p-10);
}

// The keys are those of a real judgement: shade upside down, a drop that is moved, a texel of the water that is no number, a
// file that is missing.
TEST(ReportJson, TheDocumentNamesEveryKeyAndNoOther) {
  const TemporaryFolder folder;
  const capture::Pack pack(small_pack("puddle-corrected"));
  write_port(pack, folder.path(), [](const capture::PackCase& c, const std::string&, capture::Array& a) {
    if (c.pass == "shade") flip_rows(a);
    if (c.pass == "raindrops") a.levels[0].edit()[1] ^= std::byte{1};
    if (c.pass == "wave_step") a.levels[0].edit()[1] = std::byte{0x7e};
  });
  std::filesystem::remove(folder / "puddle.display/0012.0/out.picture.npy");
  put(folder / "port.json", R"({"api": "Vulkan", "device": "none", "driver": "1"})");
  const parallel::Executor executor;
  ValidateOptions options;
  options.executor = &executor;
  options.explain = faults::diagnose;
  const PortJudgement j = validate(pack, folder.path(), options);
  PageSource source;
  source.edges = pack.edges;
  source.sentences["shade"] = "what it does";
  const Json json = Json::parse(report_json(j, 1, source));
  std::set<std::string> keys;
  add_keys(json, "", keys);
  const std::set<std::string> named = documented_keys();
  std::vector<std::string> undocumented, unwritten;
  std::set_difference(keys.begin(), keys.end(), named.begin(), named.end(), std::back_inserter(undocumented));
  std::set_difference(named.begin(), named.end(), keys.begin(), keys.end(), std::back_inserter(unwritten));
  EXPECT_THAT(undocumented, testing::IsEmpty());
  EXPECT_THAT(unwritten, testing::IsEmpty());

  // The first word of the first drop is its x, one step in 256 aside.
  const Json& drop = json["passes"][0]["cases"][0]["outputs"][0]["worst"][0];
  EXPECT_EQ(drop["record"], 0);
  EXPECT_EQ(drop["field"], "x");
  EXPECT_EQ(drop["distance"], 256);
  EXPECT_EQ(drop["low"], drop["high"]);
  EXPECT_NE(drop["low"], drop["got"]);
}

}  // namespace
}  // namespace rainref::reports
