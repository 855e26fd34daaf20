// Films behind the glass: which picture of a film a frame shows, how an ffmpeg is asked, and what is said where it is missing or fails.
#include <cstdlib>
#include <filesystem>
#include <span>

#include <nlohmann/json.hpp>

#include "base/hash.h"
#include "base/program_path.h"
#include "cli/picture_files.h"
#include "image_io/read.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class FilmsBehind : public SceneFiles {
 protected:
  FilmsBehind() : path_(std::getenv("PATH")) {
    put(folder / "flat.toml", fmt::format("effect = 'edge_splash'\nvariant = 'corrected'\n[run]\nframes = 6\nsize = [{}, {}]\nfps = 60\n"
                                          "[display]\nexposure = 0\n[scene]\nimage = 'film.mp4'\n",
                                          width, height));
    fs::create_directory(folder / "bin");
    before = folder.names();
  }
  ~FilmsBehind() override { ::setenv("PATH", path_.c_str(), 1); }
  void use_ffmpeg(const std::string& script) {
    put(folder / "bin/ffmpeg", "#!/bin/sh\n" + script);
    fs::permissions(folder / "bin/ffmpeg", fs::perms::owner_all);
    ::setenv("PATH", ((folder / "bin").string() + ":" + path_).c_str(), 1);
    before = folder.names();
  }
  std::string path_;
};

/// Without an installed one: what it prints is written here.
class AskedFfmpeg : public FilmsBehind {
 protected:
  /// 4 x 2 texels in three frames of which the second shows what the first shows; frame n of code 60 (n + 1).
  static constexpr const char* answers =
      "case \"$*\" in\n"
      "  *framemd5*) printf '#dimensions 0: 4x2\\n#sar 0: 1/1\\n0, 0, 0, 1, 12, aa\\n0, 1, 1, 1, 12, aa\\n0, 2, 2, 1, 12, bb\\n' ;;\n"
      "  *) for code in 074 074 264; do i=0; while [ $i -lt 24 ]; do printf \"\\\\$code\"; i=$((i + 1)); done; done ;;\nesac\n";
  AskedFfmpeg() { put(folder / "film.mp4", "a film"); }
  std::string shown(int frame) const {
    return contents(folder / fmt::format("out/edge_splash.{:04}.png", frame)).empty()
               ? "none"
               : std::to_string(image_io::read(folder / fmt::format("out/edge_splash.{:04}.png", frame)).image.row<std::uint8_t>(3)[4]);
  }
};

