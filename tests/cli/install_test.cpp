// OpenImageIO and its 250 libraries are loaded at the first picture that is read or EXR that is written, and found by programs from the
// build tree, by an installation that was moved, and by other projects' programs.
#include <cstdlib>

#include "cli/picture_files.h"
#include "cli/support.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;

class Installation : public CommandLine {
 protected:
  Installation() {
    put_npy(
        folder / "sky.npy", 8, 4, 3, [](int x, int y, int c) { return static_cast<float>(20 * x + 9 * y + c); }, true);
  }

  /// Runs with no picture to read, and says what the loader opened.
  std::string libraries_of(std::vector<std::string> arguments, const Circumstances& c = {}) const {
    ::setenv("LD_DEBUG", "files", 1);
    ::setenv("LD_DEBUG_OUTPUT", (folder / "loader").c_str(), 1);
    const Outcome o = rainref(arguments, c);
    ::unsetenv("LD_DEBUG");
    EXPECT_EQ(o.code, 0) << o.err;
    std::string log;
    for (const std::string& name : folder.names()) {
      if (!name.starts_with("loader.")) continue;
      log += contents(folder / name);
      std::filesystem::remove(folder / name);
    }
    return log;
  }
  static std::vector<std::string> run_of_arrays(const std::string& image) {
    return {"run",     "corrected.toml",
            "-o",      "out_" + image,
            "--image", image,
            "--set",   "environment.image=sky.npy",
            "--set",   "puddle.ground_image=sky.npy"};
  }
  /// The program of an installation into one folder that then becomes another. All tests have links to the files of one, so that they
  /// may remove and replace them, but not write into them.
  Circumstances installed() const {
    static const TemporaryFolder all;
    if (all.names().empty()) {
      output(
          fmt::format(RAINREF_CMAKE " --install '" RAINREF_BUILD "' --config " RAINREF_CONFIG " --prefix '{}'", (all / "first").string()));
      std::filesystem::rename(all / "first", all / "made");
    }
    using Options = std::filesystem::copy_options;
    std::filesystem::copy(all / "made", folder / "moved", Options::recursive | Options::create_hard_links | Options::copy_symlinks);
    Circumstances c;
    c.program = folder / "moved/bin/rainref";
    return c;
  }
  /// The file of the installation that stands between rainref and OpenImageIO.
  std::filesystem::path module() const {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "moved")) {
      if (entry.path().filename().string().starts_with("rainref_openimageio")) return entry.path();
    }
    return {};
  }
  /// Another project's program, which writes and reads a picture, tells what it takes a broken one for, and finds a scene by its name.
  void expect_consumer_works(const std::string& where, const std::filesystem::path& scenes) const {
    std::filesystem::create_directory(folder / "consumer");
    put(folder / "consumer/CMakeLists.txt", R"(cmake_minimum_required(VERSION 3.25)
project(consumer CXX)
find_package(rainref REQUIRED)
add_executable(consumer consumer.cpp)
target_include_directories(consumer PRIVATE ${RAINREF_SOURCE}/src)  # the room's headers are not installed
target_link_libraries(consumer PRIVATE rainref::simulation)
)");
    put(folder / "consumer/consumer.cpp", R"(#include <cstdio>
#include "image_io/read.h"
#include "image_io/write.h"
#include "rainref/error.h"
#include "rainref/simulation.h"
using namespace rainref;
int main() try {
  std::puts(read_scene("puddle/default.toml").file.c_str());
  Image image(Format::rgba8, 3, 2);
  image_io::write_png("a.png", image);
  std::printf("%d x %d\n", image_io::read("a.png").file_width, image_io::read("a.png").file_height);
  image_io::read("broken.exr");
} catch (const Error& error) {
  std::printf("%d %s\n", static_cast<int>(error.code()), error.what());
}
)");
    put(folder / "broken.exr", std::string("\x76\x2f\x31\x01\2\0\0\0channels", 16));
    output(fmt::format(RAINREF_CMAKE " -G '" RAINREF_GENERATOR "' -S consumer -B built -DCMAKE_CXX_COMPILER=" RAINREF_CXX_COMPILER
                                     " '-DCMAKE_CXX_FLAGS=" RAINREF_CXX_FLAGS " -O0' {} -DRAINREF_SOURCE=" RAINREF_SOURCE_DIR,
                       where));
    output(RAINREF_CMAKE " --build built");
    EXPECT_THAT(output("built/consumer"),
                AllOf(HasSubstr((scenes / "puddle/default.toml").string() + "\n3 x 2\n2 'broken.exr': "), Not(HasSubstr("cannot load"))));
  }
};

