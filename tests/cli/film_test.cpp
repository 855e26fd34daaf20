// `rainref run --film`: what an ffmpeg is given, how it is asked, and what is left where it is missing, fails or is killed.
#include <set>

#include "base/program_path.h"
#include "cli/running.h"
#include "image_io/film.h"
#include "image_io/film_command.h"
#include "image_io/read.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

constexpr const char* keeping = "printf '%s\\n' \"$@\" >asked\nfor last; do :; done\ntee given >\"${last#file:}\"\n";

class Films : public CommandLine {
 protected:
  Films() : path_(std::getenv("PATH")) {
    fs::create_directory(folder / "bin");
    // Rain so heavy that no two frames are alike.
    put(folder / "heavy.toml",
        contents(folder / "corrected.toml") + "damping = 0.99\ndrop_intensity = 4\n[rain]\nrate = 200\nsmallest_drop = 1\n");
    // Drops before a picture of one colour, another one in each frame.
    for (int k = 0; k < 6; ++k)
      put(folder / fmt::format("colour{}.png", k),
          image_io::png(25, 15, 8, 2, std::vector<std::string>(15, [&] {
                          std::string row;
                          for (int x = 0; x < 25; ++x)
                            row += {static_cast<char>(40 * k), static_cast<char>(200 - 30 * k), static_cast<char>(25 * k)};
                          return row;
                        }())));
    put(folder / "colours.toml",
        "effect = 'screen_drops'\nvariant = 'corrected'\n[run]\nframes = 6\nsize = [25, 15]\n[scene]\nimage = 'colour%d.png'\n"
        "[drops]\nlargest_radius = 12\n[flow]\non = false\n");
  }
  ~Films() override { ::setenv("PATH", path_.c_str(), 1); }

  /// An ffmpeg of this shell script, before all others.
  void use_ffmpeg(const std::string& script) {
    put(folder / "bin/ffmpeg", "#!/bin/sh\n" + script);
    fs::permissions(folder / "bin/ffmpeg", fs::perms::owner_all);
    ::setenv("PATH", ((folder / "bin").string() + ":" + path_).c_str(), 1);
    before = folder.names();
  }
  /// The bytes of a PNG as they are piped: red, green, blue, top row first.
  std::string raw_of(const fs::path& png) const {
    const Image image = image_io::read(png).image;
    std::string bytes;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) bytes.append(reinterpret_cast<const char*>(image.row_bytes(y)) + 4 * x, 3);
    return bytes;
  }
  /// Of frames that all differ: else nothing would be said of their order.
  std::string raw_of_frames(const std::string& in, const std::vector<int>& frames) const {
    std::string bytes;
    std::set<std::string> all;
    for (const int frame : frames) {
      bytes += raw_of(folder / fmt::format("{}/puddle.{:04}.png", in, frame));
      EXPECT_TRUE(all.insert(raw_of(folder / fmt::format("{}/puddle.{:04}.png", in, frame))).second) << frame;
    }
    return bytes;
  }
  /// The word that follows `option` in what the kept ffmpeg was asked.
  std::string asked(const std::string& option) const {
    const std::vector<std::string> words = lines_of(contents(folder / "asked"));
    const auto at = std::find(words.begin(), words.end(), option);
    return at == words.end() || at + 1 == words.end() ? "" : *(at + 1);
  }
  std::string path_;
};

