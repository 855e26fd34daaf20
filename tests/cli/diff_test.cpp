// `rainref diff`.
#include "base/hash.h"
#include "capture/pack_read.h"
#include "cli/support.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

const std::vector<std::string> basin{"--set", "puddle.shape=basin"};

class DiffVerb : public CommandLine {
 protected:
  void pack(const std::vector<std::string>& arguments) const {
    // The bed of a natural puddle costs most of a second.
    const bool is_natural = arguments[0] == "corrected.toml";
    expect(copied(joined(joined({"pack"}, arguments), is_natural ? basin : std::vector<std::string>{})), 0);
  }
  /// The standard output of a comparison that must end with this code.
  std::string diff(const std::string& a, const std::string& b, int code) const {
    const Outcome o = copied({"diff", a, b});
    expect(o, code, testing::_, "");
    return o.out;
  }
  /// Changes one byte of a file's end, and its hash in the manifest.
  void change(const std::string& pack_name, const std::string& file, std::size_t from_end) const {
    std::string bytes = contents(folder / pack_name / file);
    const auto hash = [&] { return file_hash(std::as_bytes(std::span(bytes))).text(); };
    const std::string old = hash();
    bytes[bytes.size() - from_end] = static_cast<char>(bytes[bytes.size() - from_end] ^ 1);
    put(folder / pack_name / file, bytes);
    std::string manifest = contents(folder / pack_name / "manifest.json");
    const std::string entry = fmt::format("\"file\":\"{}\"", file);
    for (std::size_t at = 0; (at = manifest.find(entry, at)) != std::string::npos; ++at)
      manifest.replace(manifest.find(old, at), old.size(), hash());
    put(folder / pack_name / "manifest.json", manifest);
  }
};

TEST_F(DiffVerb, EqualPacks) {
  pack({"corrected.toml", "-o", "a", "--at", "0,1", "--threads", "1"});
  pack({"corrected.toml", "-o", "b", "--at", "0,1", "--threads", "3"});
  EXPECT_THAT(diff("a", "b", 0), MatchesRegex("equal: 22 runs of passes, [0-9]+ buffers\n"));
}

TEST_F(DiffVerb, NamesTheFirstElementInTheOrderOfExecution) {
  for (const std::string name : {"a", "b"})
    pack({"corrected.toml", "-o", name, "--at", "0,1", "--set", "rain.rate=200", "--set", "puddle.drop_intensity=4"});
  // Later in the run first, so that finding the last change does not pass. colour is 24 x 16 of four halves.
  change("b", "puddle.shade/0001.0/out.colour.npy", 2);
  EXPECT_THAT(diff("a", "b", 1),
              MatchesRegex("first difference: frame 1, pass shade, step 0, output colour \\(rgba16f 24x16\\), x 23, y 15, channel 3\n"
                           "  A  1 0x3c00\n  B  1.0009766 0x3c01\n  1 of 1536 elements of this buffer differ\n"));
  change("b", "puddle.surface_hit/0000.0/out.hit.npy", 4 + 16);
  EXPECT_THAT(diff("a", "b", 1),
              StartsWith("first difference: frame 0, pass surface_hit, step 0, output hit (rgba32f 24x16), x 22, y 15, channel 3\n"));
  change("b", "puddle.wave_step/0000.0/out.wave.npy", 3);
  // The wave is also the next step's input, but it was written first.
  EXPECT_THAT(diff("a", "b", 1),
              StartsWith("first difference: frame 0, pass wave_step, step 0, output wave (rg16f 40x30), x 39, y 29, channel 0\n"));
}

TEST_F(DiffVerb, AParameterShowsInTheConfigurationAndInTheUniforms) {
  pack({"corrected.toml", "-o", "a", "--at", "0"});
  pack({"corrected.toml", "-o", "b", "--at", "0", "--set", "puddle.reflectivity=0.5"});
  EXPECT_EQ(
      diff("a", "b", 1),
      "configuration: puddle.reflectivity is 1.0 in A, 0.5 in B\n"
      "first difference: frame 0, pass shade, step 0, uniform reflectivity of ShadeUniforms\n  A  1 0x3f800000\n  B  0.5 0x3f000000\n");
  pack({"corrected.toml", "-o", "c", "--at", "0", "--size", "25x16", "--passes", "display"});
  pack({"corrected.toml", "-o", "d", "--at", "0", "--passes", "display"});
  EXPECT_THAT(diff("c", "d", 1), AllOf(HasSubstr("configuration: run.size is [25,16] in A, [24,16] in B\n"),
                                       HasSubstr("input colour\n  A  rgba16f 25x16\n  B  rgba16f 24x16\n")));
}

TEST_F(DiffVerb, RunsThatOneSideLacks) {
  pack({"corrected.toml", "-o", "a", "--at", "0,1", "--passes", "shade,display"});
  pack({"corrected.toml", "-o", "b", "--at", "0", "--passes", "shade"});
  EXPECT_EQ(diff("a", "b", 1),
            "only in A: frame 0, pass display, step 0\nonly in A: frame 1, pass shade, step 0\nonly in A: frame 1, pass display, step 0\n");
  EXPECT_EQ(diff("b", "a", 1),
            "only in B: frame 0, pass display, step 0\nonly in B: frame 1, pass shade, step 0\nonly in B: frame 1, pass display, step 0\n");
}

TEST_F(DiffVerb, ACaptureOfOutputsComparesWithAPack) {
  expect(copied(joined({"run", "corrected.toml", "-o", "r", "--capture", "passes", "--image", "none"}, basin)), 0);
  pack({"corrected.toml", "-o", "p", "--at", "1"});
  EXPECT_THAT(diff("r/capture", "p", 0), StartsWith("equal: 11 runs of passes, 12 buffers\n"));
}

TEST_F(DiffVerb, DifferentScenes) {
  pack({"corrected.toml", "-o", "a", "--at", "0", "--passes", "display"});
  pack({"published.toml", "-o", "b", "--at", "0", "--passes", "display"});
  EXPECT_THAT(diff("a", "b", 1), HasSubstr("different scenes: puddle corrected in A, puddle as-published in B\n"));
}

TEST_F(DiffVerb, BadArguments) {
  pack({"corrected.toml", "-o", "a", "--at", "0", "--passes", "display"});
  pack({"corrected.toml", "-o", "b", "--at", "0", "--passes", "display"});
  before = folder.names();
  expect_refusal({"diff", "a"}, 2, HasSubstr("B is required"));
  expect_refusal({"diff", "a", "none"}, 4, "none: there is no such folder");
  expect_refusal({"diff", "a", "sky.png"}, 4, "sky.png: expected a pack's folder, found a file");
  std::filesystem::remove(folder / "b/puddle.display/0000.0/out.picture.npy");
  expect_refusal({"diff", "a", "b"}, 3, "b/puddle.display/0000.0/out.picture.npy: the manifest names this file, but it is missing");
  std::filesystem::remove(folder / "b/manifest.json");
  expect_refusal({"diff", "a", "b"}, 3, "b: no pack: there is no manifest.json");
  expect_refusal({"diff", "a", "b", "c"}, 2, HasSubstr("c"));
}

}  // namespace
}  // namespace rainref::cli