TEST_F(Installation, OpenImageIoIsLoadedAtTheFirstExrAndNotBefore) {
  EXPECT_THAT(libraries_of({"--version"}), AllOf(HasSubstr("libstdc++"), Not(HasSubstr("OpenImageIO"))));
  EXPECT_THAT(libraries_of(run_of_arrays("png")), AllOf(HasSubstr("libstdc++"), Not(HasSubstr("OpenImageIO"))));
  EXPECT_THAT(libraries_of(run_of_arrays("exr")), HasSubstr("libOpenImageIO.so"));
}

TEST_F(Installation, WorksWhereItWasMovedTo) {
  const Circumstances c = installed();
  EXPECT_THAT(libraries_of(run_of_arrays("both"), c), HasSubstr((folder / "moved").string()));
  EXPECT_TRUE(std::filesystem::exists(folder / "out_both/puddle.0001.exr"));
  EXPECT_EQ(contents(c.program).find(RAINREF_BUILD "/lib"), std::string::npos);  // or it would also work by accident
}

TEST_F(Installation, AMissingOrForeignLibraryIsOneClearError) {
  const Circumstances c = installed();
  const std::string name = module().filename();
  const std::string place = std::filesystem::canonical(module().parent_path());
  std::filesystem::remove(module());
  put(folder / name, "");  // the current folder is no place to look
  before = folder.names();
  const auto expect_refused = [&](const testing::Matcher<const std::string&>& message) {
    const Outcome o = rainref(run_of_arrays("exr"), c);
    EXPECT_EQ(o.code, 4);
    EXPECT_EQ(o.out, "");
    EXPECT_THAT(o.err, AllOf(message, EndsWith("\n")));
    EXPECT_EQ(o.err.find('\n'), o.err.size() - 1) << o.err;
    EXPECT_EQ(folder.names(), before);
  };
  const std::string start = fmt::format("rainref: cannot load '{}', which reads pictures and writes EXR: ", name);
  expect_refused(AllOf(testing::StartsWith(start + "found in none of "), HasSubstr("moved/bin/../")));
  put(std::filesystem::path(place) / name, "no library");
  expect_refused(AllOf(testing::StartsWith(start), HasSubstr("moved/bin/../"), HasSubstr("file too short")));
  EXPECT_EQ(rainref(run_of_arrays("png"), c).code, 0);
}

// Whatever a public header names it has, or includes: nothing of it hangs on what else a program includes, or on a header of src.
TEST_F(Installation, EachHeaderStandsAlone) {
  installed();
  const std::filesystem::path include = folder / "moved/include";
  std::string headers;
  for (const auto& entry : std::filesystem::directory_iterator(include / "rainref")) {
    const std::string name = entry.path().filename();
    put(folder / (name + ".cpp"), fmt::format("#include \"rainref/{0}\"\n#include \"rainref/{0}\"\n", name));
    headers += name + ".cpp ";
  }
  EXPECT_THAT(headers, HasSubstr("windshield.h.cpp"));
  output(fmt::format("{} -std=c++20 -Wall -Wextra -Werror -fsyntax-only -I'{}' {}", RAINREF_CXX_COMPILER, include.string(), headers));
}

