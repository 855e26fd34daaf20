// Packs written and read back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "capture/example_capture.h"
#include "capture/pack_read.h"

namespace rainref::capture {
namespace {

using nlohmann::json;
using testing::ElementsAre;

class PackFolder : public testing::Test {
 protected:
  std::filesystem::path pack() const { return folder / "pack"; }
  json manifest() const { return json::parse(contents(pack() / "manifest.json")); }
  TemporaryFolder folder;
};

void expect_same(const Array& a, const Array& b) {
  EXPECT_EQ(a.is_records, b.is_records);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.levels, b.levels);
  if (a.is_records)
    EXPECT_EQ(a.record.name, b.record.name);
  else
    EXPECT_EQ(a.format, b.format);
}

TEST_F(PackFolder, ReadsBackAsItWasWritten) {
  write_example(pack());
  const Pack read(pack());
  EXPECT_EQ(read.effect, "puddle");
  EXPECT_EQ(read.variant, "corrected");
  EXPECT_EQ(read.scene, "x.toml");
  EXPECT_TRUE(read.with_inputs);
  EXPECT_EQ(read.file_beside(), "");
  EXPECT_EQ(read.pass("blur").formula, "puddle.blur.corrected/2");
  EXPECT_EQ(read.pass("drip").block.members.size(), 3u);
  const std::vector<PassCase> cases = example_cases();
  ASSERT_EQ(read.cases.size(), cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const PassCase a = cases[i], b = read.read(read.cases[i]);
    SCOPED_TRACE(a.folder());
    EXPECT_EQ(b.folder(), a.folder());
    EXPECT_EQ(b.effect, a.effect);
    EXPECT_EQ(b.variant, a.variant);
    EXPECT_EQ(b.time, a.time);
    EXPECT_EQ(b.dt, a.dt);
    EXPECT_EQ(b.uniforms, a.uniforms);
    ASSERT_EQ(b.inputs.size(), a.inputs.size());
    for (std::size_t k = 0; k < a.inputs.size(); ++k) {
      EXPECT_EQ(b.inputs[k].name, a.inputs[k].name);
      expect_same(a.inputs[k].array, b.inputs[k].array);
      if (a.inputs[k].array.is_records) continue;
      EXPECT_EQ(b.inputs[k].address_u, a.inputs[k].address_u);
      EXPECT_EQ(b.inputs[k].address_v, a.inputs[k].address_v);
      EXPECT_EQ(b.inputs[k].border, a.inputs[k].border);
      EXPECT_EQ(b.inputs[k].linear, a.inputs[k].linear);
      EXPECT_EQ(b.inputs[k].filter, a.inputs[k].filter);
      EXPECT_EQ(b.inputs[k].mip_filter, a.inputs[k].mip_filter);
    }
    ASSERT_EQ(b.outputs.size(), a.outputs.size());
    for (std::size_t k = 0; k < a.outputs.size(); ++k) {
      EXPECT_EQ(b.outputs[k].store_rounding, a.outputs[k].store_rounding);
      EXPECT_EQ(b.outputs[k].judge, a.outputs[k].judge);
      expect_same(a.outputs[k].array, b.outputs[k].array);
    }
  }
}

TEST_F(PackFolder, EqualInputsAreStoredOnceAndOutputsAlways) {
  write_example(pack());
  const json m = manifest();
  const auto file = [&](std::size_t c, const char* of, std::size_t k) { return m["cases"][c][of][k]["file"].get<std::string>(); };
  EXPECT_EQ(file(1, "inputs", 0), "puddle.blur/0000.0/in.picture.npy");
  EXPECT_EQ(file(3, "inputs", 0), "puddle.blur/0000.0/out.picture.npy");  // the result of the step before
  EXPECT_EQ(file(3, "inputs", 2), "puddle.blur/0000.0/in.sky.npy");       // the same sky
  EXPECT_EQ(file(3, "inputs", 1), "puddle.drip/0000.1/out.drips.npy");
  EXPECT_EQ(file(4, "outputs", 0), "puddle.drip/0001.0/out.drips.npy");  // equal to that of 0000.1
  EXPECT_EQ(m["cases"][1]["inputs"][2]["mips"][1]["file"], "puddle.blur/0000.0/in.sky.L2.npy");
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(pack())) {
    if (entry.is_regular_file()) files.insert(std::filesystem::relative(entry.path(), pack()));
  }
  EXPECT_EQ(files.size(), 1u + 8 + 1 + 3 + 1);  // manifest, outputs, first picture, levels of the sky, one uniform block
}

TEST_F(PackFolder, TheTotalIsWhatLiesThere) {
  const PackWriter::Total total = write_example(pack());
  std::size_t bytes = 0;
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(pack())) {
    if (!entry.is_regular_file()) continue;
    bytes += entry.file_size();
    ++files;
  }
  EXPECT_EQ(total.cases, 8);
  EXPECT_EQ(total.files, files);
  EXPECT_EQ(total.bytes, bytes);
}

