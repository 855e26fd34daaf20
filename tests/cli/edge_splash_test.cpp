// edge_splash on files: what runs, what is doubted, what is refused.
#include <cmath>

#include "cli/support.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr int width = 24, height = 16;

class EdgeSplashFiles : public CommandLine {
 protected:
  EdgeSplashFiles() {
    Image colour(Format::rgba8, width, height), noise(Format::rgba8, 8, 8), depth(Format::r32f, width, height);
    for (int y = 0; y < height; ++y) {
      for (int i = 0; i < 4 * width; ++i) colour.row<std::uint8_t>(y)[i] = static_cast<std::uint8_t>(i % 4 == 3 ? 255 : 60 + y);
      for (int x = 0; x < width; ++x) depth.row<float>(y)[x] = y < height / 2 ? 40.0f : 2.0f;  // top row first: far above near
    }
    for (int y = 0; y < 8; ++y) {
      for (int i = 0; i < 32; ++i) noise.row<std::uint8_t>(y)[i] = static_cast<std::uint8_t>(y == 7 ? 250 : 10);  // a step at the seam
    }
    image_io::write_png(folder / "colour.png", colour);
    image_io::write_png(folder / "noise.png", noise);
    image_io::write_exr(folder / "depth.exr", {{"", {"Y"}, &depth}});
    put_npy("depth.npy", depth);
    put(folder / "files.toml", text("scene.depth_image = 'depth.exr'"));
    before = folder.names();
  }
  static std::string text(const std::string& line) {
    return "effect = 'edge_splash'\nvariant = 'corrected'\nrun.frames = 2\nscene.source = 'files'\nscene.image = 'colour.png'\nscene.depth_encoding = 'metres'\n" + line + "\n";
  }
  void put_npy(const std::string& name, const Image& depth) const {
    std::string header = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}), }}", depth.height(), depth.width());
    header.resize(118 - 1, ' ');
    header += '\n';
    std::string bytes = std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header;
    for (int y = 0; y < depth.height(); ++y) bytes.append(reinterpret_cast<const char*>(depth.row_bytes(y)), static_cast<std::size_t>(depth.width()) * 4);
    put(folder / name, bytes);
  }
};

TEST_F(EdgeSplashFiles, ExrAndNpyAreTheSameDepth) {
  const auto exr = hash({"files.toml"});
  EXPECT_EQ(exr.size(), 2u * 5 + 1);
  EXPECT_EQ(hash({"files.toml", "--set", "scene.depth_image=depth.npy"}), exr);
  EXPECT_NE(hash({"files.toml", "--set", "edge_splash.edge_step=50"}), exr);
}

TEST_F(EdgeSplashFiles, ASplashIsSeenOnTheEdge) {
  const Outcome o = rainref({"run", "files.toml", "-o", "out", "--set", "edge_splash.rain_drop_scale=0", "--set", "edge_splash.drop_color=[1,0,0]", "--image", "none", "--capture", "all"});
  ASSERT_EQ(o.code, 0) << o.err;
  std::string edge;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "out")) {
    if (entry.path().filename() == "out.edge.npy") edge = contents(entry.path());
  }
  ASSERT_GT(edge.size(), static_cast<std::size_t>(width) * height);
  const std::string mask = edge.substr(edge.size() - width * height);
  // Row 0 is the bottom: near rows 0 to 7, the edge between 7 and 8.
  EXPECT_EQ(static_cast<unsigned char>(mask[8 * width + 5]), 255);
  EXPECT_EQ(mask[2 * width + 5], 0);
  EXPECT_EQ(mask[13 * width + 5], 0);
}

TEST_F(EdgeSplashFiles, ANoiseMapThatDoesNotTileIsAWarning) {
  const Outcome o = rainref({"hash", "files.toml", "--set", "scene.noise_image=noise.png"});
  EXPECT_EQ(o.code, 0);
  EXPECT_THAT(o.err, AllOf(HasSubstr("rainref: warning: scene.noise_image does not tile"), HasSubstr("seams")));
}

TEST_F(EdgeSplashFiles, WhatIsMissingOrDoesNotFitIsNamed) {
  const auto with = [](std::vector<std::string> sets) {
    std::vector<std::string> all{"run", "files.toml", "-o", "new/deep"};
    for (std::string& s : sets) {
      all.push_back("--set");
      all.push_back(std::move(s));
    }
    return all;
  };
  expect_refusal(with({"scene.depth_image="}), 2, HasSubstr("scene.depth_image: expected a file, because scene.source is \"files\""));
  expect_refusal(with({"scene.source=shapes"}), 2, HasSubstr("scene.image: needs scene.source = \"files\", found \"shapes\""));
  expect_refusal(with({"scene.depth_image=noise.png"}), 2, HasSubstr("scene.depth_image: expected 24x16 texels as scene.image has, found 8x8"));
  expect_refusal(with({"scene.layer_image=noise.png"}), 2, HasSubstr("scene.layer_image: expected 24x16"));
  expect_refusal(with({"scene.depth_encoding=device"}), 2, AllOf(HasSubstr("scene.depth_image: expected device depths from 0 to 1, found 2 at column 0, row 0")));
  expect_refusal(with({"scene.far=30"}), 2, HasSubstr("found 40 at column 0, row 8 from the bottom"));
  expect_refusal(with({"scene.near=9", "scene.far=3"}), 2, HasSubstr("scene.near, scene.far: expected 0 < near < far, found 9 and 3"));
  expect_refusal(with({"scene.depth_image=nowhere.npy"}), 4, HasSubstr("nowhere.npy"));
  expect_refusal(with({"edge_splash.bend=1"}), 2, HasSubstr("edge_splash.band"));
}

TEST_F(EdgeSplashFiles, DamagedNpyIsNamed) {
  put(folder / "bad.npy", contents(folder / "depth.npy").substr(0, 200));
  put(folder / "text.npy", "not an array");
  Image holed(Format::r32f, width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) holed.row<float>(y)[x] = x == 3 && y == 2 ? std::nanf("") : 5.0f;
  }
  put_npy("holed.npy", holed);
  before = folder.names();
  for (const auto& [file, message] : std::vector<std::pair<std::string, std::string>>{{"bad.npy", "bad.npy"}, {"text.npy", "text.npy"}, {"holed.npy", "expected finite numbers, found nan at column 3, row 2"}}) {
    expect_refusal({"run", "files.toml", "-o", "new", "--set", "scene.depth_image=" + file}, 2, AllOf(HasSubstr("scene.depth_image: "), HasSubstr(message)));
  }
}

}  // namespace
}  // namespace rainref::cli
