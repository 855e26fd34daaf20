// librainref.so from outside: what it exports, and a C program that loads it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <dlfcn.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include <fmt/format.h>

#include "base/shell.h"
#include "base/temporary_folder.h"
#include "capture/array.h"
#include "capture/npy_write.h"
#include "capture/capture_recorder.h"
#include "puddle/golden_scenes.h"
#include "rainy_glass/golden_scenes.h"
#include "screen_drops/golden_scenes.h"
#include "rainref.h"
#include "rainref/executor.h"
#include "shipped_packs.h"
#include "source_folder.h"
#include "windshield/golden_scenes.h"

namespace rainref {
namespace {

namespace fs = std::filesystem;

std::set<std::string> matches(const std::string& text, const char* pattern) {
  std::set<std::string> found;
  const std::regex regex(pattern);
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) found.insert((*i)[1]);
  return found;
}

/// Golden scenes as files, with the pictures that these are handed as images; and the scenes beside this file.
class CLibrary : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const parallel::Executor executor(2);
    write("panorama.npy", puddle::golden_surroundings(executor).environment);
    write_scene("puddle_corrected", golden::named(puddle::golden_scenes(), "puddle/corrected/rg16f"),
                "environment.image = 'panorama.npy'\n");
    const auto window = golden::named(screen_drops::golden_scenes(), "screen_drops/corrected/still");
    write("window.npy", screen_drops::golden_inputs(window.settings(), executor).colour);
    write_scene("screen_drops_corrected", window, "scene.image = 'window.npy'\n");
    const auto glass = golden::named(rainy_glass::golden_scenes(), "rainy_glass/corrected/rgba16f");
    const rainy_glass::Surroundings garden = rainy_glass::golden_surroundings(glass.settings(), executor);
    write("garden.npy", garden.colour);
    write("garden_depth.npy", garden.depth);
    write_scene("rainy_glass_corrected", glass, "scene.image = 'garden.npy'\nscene.depth_image = 'garden_depth.npy'\n");
    const windshield::Surroundings before = windshield::small_surroundings();
    write("before.npy", before.colour);
    write("depth.npy", before.depth);
    write_scene("windshield_corrected", golden::named(windshield::golden_scenes(), "windshield/corrected"),
                "scene.image = 'before.npy'\nscene.depth_image = 'depth.npy'\nscene.size = [37, 23]\n");
    for (const auto& entry : fs::directory_iterator(test::source_folder() + "/tests/c_library/scenes"))
      fs::copy_file(entry.path(), *folder_ / entry.path().filename().string());
  }
  static void TearDownTestSuite() { delete folder_; }
  static std::string scene(const std::string& name) { return (*folder_ / (name + ".toml")).string(); }
  static std::string hashes() { return test::source_folder() + "/tests/golden/hashes.txt"; }
  static void expect_success(const std::string& arguments) {
    const auto [text, status] = output_of(fmt::format("{} {} {}", RAINREF_C_CLIENT, RAINREF_C_LIBRARY, arguments));
    EXPECT_EQ(status, 0) << arguments << '\n' << text;
  }

 private:
  template <class Scene>
  static void write_scene(const std::string& file, const Scene& scene, const std::string& pictures) {
    std::ofstream(*folder_ / (file + ".toml")) << fmt::format("# {0}\neffect = '{1}'\nvariant = '{2}'\n{3}{4}", scene.name,
                                                              scene.name.substr(0, scene.name.find('/')), scene.variant, pictures,
                                                              scene.toml);
  }
  /// Files have their top row first.
  static void write(const char* name, const Image& image) {
    capture::Array a = capture::array_of(BufferView(image), {"", 0, {}});
    const std::size_t row = a.element_bytes() * static_cast<std::size_t>(a.width);
    std::vector<std::byte> turned;
    for (int y = a.height; y-- > 0;) {
      const auto from = a.levels[0].begin() + static_cast<std::ptrdiff_t>(row) * y;
      turned.insert(turned.end(), from, from + static_cast<std::ptrdiff_t>(row));
    }
    a.levels[0] = turned;
    const std::vector<std::byte> bytes = capture::npy_bytes(a, 0);
    std::ofstream(*folder_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  static TemporaryFolder* folder_;
};
TemporaryFolder* CLibrary::folder_ = nullptr;

TEST_F(CLibrary, ExportsWhatTheHeaderDeclaresAndNothingElse) {
  const auto [symbols, status] = output_of("nm -D --defined-only --format=posix " RAINREF_C_LIBRARY);
  ASSERT_EQ(status, 0) << symbols;
  std::set<std::string> exported = matches(symbols, "(?:^|\n)([^ @\n]+)[^\n]*");
  exported.erase("RAINREF_0");  // the version
  const std::set<std::string> declared = matches(contents(test::source_folder() + "/include/rainref.h"), "\nRR_API [^(;]*?(rr_\\w+)\\(");
  EXPECT_GT(declared.size(), 30u);
  EXPECT_EQ(exported, declared);
  EXPECT_EQ(matches(contents(test::source_folder() + "/tests/c_library/client.h"), "X\\((rr_\\w+)\\)"), declared);
}
TEST_F(CLibrary, HasAVersionedName) {
  const auto [dynamic, status] = output_of("readelf -d " RAINREF_C_LIBRARY);
  EXPECT_EQ(status, 0);
  EXPECT_THAT(dynamic, testing::HasSubstr("soname: [librainref.so.0]"));
}

// What crosses the border is caught, and the caller's floating-point state kept, by c_library::call alone.
TEST_F(CLibrary, EveryFunctionThatMayFailGoesThroughOneDoor) {
  int checked = 0;
  const std::regex definition("\n(?:int|void) (rr_\\w+)\\([^{]*\\{\\s*([^\n]*)"), door("^(return )?call\\(.*|^return (open|report)\\(.*");
  for (const auto& entry : fs::directory_iterator(test::source_folder() + "/src/c_library")) {
    const std::string text = contents(entry.path());
    for (std::sregex_iterator i(text.begin(), text.end(), definition), end; i != end; ++i, ++checked)
      EXPECT_TRUE(std::regex_match((*i)[2].str(), door)) << (*i)[1] << ": " << (*i)[2];
  }
  EXPECT_GT(checked, 30);
}

TEST_F(CLibrary, GivesTheGoldenHashes) {
  for (const char* name : {"puddle_corrected", "windshield_corrected", "edge_splash_corrected", "edge_splash_published",
                           "screen_drops_corrected", "rainy_glass_corrected"})
    expect_success(fmt::format("golden {} {}", hashes(), scene(name)));
}
TEST_F(CLibrary, RunsInFourThreadsAtOnce) {
  expect_success(fmt::format("threads {} {} {} {} {}", hashes(), scene("puddle_corrected"), scene("windshield_corrected"),
                             scene("screen_drops_corrected"), scene("rainy_glass_corrected")));
}
TEST_F(CLibrary, GoesOnAfterFork) { expect_success(fmt::format("fork {} {}", hashes(), scene("puddle_corrected"))); }
TEST_F(CLibrary, HangsOnNoFloatingPointState) {
  for (const char* name :
       {"puddle_corrected", "windshield_corrected", "edge_splash_corrected", "screen_drops_corrected", "rainy_glass_corrected"})
    expect_success(fmt::format("states {} {}", hashes(), scene(name)));
}
TEST_F(CLibrary, RefusesBadArgumentsWithACodeAndASentence) {
  expect_success("refusals " + scene("edge_splash_corrected"));
  expect_success("refusals " + scene("puddle_corrected"));
}
TEST_F(CLibrary, ShowsBuffersWithoutCopies) {
  expect_success("views " + scene("puddle_corrected"));
  expect_success("views " + scene("windshield_corrected"));
}
TEST_F(CLibrary, SaysOfAWaveOf8BitsWhereItLies) { expect_success("wave_of_8_bits " + scene("puddle_corrected")); }
// Its threads may still run when it is closed.
TEST_F(CLibrary, MayBeClosedAndLoadedAgain) {
  expect_success("reload " + scene("puddle_corrected"));
  expect_success("reload " + scene("edge_splash_corrected"));
}
// As the command line does, unless it is told otherwise; and the bits are the same.
TEST_F(CLibrary, KeepsImagesForLaterRuns) {
  const TemporaryFolder cache;
  const auto run = [&](const std::string& keep) {
    const auto [text, status] = output_of(fmt::format("XDG_CACHE_HOME={} {} {} kept {} {}", (cache / "user").string(), RAINREF_C_CLIENT,
                                                      RAINREF_C_LIBRARY, scene("edge_splash_corrected"), keep));
    EXPECT_EQ(status, 0) << text;
    return text;
  };
  const auto count = [](const fs::path& folder) {
    return fs::exists(folder) ? std::distance(fs::directory_iterator(folder), fs::directory_iterator()) : 0;
  };
  const std::string without = run("none");
  EXPECT_FALSE(fs::exists(cache / "user"));
  EXPECT_EQ(run((cache / "own").string()), without);
  EXPECT_GT(count(cache / "own"), 0);
  EXPECT_FALSE(fs::exists(cache / "user"));
  const auto begin = fs::file_time_type::clock::now();
  for (int time = 0; time < 2; ++time) EXPECT_EQ(run("-"), without);
  EXPECT_EQ(count(cache / "user/rainref"), count(cache / "own"));
  for (const auto& entry : fs::directory_iterator(cache / "user/rainref"))
    EXPECT_GE(entry.last_write_time(), begin - std::chrono::seconds(1));
}
TEST_F(CLibrary, SavesLoadsAndSets) {
  for (const char* name :
       {"puddle_corrected", "windshield_corrected", "edge_splash_corrected", "screen_drops_corrected", "rainy_glass_corrected"})
    expect_success(fmt::format("saved {}", scene(name)));
}

// A callback of C++ may throw; the library, which is not written in its caller's C++, lets nothing of it through.
TEST_F(CLibrary, LetsNothingThroughThatACallbackThrows) {
  void* const library = ::dlopen(RAINREF_C_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  ASSERT_TRUE(library) << ::dlerror();
  const auto find = [&](auto* declared, const char* name) { return reinterpret_cast<decltype(declared)>(::dlsym(library, name)); };
  const auto open = find(&rr_open, "rr_open");
  const auto save = find(&rr_save, "rr_save");
  const auto load = find(&rr_load, "rr_load");
  const auto close = find(&rr_close, "rr_close");
  const auto error = find(&rr_error, "rr_error");
  rr_simulation* simulation = nullptr;
  ASSERT_EQ(open("effect = 'edge_splash'\nrun.size = [9, 9]\n", nullptr, &simulation), RR_OK) << error();
  const auto write = [](void*, const void*, size_t) -> int { throw 1; };
  const auto read = [](void*, void*, size_t) -> int64_t { throw std::bad_alloc(); };
  EXPECT_EQ(save(simulation, write, nullptr), RR_IO);
  EXPECT_STREQ(error(), "state: the callback that writes it threw an exception");
  EXPECT_EQ(load(simulation, read, nullptr), RR_IO);
  EXPECT_STREQ(error(), "state: the callback that reads it threw an exception");
  close(simulation);
  const auto judge = find(&rr_judge_folder, "rr_judge_folder");
  const std::string pack = test::pack_folder("edge_splash-corrected");
  const TemporaryFolder port;
  fs::copy(pack, port / "port", fs::copy_options::recursive);
  rr_folder_options options{};
  options.struct_bytes = sizeof options;
  options.progress = [](void*, int32_t, int32_t) -> int { throw 1; };
  rr_judgement* judgement = nullptr;
  EXPECT_EQ(judge(pack.c_str(), (port / "port").c_str(), &options, &judgement), RR_USAGE);
  EXPECT_STREQ(error(), "rr_folder_options.progress: the callback threw an exception");
  EXPECT_EQ(judgement, nullptr);
}
// The reports are those of the command line, of a port of which one pass fails and one has no files.
TEST_F(CLibrary, JudgesAFolderAsTheCommandLineDoes) {
  const TemporaryFolder folder;
  const fs::path pack = test::pack_folder("edge_splash-corrected"), port = folder / "port";
  fs::copy(pack, port, fs::copy_options::recursive);
  bool is_first = true;
  for (const auto& entry : fs::directory_iterator(port)) {
    const std::string name = entry.path().filename().string();
    if (name == "edge_splash.splash") fs::remove_all(entry.path());
    if (name != "edge_splash.display") continue;
    for (const auto& file : fs::recursive_directory_iterator(entry.path())) {
      if (!is_first || !file.path().filename().string().starts_with("out.")) continue;
      std::fstream bytes(file.path(), std::ios::in | std::ios::out | std::ios::binary);
      bytes.seekp(-5, std::ios::end).write("\x7f", 1);
      is_first = false;
    }
  }
  ASSERT_FALSE(is_first);
  expect_success(fmt::format("folder {} {} {}", pack.string(), port.string(), (folder / "c").string()));
  const auto cli = [&](const char* ending) { return (folder / "cli").string() + ending; };
  const auto [text, status] =
      output_of(fmt::format("{} validate {} --port {} --partial --json {} --html {} --junit {} >{}", RAINREF_PROGRAM, pack.string(),
                            port.string(), cli(".json"), cli(".html"), cli(".xml"), cli(".txt")));
  ASSERT_EQ(WEXITSTATUS(status), 1) << text;
  for (const char* ending : {".txt", ".json", ".html", ".xml"}) {
    std::string expected = contents(cli(ending)), found = contents((folder / "c").string() + ending);
    // The command line says how it was called.
    expected = std::regex_replace(expected, std::regex("\"command\": *\"[^\"]*\""), "\"command\": \"\"");
    found = std::regex_replace(found, std::regex("\"command\": *\"[^\"]*\""), "\"command\": \"\"");
    expected = std::regex_replace(expected, std::regex("\n[^\n]*<property name=\"command\"[^\n]*"), "");
    // How long it took differs from run to run.
    for (std::string* report : {&expected, &found}) *report = std::regex_replace(*report, std::regex(" time=\"[0-9.]+\""), "");
    EXPECT_FALSE(found.empty());
    EXPECT_TRUE(found == expected) << ending;
  }
}
TEST_F(CLibrary, JudgesOutputsInMemory) {
  expect_success("judging " + scene("edge_splash_corrected"));
  expect_success("judging " + scene("puddle_corrected"));
}

}  // namespace
}  // namespace rainref
