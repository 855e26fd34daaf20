// Packs that are not as they should be: each is refused with one message that names the file and what is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "capture/example_capture.h"
#include "capture/npy_write.h"
#include "capture/pack_read.h"

namespace rainref::capture {
namespace {

using nlohmann::ordered_json;
using testing::HasSubstr;

class DamagedPack : public testing::Test {
 protected:
  DamagedPack() { write_example(pack()); }
  std::filesystem::path pack() const { return folder / "pack"; }

  ordered_json manifest() const { return ordered_json::parse(contents(pack() / "manifest.json")); }
  void put_manifest(const ordered_json& m) const { put(pack() / "manifest.json", m.dump()); }
  /// The error of reading all of the pack.
  std::string error() const {
    return error_of([&] {
      const Pack read(pack());
      for (const PackCase& c : read.cases) read.read(c);
    });
  }
  /// The error after one value of the manifest became another.
  std::string error_with(const std::string& pointer, const ordered_json& value) const {
    const ordered_json whole = manifest();
    ordered_json changed = whole;
    changed[ordered_json::json_pointer(pointer)] = value;
    put_manifest(changed);
    const std::string e = error();
    put_manifest(whole);
    return e;
  }
  std::string error_without(const std::string& pointer, const std::string& key) const {
    const ordered_json whole = manifest();
    ordered_json changed = whole;
    changed[ordered_json::json_pointer(pointer)].erase(key);
    put_manifest(changed);
    const std::string e = error();
    put_manifest(whole);
    return e;
  }
  std::string in_manifest(const std::string& what) const { return fmt::format("3 {}: {}", (pack() / "manifest.json").string(), what); }
  std::string in_file(const std::string& file, const std::string& what) const {
    return fmt::format("3 {}: {}", (pack() / file).string(), what);
  }

  void write_again() const {
    std::filesystem::remove_all(pack());
    write_example(pack());
  }

