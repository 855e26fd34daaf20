// JSON from anywhere: what is too long or too deep is refused before anything is made of it.
#include "capture/json_read.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error_of.h"
#include "base/temporary_folder.h"

namespace rainref::capture {
namespace {

using testing::StartsWith;

std::string refusal(const std::string& text, const JsonLimits& limits = small_json) {
  return error_of([&] { parse_json(text, "x.json", limits); });
}

TEST(JsonRead, ReadsValuesInTheirOrder) {
  const nlohmann::ordered_json json = parse_json(R"({"b": [1, {"c": null}], "a": "\u00fc"})", "x.json", small_json);
  EXPECT_EQ(json.dump(), "{\"b\":[1,{\"c\":null}],\"a\":\"\xc3\xbc\"}");
  EXPECT_EQ(parse_json("[1]", "x.json", small_json).size(), 1u);
}

TEST(JsonRead, DepthAndSizeAreBounded) {
  const auto nested = [](int count) {
    return std::string(static_cast<std::size_t>(count), '[') + "1" + std::string(static_cast<std::size_t>(count), ']');
  };
  for (const JsonLimits& limits : {small_json, large_json}) {
    EXPECT_EQ(refusal(nested(limits.depth), limits), "none");
    for (const int more : {1, 100, 300000})
      EXPECT_EQ(refusal(nested(limits.depth + more), limits), "3 x.json: nested deeper than " + std::to_string(limits.depth));
  }
  EXPECT_EQ(refusal("[\"" + std::string(small_json.bytes, 'x') + "\"]"), "3 x.json: 1048580 bytes; expected at most 1048576");
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "long.json";
  put(file, "");
  std::filesystem::resize_file(file, std::uintmax_t{1} << 40);  // no machine has the memory
  EXPECT_EQ(error_of([&] { read_json(file, "x", small_json); }),
            "3 '" + file.string() + "': 1099511627776 bytes; expected at most 1048576");
  EXPECT_THAT(error_of([&] { read_json(folder / "none", "x", small_json); }), StartsWith("4 cannot read "));
}

TEST(JsonRead, OtherTextsAreRefusedWithTheirPlace) {
  EXPECT_THAT(refusal("{\n \"a\": 1,\n}"), StartsWith("3 x.json: not JSON: line 3, column 1: "));
  EXPECT_THAT(refusal(""), StartsWith("3 x.json: not JSON: "));
  EXPECT_THAT(refusal("{} x"), StartsWith("3 x.json: not JSON: "));
  EXPECT_THAT(refusal("{\"a\": \"\xff\"}"), StartsWith("3 x.json: not JSON: "));
  EXPECT_EQ(refusal("{\"a\": {\"b\": 1, \"b\": 2}}"), "3 x.json: key 'b' appears twice");
  EXPECT_EQ(refusal("{\"a\": 1, \"b\": {\"a\": 1}}"), "none") << "in another object";
  EXPECT_EQ(refusal("[[[", {10, 1, ExitCode::usage}), "2 x.json: nested deeper than 1");
}

}  // namespace
}  // namespace rainref::capture