// The installed headers are all that a program has; pkg-config finds them where the installation lies now, not where it was made.
TEST_F(Installation, HasEveryEffectForProgramsOfOtherProjects) {
  installed();
  const std::string by_cmake = fmt::format(
      RAINREF_CMAKE " -G '" RAINREF_GENERATOR "' -S " RAINREF_SOURCE_DIR "/examples -B outside -DCMAKE_CXX_COMPILER=" RAINREF_CXX_COMPILER
                    " '-DCMAKE_CXX_FLAGS=" RAINREF_CXX_FLAGS " -O0' '-DCMAKE_C_FLAGS=" RAINREF_C_FLAGS "' '-DCMAKE_PREFIX_PATH={}'",
      (folder / "moved").string());
  output(by_cmake);
  output(RAINREF_CMAKE " --build outside");
  if (std::string_view(RAINREF_GENERATOR) != "Unix Makefiles") {
    EXPECT_FALSE(std::filesystem::exists(folder / "outside/Makefile")) << "make need not be installed";
  }
  const std::string said = output("outside/every_effect");
  EXPECT_THAT(lines_of(said), testing::ElementsAre(MatchesRegex("puddle 32x18 .{8}"), MatchesRegex("windshield 32x18 .{8}"),
                                                   MatchesRegex("edge_splash 32x18 .{8}"), MatchesRegex("screen_drops 32x18 .{8}"),
                                                   MatchesRegex("screen_drops.flow 32x18 .{8}"), MatchesRegex("rainy_glass 32x18 .{8}"),
                                                   "2 mine.toml:2:1: wipers.cuont: unknown key; did you mean 'wipers.count'?"));
  const std::string simulated = output("outside/simulate");
  EXPECT_THAT(lines_of(simulated),
              testing::ElementsAre(HasSubstr("puddle 2: wave=768x512 "), HasSubstr("windshield 2: drops=records "),
                                   HasSubstr("edge_splash 2: edge=32x18 "), HasSubstr("screen_drops 2: background=32x18 "),
                                   HasSubstr("rainy_glass 2: raindrops=512x512 "), HasSubstr("did you mean 'puddle'?")));
  const std::string in_c = output("outside/water");
  EXPECT_EQ(in_c, "rg16f 768x512 in 2 planes\nFAIL in display: upside down\n");
  EXPECT_EQ(output("outside/judge_a_port"), "FAIL in display: upside down\n");
  EXPECT_EQ(output("outside/film"), "");
  for (const char* written : {"rainy_glass.png", "splashes.png", "puddle.png", "puddle.state"})
    EXPECT_TRUE(std::filesystem::exists(folder / written)) << written;

  std::string pc;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "moved")) {
    if (entry.path().filename() == "rainref.pc") pc = entry.path().parent_path();
  }
  const std::string config = fmt::format("PKG_CONFIG_PATH='{}' pkg-config", pc);
  const auto path_of = [&](const char* variable) {
    std::string path = output(fmt::format("{} --variable={} rainref", config, variable));
    path.erase(path.find_last_not_of('\n') + 1);
    return std::filesystem::canonical(path);
  };
  EXPECT_EQ(path_of("prefix"), folder / "moved");
  EXPECT_EQ(path_of("includedir"), folder / "moved/include");
  // README.md's program, as it stands there.
  const std::string readme = contents(RAINREF_SOURCE_DIR "/README.md"), include = "#include \"rainref/simulation.h\"\n";
  const std::size_t program = readme.find("```cpp\n" + include);
  ASSERT_NE(program, std::string::npos);
  const std::size_t body = program + 7 + include.size();
  put(folder / "readme.cpp", include + "int main() {\n" + readme.substr(body, readme.find("```", body) - body) + "}\n");
  output(fmt::format("{} -std=c++20 " RAINREF_CXX_FLAGS " readme.cpp -o by_pkg_config $({} --cflags --libs rainref)", RAINREF_CXX_COMPILER,
                     config));
  put(folder / "named.cpp",
      "#include <cstdio>\n#include \"rainref/simulation.h\"\nint main() { std::puts(rainref::read_scene(\"puddle/default\").file.c_str()); "
      "}\n");
  output(fmt::format("{} -std=c++20 " RAINREF_CXX_FLAGS " -O0 named.cpp -o named $({} --cflags --libs rainref)", RAINREF_CXX_COMPILER,
                     config));
  EXPECT_EQ(output("./named"), (folder / "moved/share/rainref/scenes/puddle/default.toml\n").string());
  const std::string splashes = contents(folder / "splashes.png");
  std::filesystem::remove(folder / "splashes.png");
  EXPECT_EQ(output("./by_pkg_config"), "");
  EXPECT_EQ(contents(folder / "splashes.png"), splashes);
  output(fmt::format("cc -std=c11 -pedantic -Werror " RAINREF_SOURCE_DIR
                     "/examples/c/water.c -o c_by_pkg_config $(PKG_CONFIG_PATH='{}' pkg-config --cflags --libs rainref-c) " RAINREF_C_FLAGS,
                     pc));
  EXPECT_EQ(output("LD_LIBRARY_PATH=moved/" +
                   std::filesystem::relative(std::filesystem::path(pc).parent_path(), folder / "moved").string() + " ./c_by_pkg_config"),
            in_c);
}