// Every key that the format asks for.
TEST_F(PackFolder, TheManifestHasEveryKey) {
  write_example(pack());
  const json m = manifest();
  EXPECT_EQ(m["format"], "rainref.pack");
  EXPECT_EQ(m["version"], 1);
  EXPECT_EQ(m["seed"], 5);
  EXPECT_EQ(m["config"]["effect"], "puddle");
  for (const char* key : {"row0", "texel_centre", "endian", "y_up", "handedness", "matrix", "depth", "time"})
    EXPECT_TRUE(m["conventions"].contains(key)) << key;
  EXPECT_EQ(m["graph"]["passes"], (std::vector<std::string>{"drip", "blur"}));
  EXPECT_EQ(m["graph"]["edges"][0], (json{{"pass", "blur"}, {"input", "picture"}, {"from", "blur"}, {"run", "previous"}}));
  EXPECT_EQ(m["graph"]["edges"][1], (json{{"pass", "blur"}, {"input", "drips"}, {"from", "drip"}, {"run", "this"}}));
  EXPECT_EQ(m["graph"]["edges"][2], (json{{"pass", "blur"}, {"input", "sky"}, {"from", "host"}}));
  EXPECT_EQ(m["graph"]["ping_pong"], json::array({{{"pass", "blur"}, {"buffer", "picture"}}}));
  for (const char* key : {"formula", "reads", "writes", "uniform_block", "independence"}) EXPECT_TRUE(m["passes"][1].contains(key)) << key;
  const json& c = m["cases"][1];
  for (const char* key : {"id", "pass", "frame", "step", "level", "dt", "time", "uniforms", "uniform_block", "inputs", "outputs"})
    EXPECT_TRUE(c.contains(key)) << key;
  EXPECT_EQ(c["dt"], (json{{"value", 0.25}, {"bits", "0x3e800000"}}));
  EXPECT_EQ(c["uniforms"][0], (json{{"name", "weight"}, {"type", "float"}, {"value", 0.5}, {"bits", "0x3f000000"}}));
  EXPECT_EQ(c["uniforms"][1], (json{{"name", "reach"}, {"type", "int"}, {"value", -3}, {"bits", "0xfffffffd"}}));
  EXPECT_EQ(c["uniforms"][2], (json{{"name", "mask"}, {"type", "uint"}, {"value", 0x80000000u}, {"bits", "0x80000000"}}));
  for (const json& input : {c["inputs"][0], c["inputs"][2]}) {
    for (const char* key :
         {"name",       "file",       "format",      "width", "height",        "channels",  "levels",    "channel_meaning", "unit",
          "range",      "encoding",   "color_space", "alpha", "address_u",     "address_v", "address_w", "border",          "min_filter",
          "mag_filter", "mip_filter", "coordinates", "lod",   "out_of_bounds", "bytes",     "xxh3"}) {
      EXPECT_TRUE(input.contains(key)) << key;
    }
  }
  EXPECT_EQ(c["inputs"][0]["border"], (std::vector<double>{0.5, 0.25, 0, 0}));
  EXPECT_EQ(c["inputs"][0]["coordinates"], "texel");
  EXPECT_EQ(c["inputs"][2]["coordinates"], "normalized");
  EXPECT_EQ(c["inputs"][2]["lod"], "explicit");
  EXPECT_EQ(c["inputs"][2]["orientation"], "row 0 looks down");
  for (const char* key : {"name", "file", "format", "store_rounding", "overflow", "written", "prior", "blend", "order_free_sums", "nan",
                          "judge", "bytes", "xxh3"}) {
    EXPECT_TRUE(c["outputs"][0].contains(key)) << key;
  }
  EXPECT_EQ(c["outputs"][0]["store_rounding"], "rtz");
  EXPECT_EQ(c["outputs"][0]["overflow"], "largest");
}

TEST_F(PackFolder, HashesAreThoseOfTheFiles) {
  write_example(pack());
  const json file = manifest()["cases"][1]["outputs"][0];
  const std::string bytes = contents(pack() / file["file"].get<std::string>());
  EXPECT_EQ(file["bytes"], bytes.size());
  EXPECT_EQ(file["xxh3"], file_hash(std::as_bytes(std::span(bytes))).text());
}

TEST_F(PackFolder, ACaptureOfOutputsHoldsNoInputs) {
  write_example(pack(), false);
  const Pack read(pack());
  EXPECT_FALSE(read.with_inputs);
  for (const PackCase& c : read.cases) {
    EXPECT_TRUE(c.inputs.empty());
    EXPECT_EQ(read.read(c).outputs.size(), 1u);
  }
}

TEST_F(PackFolder, TwiceGivesTheSameBytes) {
  write_example(pack());
  const std::string first = contents(pack() / "manifest.json");
  write_example(pack());  // replaces the one there
  EXPECT_EQ(contents(pack() / "manifest.json"), first);
  EXPECT_THAT(folder.names(), ElementsAre("pack"));
}

TEST_F(PackFolder, NothingButAPackIsReplaced) {
  write_example(pack());
  put(pack() / "puddle.blur/0000.0/mine.txt", "mine");
  EXPECT_EQ(
      error_of([&] { write_example(pack()); }),
      "4 cannot write '" + pack().string() + "': the pack there would be replaced, but 'puddle.blur/0000.0/mine.txt' is no part of it");
  std::filesystem::create_directory(folder / "other");
  put(folder / "other/manifest.json", "{}");
  EXPECT_EQ(error_of([&] { write_example(folder / "other"); }),
            "4 cannot write '" + (folder / "other").string() + "': the folder is not empty and no pack of rainref");
  EXPECT_EQ(contents(folder / "other/manifest.json"), "{}");
}

TEST_F(PackFolder, AWriterThatDoesNotFinishLeavesNothing) {
  {
    PackWriter writer(pack(), example_info(), example_config(), "x.toml", true, {"drip", "blur"});
    for (const PassCase& c : example_cases()) writer.add(c);
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST_F(PackFolder, AnUnknownPassNamesTheNearest) {
  write_example(pack());
  const Pack read(pack());
  EXPECT_EQ(error_of([&] { read.pass("blurr"); }),
            "2 " + pack().string() + ": expected one of the passes drip, blur, found 'blurr'; did you mean 'blur'?");
}

}  // namespace
}  // namespace rainref::capture