  TemporaryFolder folder;
};

TEST_F(DamagedPack, TheExampleIsWhole) { EXPECT_EQ(error(), "none"); }

TEST_F(DamagedPack, NoFolderOrNoManifest) {
  EXPECT_EQ(error_of([&] { Pack(folder / "none"); }), "4 " + (folder / "none").string() + ": there is no such folder");
  EXPECT_EQ(error_of([&] { Pack(pack() / "manifest.json"); }),
            "4 " + (pack() / "manifest.json").string() + ": expected a pack's folder, found a file");
  std::filesystem::remove(pack() / "manifest.json");
  EXPECT_EQ(error(), "3 " + pack().string() + ": no pack: there is no manifest.json");
  std::filesystem::create_directory(folder / "run");
  std::filesystem::create_directory(folder / "run/capture");
  put(folder / "run/capture/manifest.json", "{}");
  EXPECT_EQ(error_of([&] { Pack(folder / "run"); }),
            fmt::format("3 {0}: no pack: there is no manifest.json (there is one in '{0}/capture')", (folder / "run").string()));
}

TEST_F(DamagedPack, NoJson) {
  put(pack() / "manifest.json", "{\"format\": ");
  EXPECT_THAT(error(), testing::StartsWith(in_manifest("not JSON: line 1, column 12")));
  put(pack() / "manifest.json", "");
  EXPECT_THAT(error(), testing::StartsWith(in_manifest("not JSON: ")));
  put(pack() / "manifest.json", "[1]");
  EXPECT_EQ(error(), in_manifest("expected an object, found an array"));
  put(pack() / "manifest.json", std::string(200000, '['));  // deep, and never closed
  EXPECT_EQ(error(), in_manifest("nested deeper than 16"));
}

TEST_F(DamagedPack, OtherFormatsAndNewerVersions) {
  EXPECT_EQ(error_with("/format", "gltf"), in_manifest("this is no manifest of a pack: expected \"format\": \"rainref.pack\""));
  EXPECT_EQ(error_without("", "format"), in_manifest("this is no manifest of a pack: expected \"format\": \"rainref.pack\""));
  EXPECT_EQ(error_with("/version", 2), in_manifest("version 2 is newer than this rainref reads, which is 1"));
  EXPECT_EQ(error_with("/version", 0), in_manifest("version: expected a whole number from 1 to 2147483647, found 0"));
  EXPECT_EQ(error_with("/version", "1"), in_manifest("version: expected a whole number from 1 to 2147483647, found \"1\""));
}

TEST_F(DamagedPack, MissingAndMistypedKeys) {
  EXPECT_EQ(error_without("", "effect"), in_manifest("'effect' is missing"));
  EXPECT_EQ(error_without("/cases/1", "step"), in_manifest("cases[1]: 'step' is missing"));
  EXPECT_EQ(error_without("/cases/1/inputs/0", "file"), in_manifest("cases[1].inputs[0]: 'file' is missing"));
  EXPECT_EQ(error_with("/cases", 3), in_manifest("cases: expected an array, found 3"));
  EXPECT_EQ(error_with("/cases/1/frame", 1.5), in_manifest("cases[1].frame: expected a whole number from 0 to 2147483647, found 1.5"));
  EXPECT_EQ(error_with("/cases/1/pass", "blurr"),
            in_manifest("cases[1].pass: expected one of drip, blur, found 'blurr'; did you mean 'blur'?"));
  EXPECT_EQ(error_with("/cases/1/outputs/0/judge", "bit"),
            in_manifest("cases[1].outputs[0].judge: expected one of envelope, bits, keyed, input_only, found 'bit'; did you mean 'bits'?"));
  EXPECT_EQ(error_with("/cases/1/inputs/0/address_u", "wrap"),
            in_manifest("cases[1].inputs[0].address_u: expected one of clamp, repeat, mirror, border, found 'wrap'"));
  EXPECT_EQ(error_with("/cases/1/inputs/0/format", "rg16"),
            in_manifest("cases[1].inputs[0].format: unknown format 'rg16'; did you mean 'rg16f'?"));
  EXPECT_EQ(error_with("/cases/1/time/bits", "0x12"),
            in_manifest("cases[1].time.bits: expected eight hexadecimal digits behind 0x, found \"0x12\""));
  EXPECT_EQ(error_with("/cases/1/uniform_block/bytes", 20),
            in_manifest("cases[1].uniform_block.bytes: expected the 16 bytes of BlurUniforms, found 20"));
  EXPECT_EQ(error_with("/records/0/members/1/offset", 8),
            in_manifest("records[0].members[1].offset: the member ends beyond the 8 bytes of DripRecord"));
}

TEST_F(DamagedPack, GiganticSizes) {
  EXPECT_EQ(error_with("/cases/1/inputs/0/width", 1000000000),
            in_manifest("cases[1].inputs[0].width: expected a whole number from 1 to 65536, found 1000000000"));
  EXPECT_EQ(error_with("/cases/1/inputs/0/width", 18446744073709551615u),
            in_manifest("cases[1].inputs[0].width: expected a whole number from 1 to 65536, found 18446744073709551615"));
  // Within the range, but the file is not so long: nothing of that size is asked for.
  EXPECT_THAT(error_with("/cases/1/inputs/0/width", 65536),
              HasSubstr("in.picture.npy: expected type <f2 and shape (3, 65536, 2), found '<f2' and (3, 5, 2)"));
  EXPECT_THAT(error_with("/cases/1/inputs/0/bytes", 1099511627776),
              HasSubstr("in.picture.npy: damaged: expected 1099511627776 bytes, found 188"));
  EXPECT_THAT(error_with("/cases/2/outputs/0/count", 2147483647), HasSubstr("out.drips.npy: expected 2147483647 records"));
  EXPECT_EQ(error_with("/cases/1/inputs/2/levels", 18),
            in_manifest("cases[1].inputs[2].levels: expected a whole number from 1 to 17, found 18"));
}

TEST_F(DamagedPack, PathsThatLeaveTheFolder) {
  for (const std::string path : {"../x.npy", "/etc/passwd", "a/../../x", "./a", "", "a\\b"}) {
    EXPECT_EQ(error_with("/cases/1/inputs/0/file", path),
              in_manifest(fmt::format("cases[1].inputs[0].file: expected the path of a file below the pack's folder, found {}",
                                      ordered_json(path).dump())));
  }
  put(folder / "outside.npy", contents(pack() / "puddle.blur/0000.0/out.picture.npy"));
  std::filesystem::remove(pack() / "puddle.blur/0000.0/out.picture.npy");
  std::filesystem::create_symlink(folder / "outside.npy", pack() / "puddle.blur/0000.0/out.picture.npy");
  EXPECT_EQ(error(), in_file("puddle.blur/0000.0/out.picture.npy", "the file lies outside the pack"));
}

TEST_F(DamagedPack, FilesThatAreMissingOrChanged) {
  const std::string name = "puddle.blur/0000.1/out.picture.npy", whole = contents(pack() / name);
  std::string flipped = whole;
  flipped.back() = static_cast<char>(flipped.back() ^ 1);
  put(pack() / name, flipped);
  EXPECT_THAT(error(), testing::MatchesRegex(".*out.picture.npy: damaged: expected hash [0-9a-f]{32}, found [0-9a-f]{32}"));
  put(pack() / name, whole.substr(0, whole.size() - 1));
  EXPECT_EQ(error(), in_file(name, fmt::format("damaged: expected {} bytes, found {}", whole.size(), whole.size() - 1)));
  std::filesystem::remove(pack() / name);
  EXPECT_EQ(error(), in_file(name, "the manifest names this file, but it is missing"));
  std::filesystem::create_directory(pack() / name);
  EXPECT_EQ(error(), in_file(name, "the manifest names this file, but it is missing"));
}

// A file that agrees with its hash but not with what the manifest says of it.
TEST_F(DamagedPack, ArraysThatAreSomethingElse) {
  EXPECT_THAT(error_with("/cases/1/outputs/0/width", 4), HasSubstr("expected type <f2 and shape (3, 4, 2), found '<f2' and (3, 5, 2)"));
  ordered_json m = manifest();
  m["cases"][2]["outputs"][0] = m["cases"][1]["outputs"][0];
  m["cases"][2]["outputs"][0]["format"] = "records";
  m["cases"][2]["outputs"][0]["record"] = "DripRecord";
  m["cases"][2]["outputs"][0]["count"] = 1;
  m["cases"][2]["outputs"][0]["judge"] = "bits";
  put_manifest(m);
  EXPECT_THAT(error(), HasSubstr("out.picture.npy: expected records DripRecord of 2 fields and 8 bytes"));
}

TEST_F(DamagedPack, CasesUnderAnotherName) {
  EXPECT_EQ(error_with("/cases/1/id", "puddle.blur/0009.0"),
            in_manifest("cases[1].id: expected 'puddle.blur/0000.0', found 'puddle.blur/0009.0'"));
  ordered_json m = manifest();
  m["cases"].push_back(m["cases"][0]);
  put_manifest(m);
  EXPECT_EQ(error(), in_manifest("cases[8].id: 'puddle.drip/0000.0' is there twice"));
}

// Judged against nothing, a port would pass or fail by nothing.
TEST_F(DamagedPack, NoCasesAndCasesWithoutOutputs) {
  EXPECT_EQ(error_with("/cases", ordered_json::array()), in_manifest("cases: expected one run of a pass or more, found none"));
  EXPECT_EQ(error_with("/cases/1/outputs", ordered_json::array()),
            in_manifest("cases[1].outputs: expected one output or more, found none"));
}

// An output that its rule cannot judge would pass unseen, or break the judge.
TEST_F(DamagedPack, RulesThatDoNotFitTheirOutput) {
  EXPECT_EQ(error_with("/cases/0/outputs/0/judge", "envelope"),
            in_manifest("cases[0].outputs[0].judge: expected bits, keyed or input_only for records, found \"envelope\""));
  EXPECT_EQ(
      error_with("/cases/1/outputs/0/judge", "keyed"),
      in_manifest(
          "cases[1].outputs[0].judge: expected bits, envelope or input_only for what is no list of records with a uint 'id' or of floats "
          "alone, found \"keyed\""));
  EXPECT_EQ(error_with("/cases/0/outputs/0/judge", "keyed"), "none");
}

// One manifest would say three things of a uniform: a value, its bits, and a file.
TEST_F(DamagedPack, UniformsUnlikeTheirFileOrTheirBits) {
  ordered_json m = manifest();
  m["cases"][1]["uniforms"][1]["value"] = 7;
  m["cases"][1]["uniforms"][1]["bits"] = "0x00000007";
  put_manifest(m);
  const std::string file = m["cases"][1]["uniform_block"]["file"];
  EXPECT_EQ(error(), in_file(file, "puddle.blur/0000.0: uniform reach: expected 7 0x00000007 as the manifest says, found -3 0xfffffffd"));
  write_again();
  EXPECT_EQ(error_with("/cases/1/uniforms/0/value", 0.75),
            in_manifest("cases[1].uniforms[0].value: expected 0.5 0x3f000000, as its bits say, found 0.75"));
  EXPECT_EQ(error_with("/cases/1/uniforms/0/value", nullptr),
            in_manifest("cases[1].uniforms[0].value: expected 0.5 0x3f000000, as its bits say, found null"));
  EXPECT_EQ(error_with("/cases/1/uniforms/1/value", 3),
            in_manifest("cases[1].uniforms[1].value: expected -3 0xfffffffd, as its bits say, found 3"));
  EXPECT_EQ(error_with("/cases/1/uniforms/2/value", -2147483648),
            in_manifest("cases[1].uniforms[2].value: expected 2147483648 0x80000000, as its bits say, found -2147483648"));
  EXPECT_EQ(error_with("/cases/1/dt/value", 0.5), in_manifest("cases[1].dt.value: expected 0.25 0x3e800000, as its bits say, found 0.5"));
}

}  // namespace
}  // namespace rainref::capture