TEST_F(AskedFfmpeg, ShowsThePicturesOfItsFrames) {
  use_ffmpeg(std::string("printf '%s\\n' \"$@\" >>asked\n") + answers);
  const Outcome o = rainref({"run", "flat.toml", "-o", "out", "--frames", "3", "--every", "1"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(shown(0), "60");
  EXPECT_EQ(shown(1), "60");
  EXPECT_EQ(shown(2), "180");
  // It is asked for this file alone, as this kind of film, and decodes in one go.
  const std::string asked = contents(folder / "asked");
  EXPECT_THAT(asked, AllOf(HasSubstr("-protocol_whitelist\nfile\n-f\nmov\n-i\nfile:film.mp4\n"), HasSubstr("fps=60:round=up"),
                           HasSubstr("-frames:v\n3\n"), HasSubstr("-nostdin"), HasSubstr("-timelimit"), HasSubstr("start_frame=0,")));
  const auto input = nlohmann::json::parse(contents(folder / "out/summary.json"))["inputs"].at(0);
  EXPECT_EQ(input["file"], "film.mp4");
  EXPECT_EQ(input["lossy"], true);
  const std::string film = contents(folder / "film.mp4");
  EXPECT_EQ(input["files_hash"], file_hash(std::as_bytes(std::span(film))).text());
}
TEST_F(AskedFfmpeg, AfterTheEndComesWhatTheSceneSays) {
  use_ffmpeg(answers);
  const auto after = [&](const char* end) {
    EXPECT_EQ(rainref({"run", "flat.toml", "-o", "out", "--every", "1", "--overwrite", "--set", std::string("sequence.end=") + end}).code,
              0);
    std::string all;
    for (int frame = 0; frame < 6; ++frame) all += shown(frame) + " ";
    return all;
  };
  EXPECT_EQ(after("hold"), "60 60 180 180 180 180 ");
  EXPECT_EQ(after("loop"), "60 60 180 60 60 180 ");
  expect_refused("flat.toml", {},
                 AllOf(HasSubstr("flat.toml:10:1: scene.image: run.frames 6: frame 5 comes after 'film.mp4', which ends after 3 "
                                 "frames"),
                       HasSubstr("sequence.end")));
}
TEST_F(AskedFfmpeg, WhatGoesWrongIsOneSentence) {
  use_ffmpeg("echo 'moov atom not found' >&2\nexit 1\n");
  expect_refused("flat.toml", {}, HasSubstr("scene.image: 'film.mp4': ffmpeg ended with exit code 1; it printed: moov atom not found"));
  use_ffmpeg("exit 0\n");
  expect_refused("flat.toml", {}, HasSubstr("scene.image: 'film.mp4': ffmpeg gave no picture"));
  use_ffmpeg("kill -9 $$\n");
  expect_refused("flat.toml", {}, HasSubstr("scene.image: 'film.mp4': ffmpeg was ended by signal 9 (Killed)"));
  // It knows the film and then decodes less than a picture.
  use_ffmpeg("case \"$*\" in *framemd5*) printf '#dimensions 0: 4x2\\n0, 0, 0, 1, 12, aa\\n' ;; *) printf abc ;; esac\n");
  expect_refused("flat.toml", {"run.frames=1"}, HasSubstr("scene.image: 'film.mp4': ffmpeg gave no picture"), 4);
  use_ffmpeg(
      "case \"$*\" in *framemd5*) printf '#dimensions 0: 4x2\\n0, 0, 0, 1, 12, aa\\n' ;; *) printf abc; echo full >&2; exit 3 ;; esac\n");
  expect_refused("flat.toml", {"run.frames=1"}, HasSubstr("scene.image: 'film.mp4': ffmpeg ended with exit code 3; it printed: full"), 4);
  expect_refused("flat.toml", {"scene.image=none.webm"}, HasSubstr("--set scene.image: cannot read 'none.webm': No such file"), 4);
  fs::remove(folder / "bin/ffmpeg");
  fs::create_directory(folder / "empty");
  ::setenv("PATH", (folder / "empty").c_str(), 1);
  expect_refused("flat.toml", {},
                 HasSubstr("scene.image: 'film.mp4': ffmpeg, which reads films, is in no folder of PATH (Debian: apt-get install ffmpeg)"),
                 4);
}
TEST_F(AskedFfmpeg, AFilmIsTakenWhereItCanBeSeen) {
  use_ffmpeg(answers);
  put(folder / "colour24.toml", contents(folder / "flat.toml") + "depth_image = 'film.mp4'\n");
  expect_refused("colour24.toml", {"run.frames=3"},
                 HasSubstr("scene.depth_image: expected a picture, found the film 'film.mp4'; scene.image takes films"));
  put(folder / "water.toml", "effect = 'puddle'\nvariant = 'corrected'\n[environment]\nimage = 'film.MP4'\n");
  expect_refused("water.toml", {}, HasSubstr("environment.image: expected a picture, found the film 'film.MP4'; scene.image takes films"));
  for (const char* key : {"first=2", "count=2", "rate=24"})
    expect_refused("flat.toml", {std::string("sequence.") + key}, HasSubstr("expected none for a film, which has its own times"));
}

/// With Debian's ffmpeg.
class RealFilmsBehind : public FilmsBehind {
 protected:
  static constexpr int pictures = 8;
  void SetUp() override {
    if (program_in_path("ffmpeg").empty()) GTEST_SKIP() << "ffmpeg is not installed";
    for (int k = 0; k < pictures; ++k)
      image_io::write_png(folder / fmt::format("grey{}.png", k), image_of(Format::rgba8, 64, 48, [&](int, int, int c) {
                            return c == 3 ? 255.0f : static_cast<float>(30 * k + 20);
                          }));
  }
  /// Frames of a run and the pictures that they show, by their grey.
  std::vector<int> shown(const std::string& film, int frames, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{
        "run", "flat.toml", "-o", "out", "--every", "1", "--overwrite", "--frames", std::to_string(frames), "--set", "scene.image=" + film};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome o = rainref(words);
    EXPECT_EQ(o.code, 0) << o.err;
    std::vector<int> all;
    for (int n = 0; n < frames; ++n) {
      const Image seen = image_io::read(folder / fmt::format("out/edge_splash.{:04}.png", n)).image;
      const int code = seen.row<std::uint8_t>(height / 2)[4 * (width / 2)];
      all.push_back((code - 5) / 30);
      EXPECT_NEAR(code, 30 * all.back() + 20, 4) << n;  // through Y'CbCr of 8 bits
    }
    return all;
  }
};

// Frame n shows picture floor(n rate / fps), as of a sequence.
TEST_F(RealFilmsBehind, ShowTheLastPictureWhoseTimeHasCome) {
  for (const std::string film : {"film.mp4", "film.webm", "film.mov", "film.mkv"})
    for (const int rate : {24, 30, 25}) {
      SCOPED_TRACE(film + " " + std::to_string(rate));
      output(fmt::format("ffmpeg -v error -y -framerate {} -i grey%d.png -pix_fmt yuv420p {}", rate, film));
      std::vector<int> wanted;
      for (int n = 0; n * rate < pictures * 60; ++n) wanted.push_back(n * rate / 60);
      EXPECT_EQ(shown(film, static_cast<int>(wanted.size())), wanted);
      if (rate != 24) continue;
      // Every picture of the film counts for its time, also the last one.
      const int frames = static_cast<int>(wanted.size());
      wanted.insert(wanted.end(), {0, 0, 0, 1});
      EXPECT_EQ(shown(film, frames + 4, {"--set", "sequence.end=loop"}), wanted);
    }
}
TEST_F(RealFilmsBehind, AreTheSameScene) {
  output("ffmpeg -v error -y -framerate 24 -i grey%d.png -pix_fmt yuv420p film.mp4");
  for (const char* effect : {"screen_drops", "rainy_glass", "windshield"})
    for (const char* variant : {"as-published", "corrected"}) {
      SCOPED_TRACE(fmt::format("{} {}", effect, variant));
      std::string text =
          fmt::format("effect = '{}'\nvariant = '{}'\n[run]\nframes = 6\nsize = [24, 16]\n[scene]\nimage = 'film.mp4'\n", effect, variant);
      if (std::string(effect) == "windshield") text += "size = [24, 16]\n[windshield]\nheight_size = [24, 16]\n";
      if (std::string(effect) == "rainy_glass") text += "[maps]\nsize = 16\n";
      put(folder / "any.toml", text);
      const auto lines = hash({"any.toml"});
      EXPECT_EQ(hash({"any.toml", "--threads", "2"}), lines);
      EXPECT_NE(hash({"any.toml", "--set", "sequence.end=loop", "--set", "run.fps=24"}), lines);
    }
}

}  // namespace
}  // namespace rainref::cli
