// Files that scenes name, for tests: arrays, and pictures of a few texels.
#pragma once

#include <cmath>
#include <functional>

#include "cli/support.h"
#include "image/images.h"
#include "image_io/tiny_files.h"

namespace rainref::cli {

/// value(column, row from the top, channel) as an NPY file: '<f4', or '|u1' of codes. One channel: (height, width).
inline void put_npy(const std::filesystem::path& path, int width, int height, int channels,
                    const std::function<float(int, int, int)>& value, bool is_codes = false) {
  const std::string shape = channels == 1 ? fmt::format("({}, {})", height, width) : fmt::format("({}, {}, {})", height, width, channels);
  std::string bytes;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) {
        const float v = value(x, y, c);
        if (is_codes)
          bytes += static_cast<char>(static_cast<unsigned char>(v));
        else
          bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
      }
    }
  }
  put(path, npy(is_codes ? "'|u1'" : "'<f4'", shape, bytes));
}
/// The same as an image of rgba32f or, of codes, rgba8; a single channel in red, green and blue.
inline Image image_of(Format format, int width, int height, const std::function<float(int, int, int)>& value) {
  if (format != Format::rgba8) return make_image(format, width, height, value);
  return make_image(format, width, height, [&](int x, int y, int c) { return static_cast<std::uint8_t>(value(x, y, c)); });
}

/// What is true of a scene file whose scene.image (colour.png, 24x16) and, where it has one, scene.depth_image (depth.exr) may be
/// of any kind.
class SceneFiles : public CommandLine {
 protected:
  static constexpr int width = 24, height = 16;
  static float code(int x, int y, int c) { return c == 3 ? 255.0f : static_cast<float>(30 + 7 * x + (y * 5 + c * 40) % 60); }
  /// From the top: far above near. Whole metres, which are the codes of depth16.png.
  static float metres(int x, int y, int) { return y >= height / 2 ? 2.0f : x < 12 ? 40.0f : 42.0f; }

  SceneFiles() {
    image_io::write_png(folder / "colour.png", image_of(Format::rgba8, width, height, code), image_io::PngChannels::rgba);
    put_npy(folder / "colour.npy", width, height, 4, code, true);
    put_npy(folder / "colour3.npy", width, height, 3, code, true);
    const Image depth = image_of(Format::rgba32f, width, height, metres);
    image_io::write_exr(folder / "depth.exr", {{"", {"R", "G", "B"}, &depth}});
    put_npy(folder / "depth.npy", width, height, 1, metres);
    put_npy(folder / "small.npy", 8, 8, 1, metres);
    put_npy(folder / "below.npy", width, height, 1,
            [](int x, int y, int c) { return x == 7 && y == height - 1 - 4 ? -2.0f : metres(x, y, c); });
    put_npy(folder / "holed.npy", width, height, 1, [](int x, int y, int c) { return x == 3 && y == 2 ? std::nanf("") : metres(x, y, c); });
    put_npy(folder / "two.npy", width, height, 2, metres);
    put(folder / "cut.npy", contents(folder / "depth.npy").substr(0, 200));
    std::vector<std::string> rows;
    for (int y = 0; y < height; ++y) {
      rows.emplace_back();
      for (int x = 0; x < width; ++x) rows.back() += std::string(1, '\0') + static_cast<char>(metres(x, y, 0));
    }
    put(folder / "depth16.png", image_io::png(width, height, 16, 0, rows));
  }
  /// Run with these settings, refused with this message.
  void expect_refused(const std::string& scene, const std::vector<std::string>& sets, const testing::Matcher<const std::string&>& message,
                      int exit_code = 2) {
    std::vector<std::string> all{"run", scene, "-o", "new/deep"};
    for (const std::string& s : sets) {
      all.push_back("--set");
      all.push_back(s);
    }
    before = folder.names();
    expect_refusal(all, exit_code, message);
  }
  void expect_colours_alike(const std::string& scene) {
    const std::vector<std::string> lines = hash({scene});
    EXPECT_EQ(hash({scene, "--set", "scene.image=colour.npy"}), lines);
    EXPECT_EQ(hash({scene, "--set", "scene.image=colour3.npy"}), lines);
    EXPECT_NE(hash({scene, "--set", "display.exposure=3"}), lines);
    expect_refused(scene, {"scene.image=two.npy"},
                   testing::AllOf(testing::HasSubstr("--set scene.image: 'two.npy': expected numbers"),
                                  testing::HasSubstr("(height, width, 1, 3 or 4)")));
    expect_refused(scene, {"scene.image=nowhere.npy"}, testing::HasSubstr("--set scene.image: cannot read 'nowhere.npy'"), 4);
  }
  /// `other`: a setting under which it shows whether something lies at its depth or at less than half of it.
  void expect_depths_alike(const std::string& scene, const std::string& other = "display.exposure=2") {
    using testing::HasSubstr;
    const std::vector<std::string> lines = hash({scene});
    EXPECT_EQ(hash({scene, "--set", "scene.depth_image=depth.npy"}), lines);
    EXPECT_EQ(hash({scene, "--set", "scene.depth_image=depth16.png", "--set", "scene.depth_scale=65535"}), lines);
    EXPECT_NE(hash({scene, "--set", other, "--set", "scene.depth_scale=0.45"}), hash({scene, "--set", other}));
    expect_refused(scene, {"scene.depth_image=small.npy"},
                   HasSubstr("scene.depth_image: expected 24x16 texels as scene.image has, or another size of this shape, found 8x8"));
    expect_refused(scene, {"scene.depth_image=below.npy"},
                   HasSubstr("scene.depth_image: expected depths of 0 m or more, found -2 at column 7, row 4 from the bottom"));
    expect_refused(scene, {"scene.depth_image=holed.npy"}, HasSubstr("scene.depth_image: 'holed.npy': NaN at x 3, y 2 (from the top)"));
    expect_refused(scene, {"scene.depth_image=cut.npy"}, HasSubstr("scene.depth_image: 'cut.npy'"));
    expect_refused(scene, {"scene.depth_scale=0"}, HasSubstr("scene.depth_scale"));
  }
};

}  // namespace rainref::cli