// Where a package is put together it is installed below another root than the one where it will lie.
TEST_F(Installation, MayBeStagedForAPrefixOfItsOwn) {
  output(fmt::format("DESTDIR='{}/stage' " RAINREF_CMAKE " --install '" RAINREF_BUILD "' --config " RAINREF_CONFIG " --prefix /opt/rain",
                     folder.path().string()));
  std::filesystem::rename(folder / "stage/opt/rain", folder / "moved");
  Circumstances c;
  c.program = folder / "moved/bin/rainref";
  const Outcome o = rainref({"list"}, c);
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.out, HasSubstr("\n  puddle/default.toml  "));
  EXPECT_THAT(o.out, HasSubstr("\n  storm          weather  "));
  EXPECT_THAT(rainref({"describe", "puddle/default", "--preset", "storm", "--json"}, c).out,
              HasSubstr((folder / "moved/share/rainref/presets/storm.toml:").string()));
  EXPECT_THAT(rainref({"describe", "puddle/default"}, c).out, testing::StartsWith("puddle/default: A puddle on a street at night"));
  EXPECT_THAT(o.out, Not(HasSubstr(RAINREF_SOURCE_DIR)));
  // Names that it takes, its own scenes' and no others': also without ".toml", and as the documents write them.
  put(folder / "moved/share/rainref/scenes/puddle/default.toml",
      "effect = 'edge_splash'\nvariant = 'corrected'\n[run]\nsize = [16, 9]\nframes = 1\n");
  const Outcome named = rainref({"hash", "puddle/default.toml"}, c);
  const std::size_t lines = lines_of(named.out).size();  // of one frame, and the scene's
  EXPECT_GE(lines, 3u) << named.err;
  EXPECT_EQ(rainref({"hash", "puddle/default"}, c).out, named.out);
  EXPECT_EQ(rainref({"hash", "scenes/puddle/default.toml"}, c).out, named.out);
  EXPECT_EQ(rainref({"hash", "../scenes/puddle/default.toml"}, c).code, 4);
  // A file of the user's wins.
  std::filesystem::create_directories(folder / "puddle");
  put(folder / "puddle/default.toml", "effect = 'edge_splash'\nvariant = 'corrected'\n[run]\nsize = [16, 9]\nframes = 2\n");
  EXPECT_EQ(lines_of(rainref({"hash", "puddle/default.toml"}, c).out).size(), 2 * lines - 1);
  EXPECT_EQ(contents(c.program).find(RAINREF_SOURCE_DIR "/scenes"), std::string::npos);  // what a machine that builds is called stays there
}

TEST_F(Installation, ShowsAFirstVerdictFromAnyFolder) {
  const Circumstances c = installed();
  if (!std::filesystem::exists(RAINREF_BUILD "/share/rainref/demo")) GTEST_SKIP() << "no glslangValidator (Debian: glslang-tools)";
  EXPECT_EQ(rainref({"demo", "-o", "deep/first"}, c).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "deep/first/report.html"));
  std::filesystem::remove_all(folder / "moved/share/rainref/demo");
  expect(rainref({"demo"}, c), 4, "", HasSubstr("demo: the ports that it judges are not beside this program, in share/rainref/demo"));
  EXPECT_FALSE(std::filesystem::exists(folder / "rainref-demo"));
}

// The plans that came with it name scenes as `rainref list` does: they run from where they were installed, and from a checkout.
TEST_F(Installation, HasPlansThatFindTheirScenes) {
  const Circumstances c = installed();
  for (const char* plan : {"rates", "pairs_windshield", "pairs_rainy_glass", "pairs_screen_drops"}) {
    const std::string file = fmt::format("examples/sweeps/{}.toml", plan);
    const Outcome o = rainref({"sweep", "plan", "moved/share/doc/rainref/" + file}, c);
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_THAT(o.out, HasSubstr(" cells of run"));
    EXPECT_EQ(rainref({"sweep", "plan", RAINREF_SOURCE_DIR "/" + file}).out, o.out);
  }
  // A file beside the plan wins, one in the current folder does not, and a name of neither is said as the plan has it.
  const std::string plan = "verb = 'hash'\nscene = 'puddle/analytic.toml'\nframes = 1\n";
  const std::string other = "effect = 'edge_splash'\nvariant = 'corrected'\n[run]\nsize = [16, 9]\n";
  std::filesystem::create_directories(folder / "plans/puddle");
  std::filesystem::create_directories(folder / "puddle");
  put(folder / "plans/a.toml", plan);
  put(folder / "puddle/analytic.toml", other);
  const auto made = [&] {
    std::filesystem::remove_all(folder / "out");
    expect(rainref({"sweep", "run", "plans/a.toml"}, c), 0);
    std::string effects;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "out"))
      if (entry.path().filename() == "cell.json") effects += contents(entry.path());
    return effects;
  };
  EXPECT_THAT(made(), AllOf(HasSubstr("puddle.grid"), Not(HasSubstr("edge_splash"))));
  put(folder / "plans/puddle/analytic.toml", other);
  EXPECT_THAT(made(), HasSubstr("edge_splash"));
}

TEST_F(Installation, ServesProgramsOfOtherProjects) {
  installed();
  expect_consumer_works("-DCMAKE_PREFIX_PATH=" + (folder / "moved").string(), folder / "moved/share/rainref/scenes");
  std::filesystem::remove_all(folder / "built");
  expect_consumer_works("-Drainref_DIR=" RAINREF_BUILD, RAINREF_SOURCE_DIR "/scenes");
}

}  // namespace
}  // namespace rainref::cli