TEST_F(Films, TheBytesPipedAreThoseOfTheFrames) {
  ASSERT_EQ(rainref({"run", "heavy.toml", "--frames", "5", "--every", "1", "-o", "all"}).code, 0);
  use_ffmpeg(keeping);
  const Outcome o = rainref({"run", "heavy.toml", "--frames", "5", "--film", "rain.mp4", "-o", "o"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  EXPECT_THAT(o.out,
              MatchesRegex("5 frames in [^\n]*, 1 picture and summary\\.json in o, film of 5 pictures at 60 a second: rain\\.mp4\n"));
  const std::string all = raw_of_frames("all", {0, 1, 2, 3, 4});
  EXPECT_EQ(all.size(), 5u * 24 * 16 * 3);
  EXPECT_TRUE(contents(folder / "given") == all);
  EXPECT_TRUE(contents(folder / "rain.mp4") == all);
  EXPECT_EQ(asked("-pixel_format"), "rgb24");
  EXPECT_EQ(asked("-video_size"), "24x16");
  EXPECT_EQ(asked("-framerate"), "60/1");
  EXPECT_EQ(asked("-f"), "rawvideo");
  EXPECT_EQ(asked("-threads"), "1");
  EXPECT_THAT(lines_of(contents(folder / "asked")), Contains("+bitexact"));
  // The pictures beside it are those of a run without it.
  EXPECT_EQ(contents(folder / "o/puddle.0004.png"), contents(folder / "all/puddle.0004.png"));
}

TEST_F(Films, FirstAndEveryChooseFramesAndTheRateKeepsTheScenesSpeed) {
  ASSERT_EQ(rainref({"run", "heavy.toml", "--frames", "9", "--every", "1", "-o", "all"}).code, 0);
  use_ffmpeg(keeping);
  Outcome o = rainref(
      {"run", "heavy.toml", "--frames", "9", "--first", "3", "--every", "2", "--film", "new/deep/rain.webm", "-o", "o", "--image", "none"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.out, HasSubstr("film of 3 pictures at 30 a second: new/deep/rain.webm\n"));
  EXPECT_TRUE(contents(folder / "new/deep/rain.webm") == raw_of_frames("all", {4, 6, 8}));
  EXPECT_EQ(asked("-framerate"), "60/2");
  EXPECT_THAT(contents(folder / "asked"), HasSubstr("libvpx-vp9"));
  o = rainref({"run", "heavy.toml", "--frames", "9", "--first", "7", "--set", "run.fps=25", "--film", "RAIN.GIF", "-o", "o"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_TRUE(contents(folder / "RAIN.GIF") == contents(folder / "given"));
  EXPECT_EQ(contents(folder / "given").size(), 2u * 24 * 16 * 3);
  EXPECT_EQ(asked("-framerate"), "25/1");
  EXPECT_THAT(contents(folder / "asked"), HasSubstr("palettegen"));
}

TEST_F(Films, TracedPicturesAreTracedForThem) {
  put(folder / "traced.toml", contents(folder / "heavy.toml") + "[compositor]\npicture = 'traced'\nsamples = 1\n");
  ASSERT_EQ(rainref({"run", "traced.toml", "--frames", "3", "--every", "1", "-o", "all"}).code, 0);
  use_ffmpeg(keeping);
  const Outcome o = rainref({"run", "traced.toml", "--frames", "3", "--film", "rain.mp4", "-o", "o", "--image", "none"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_TRUE(contents(folder / "given") == raw_of_frames("all", {0, 1, 2}));
}

TEST_F(Films, WithoutFfmpegNothingIsSimulated) {
  fs::create_directory(folder / "empty");
  ::setenv("PATH", (folder / "empty").c_str(), 1);
  before = folder.names();
  // More frames than a test could wait for.
  expect_refusal({"run", "corrected.toml", "--frames", "1000000", "--film", "rain.mp4", "-o", "new/o"}, 4,
                 "film 'rain.mp4': ffmpeg, which makes films, is in no folder of PATH (Debian: apt-get install ffmpeg)");
  // One that may not be run is none.
  put(folder / "empty/ffmpeg", "#!/bin/sh\n");
  expect_refusal({"run", "corrected.toml", "--frames", "1000000", "--film", "rain.mp4", "-o", "new/o"}, 4, HasSubstr("no folder of PATH"));
}

TEST_F(Films, WhatCannotBeAFilmIsRefusedFirst) {
  use_ffmpeg(keeping);
  const auto refused = [&](const std::vector<std::string>& more, int code, const std::string& message) {
    expect_refusal(joined({"run", "corrected.toml", "--set", "run.frames=1000000", "-o", "new/o"}, more), code, HasSubstr(message));
  };
  refused({"--film", "rain.avi"}, 2, "film 'rain.avi': expected a name that ends in .mp4, .webm or .gif");
  refused({"--film", "mp4"}, 2, "expected a name that ends in .mp4");
  refused({"--film", ""}, 2, "--film: expected a file");
  refused({"--film", "rain.gif"}, 2,
          "expected at most 50 pictures a second, which is what a GIF can show, found 60: --every 2 gives fewer");
  refused({"--film", "rain.mp4", "--resume"}, 2, "--film: expected neither --checkpoint-every nor --resume");
  refused({"--film", "rain.mp4", "--checkpoint-every", "3"}, 2, "--film: expected neither --checkpoint-every nor --resume");
  refused({"--film", "rain.mp4", "--set", "run.frames=9", "--first", "7", "--every", "5"}, 2,
          "--film: expected a frame to show, found none from 7 to 8 that 5 divides");
  fs::create_directory(folder / "rain.mp4");
  before = folder.names();
  refused({"--film", "rain.mp4"}, 4, "film 'rain.mp4': a folder has that name");
  refused({"--film", "corrected.toml/rain.mp4"}, 4, "film 'corrected.toml/rain.mp4': cannot write there: ");
}

TEST_F(Films, AFailureShowsWhatWasPrintedAndLeavesTheOlderFile) {
  put(folder / "rain.mp4", "older");
  use_ffmpeg("for last; do :; done\nhead -c 1000 >\"${last#file:}\"\necho one; echo 'Unknown encoder libx264' >&2\nexit 3\n");
  expect_refusal({"run", "corrected.toml", "--frames", "200", "--film", "rain.mp4", "-o", "new/o", "--image", "none"}, 4,
                 "film 'rain.mp4': ffmpeg ended with exit code 3; it printed: one | Unknown encoder libx264");
  EXPECT_EQ(contents(folder / "rain.mp4"), "older");
  // After the last picture too: and its folder goes again.
  use_ffmpeg("cat >/dev/null\necho full >&2\nexit 1\n");
  expect_refusal({"run", "corrected.toml", "--film", "made/rain.mp4", "-o", "new/o", "--image", "none"}, 4,
                 "film 'made/rain.mp4': ffmpeg ended with exit code 1; it printed: full");
  // Content with less than all.
  use_ffmpeg("exit 0\n");
  expect_refusal({"run", "corrected.toml", "--frames", "200", "--film", "rain.mp4", "-o", "new/o", "--image", "none"}, 4,
                 HasSubstr("ffmpeg ended before it had all pictures"));
  use_ffmpeg("kill -9 $$\n");
  expect_refusal({"run", "corrected.toml", "--frames", "200", "--film", "rain.mp4", "-o", "new/o", "--image", "none"}, 4,
                 HasSubstr("ffmpeg was ended by signal 9 (Killed)"));
  EXPECT_EQ(contents(folder / "rain.mp4"), "older");
}

TEST_F(Films, AFileThatExistsIsReplacedByAWholeFilm) {
  put(folder / "real.mp4", "older");
  fs::create_symlink("real.mp4", folder / "link.mp4");
  use_ffmpeg(keeping);
  ASSERT_EQ(rainref({"run", "corrected.toml", "--film", "link.mp4", "-o", "o", "--image", "none"}).code, 0);
  EXPECT_TRUE(fs::is_symlink(folder / "link.mp4"));
  EXPECT_EQ(contents(folder / "real.mp4").size(), 2u * 24 * 16 * 3);
}

TEST_F(Films, AnInterruptionEndsFfmpegAndLeavesNothing) {
  put(folder / "rain.mp4", "older");
  use_ffmpeg("echo $$ >id\nsleep 600 &\necho $! >child\ncat >/dev/null\n");
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto running =
        start_rainref(folder.path(), {"run", "corrected.toml", "--frames", "1000000", "--film", "rain.mp4", "-o", "o", "--image", "none"});
    const auto number = [&](const char* file) { return std::atoi(contents(folder / file).c_str()); };
    await([&] { return number("id") > 0 && number("child") > 0; });
    const int id = number("id"), child = number("child");
    EXPECT_TRUE(is_running(id) && is_running(child));
    EXPECT_EQ(running->end(signal), -signal);
    await([&] { return !is_running(id) && !is_running(child); });
    fs::remove(folder / "id");
    fs::remove(folder / "child");
    EXPECT_EQ(folder.names(), before);
    EXPECT_EQ(contents(folder / "rain.mp4"), "older");
  }
}

// Killed so that it cannot clean up: ffmpeg dies too, and the next film takes away what was left.
TEST_F(Films, AKilledRunLeavesNoFfmpegAndNoFilm) {
  use_ffmpeg("echo $$ >id\nexec sleep 600\n");
  const auto running = start_rainref(
      folder.path(), {"run", "corrected.toml", "--frames", "1000000", "--film", "film/rain.mp4", "-o", "o", "--image", "none"});
  await([&] { return std::atoi(contents(folder / "id").c_str()) > 0; });
  const int id = std::atoi(contents(folder / "id").c_str());
  EXPECT_EQ(running->end(SIGKILL), -SIGKILL);
  await([&] { return !is_running(id); });
  EXPECT_FALSE(fs::exists(folder / "film/rain.mp4"));
  use_ffmpeg(keeping);
  ASSERT_EQ(rainref({"run", "corrected.toml", "--film", "film/rain.mp4", "-o", "o", "--image", "none"}).code, 0);
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(folder / "film")) left.push_back(entry.path().filename());
  EXPECT_THAT(left, ElementsAre("rain.mp4"));
}

TEST(FilmProgram, IsFoundAsAShellFindsIt) {
  const TemporaryFolder folder;
  const std::string path = std::getenv("PATH");
  for (const char* name : {"a", "b", "c"}) fs::create_directory(folder / name);
  fs::create_directory(folder / "a/tool");  // no program
  put(folder / "b/tool", "");               // nor this, which may not be run
  put(folder / "c/tool", "");
  fs::permissions(folder / "c/tool", fs::perms::owner_all);
  ::setenv("PATH", fmt::format("{0}/none:{0}/a:{0}/b:{0}/c", folder.path().string()).c_str(), 1);
  EXPECT_EQ(program_in_path("tool"), folder / "c/tool");
  EXPECT_EQ(program_in_path("other"), "");
  ::setenv("PATH", path.c_str(), 1);
}

TEST(FilmProgram, NoNameIsTakenForAnOption) { EXPECT_THAT(image_io::film_arguments("-y.mp4", 2, 2, {60}, "-y.tmp").back(), "file:-y.tmp"); }

/// With Debian's ffmpeg: a film's pictures, taken out again.
class RealFilms : public Films {
 protected:
  void SetUp() override {
    if (program_in_path("ffmpeg").empty() || program_in_path("ffprobe").empty()) GTEST_SKIP() << "ffmpeg is not installed";
  }
};

TEST_F(RealFilms, HaveTheFramesInOrderAndTheScenesSpeed) {
  ASSERT_EQ(rainref({"run", "colours.toml", "--every", "1", "-o", "all"}).code, 0);
  for (const std::string name : {"rain.mp4", "rain.webm", "rain.gif"}) {
    SCOPED_TRACE(name);
    const std::vector<std::string> make{"run", "colours.toml", "--every", "2", "--film", name, "-o", "o", "--image", "none"};
    const Outcome o = rainref(make);
    ASSERT_EQ(o.code, 0) << o.err;
    const std::string bytes = contents(folder / name);
    // The same pictures and the same ffmpeg: the same bytes, so no date either.
    ASSERT_EQ(rainref(make).code, 0);
    EXPECT_TRUE(contents(folder / name) == bytes);
    const bool is_gif = name == "rain.gif";
    const std::string probe = "ffprobe -v error -count_frames -select_streams v -of csv=p=0 -show_entries stream=";
    EXPECT_EQ(output(probe + "width,height,nb_read_frames " + name), is_gif ? "25,15,3\n" : "26,16,3\n");
    if (!is_gif) {  // a GIF's are hundredths of a second, rounded
      EXPECT_EQ(output(probe + "avg_frame_rate " + name), "30/1\n");
    }
    // Three frames that differ: each decoded one is nearest to its own. 26x16 is 25x15 with a black line.
    output("ffmpeg -v error -y -i " + name + " -vsync 0 -vf format=rgb24,crop=25:15:0:0 -f rawvideo -pix_fmt rgb24 back");
    const std::string back = contents(folder / "back");
    constexpr std::size_t size = 25 * 15 * 3;
    ASSERT_EQ(back.size(), 3 * size);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto distance = [&](int frame) {
        const std::string made = raw_of(folder / fmt::format("all/screen_drops.{:04}.png", frame));
        double sum = 0;
        for (std::size_t i = 0; i < size; ++i)
          sum += std::abs(static_cast<int>(static_cast<unsigned char>(made[i])) - static_cast<unsigned char>(back[k * size + i]));
        return sum / size;
      };
      const double own = distance(static_cast<int>(2 * k));
      for (const int other : {0, 2, 4}) {
        if (other != static_cast<int>(2 * k)) {
          EXPECT_LT(own, distance(other)) << k;
        }
      }
      // Codes of 0 to 255, of small drops after a lossy code with half the colour. Measured: 7.8 at most.
      EXPECT_LT(own, 12) << k;
    }
  }
}

}  // namespace
}  // namespace rainref::cli
