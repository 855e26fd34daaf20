// The floors: an include points down or stays in its room, and each library is named in one room only.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
const fs::path root = RAINREF_SOURCE_DIR;

// Rooms and their floors; ARCHITECTURE.md has the same table.
const std::map<std::string, int> floors{{"base", 0},         {"math", 1},       {"image", 2},      {"parallel", 3},    {"random", 3},
                                        {"cache", 3},        {"state", 3},      {"scene", 4},      {"capture", 4},     {"pass", 4},
                                        {"image_io", 4},     {"effect", 4},     {"rain", 4},       {"drops", 4},       {"blur_pyramid", 4},
                                        {"night_street", 6}, {"puddle", 5},     {"windshield", 5}, {"edge_splash", 5}, {"screen_drops", 5},
                                        {"rainy_glass", 5},  {"compositor", 5}, {"registry", 6},   {"truth", 6},       {"port_dump", 6},
                                        {"simulation", 7},   {"judge", 7},      {"faults", 7},     {"reports", 7},     {"cli", 8},
                                        {"c_library", 8},    {"judging", 7},    {"sweep", 8},      {"spirv", 6},       {"foreign", 6}};
// Public headers, by the floor that implements them.
const std::map<std::string, int> public_floors{{"version", 0},      {"error", 0},       {"variant", 0},    {"storage", 1},
                                               {"image", 2},        {"texture", 2},     {"recorder", 2},   {"executor", 3},
                                               {"scene_text", 4},   {"puddle", 5},      {"windshield", 5}, {"edge_splash", 5},
                                               {"screen_drops", 5}, {"rainy_glass", 5}, {"simulation", 7}, {"judging", 7}};
// A room may include these of its own floor; every other pair of rooms on one floor keeps apart.
const std::map<std::string, std::vector<std::string>> neighbours{{"capture", {"scene"}},
                                                                 {"pass", {"capture", "scene"}},
                                                                 {"drops", {"capture", "pass", "rain", "scene"}},
                                                                 {"blur_pyramid", {"capture", "pass", "scene"}},
                                                                 {"effect", {"capture", "image_io", "scene"}},
                                                                 {"foreign", {"registry", "spirv"}},
                                                                 {"faults", {"judge"}},
                                                                 {"reports", {"faults", "judge"}},
                                                                 {"judging", {"faults", "judge", "reports", "simulation"}},
                                                                 {"cli", {"sweep"}}};

struct Library {
  const char* pattern;
  const char* room;
};
const std::vector<Library> libraries{{"^(oneapi/)?tbb/", "parallel"},
                                     {"^hwy/", "math"},
                                     {"^OpenImageIO/|^Imath/|^OpenEXR/|^png\\.h|^jpeglib\\.h|^zlib\\.h", "image_io"},
                                     {"^embree", "compositor"},
                                     {"^toml", "scene"},
                                     {"^CLI/", "cli"},
                                     {"^xxhash", "base"},
                                     {"^sqlite3", "sweep"},
                                     {"^httplib", "cli"}};

struct Include {
  fs::path file;
  int line;
  std::string target;
};
/// Calls f(file below the root, number, line) for every line of every file below a folder.
template <class F>
void for_each_line(const fs::path& folder, const F& f) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path());
    int number = 0;
    for (std::string line; std::getline(in, line);) f(fs::relative(entry.path(), root), ++number, line);
  }
}
std::vector<Include> includes_below(const fs::path& folder) {
  std::vector<Include> found;
  const std::regex pattern("^\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"]");
  for_each_line(folder, [&](const fs::path& file, int number, const std::string& line) {
    std::smatch match;
    if (std::regex_search(line, match, pattern)) found.push_back({root / file, number, match[1]});
  });
  return found;
}
std::string room_of(const fs::path& file) { return fs::relative(file, root / "src").begin()->string(); }
std::string at(const Include& i) { return fs::relative(i.file, root).string() + ":" + std::to_string(i.line) + " includes " + i.target; }

// The room and floor of an include, or floor -1 for a system header.
std::pair<std::string, int> target_of(const std::string& target) {
  if (target.starts_with("rainref/")) {
    const std::string stem = fs::path(target).stem().string();
    const auto found = public_floors.find(stem);
    return {stem, found == public_floors.end() ? 99 : found->second};
  }
  const std::string first = fs::path(target).begin()->string();
  const auto found = floors.find(first);
  return found == floors.end() || first == target ? std::pair<std::string, int>{"", -1} : std::pair<std::string, int>{first, found->second};
}

// Why this include breaks the rules, or "".
std::string broken_rule(const std::string& room, const std::string& target) {
  const auto from = floors.find(room);
  if (from == floors.end()) return "room without a floor";
  const auto [to_room, to_floor] = target_of(target);
  if (to_floor < 0 || to_room == room) return "";
  if (to_floor == 99) return "public header without a floor";
  if (to_floor > from->second) return "upward include";
  if (to_floor == from->second && !target.starts_with("rainref/")) {
    const auto allowed = neighbours.find(room);
    if (allowed == neighbours.end() || std::find(allowed->second.begin(), allowed->second.end(), to_room) == allowed->second.end()) {
      return "rooms of one floor keep apart";
    }
  }
  return "";
}

TEST(Layers, IncludesPointDown) {
  int checked = 0;
  for (const Include& include : includes_below(root / "src")) {
    EXPECT_EQ(broken_rule(room_of(include.file), include.target), "") << at(include);
    ++checked;
  }
  EXPECT_GT(checked, 100);
}

TEST(Layers, PublicHeadersIncludePublicHeadersOnly) {
  for (const Include& include : includes_below(root / "include")) {
    const auto [room, floor] = target_of(include.target);
    EXPECT_TRUE(floor < 0 || include.target.starts_with("rainref/")) << at(include);
  }
}

TEST(Layers, EachLibraryIsNamedInOneRoom) {
  for (const Include& include : includes_below(root / "src")) {
    for (const Library& library : libraries) {
      if (std::regex_search(include.target, std::regex(library.pattern))) {
        EXPECT_EQ(room_of(include.file), library.room) << at(include);
      }
    }
  }
}

// A room's parts: each of its sub-rooms as a whole, and of the files beside them those of one stem.
std::string part_of(const std::string& file) {
  const std::size_t room = file.find('/') + 1, next = file.find_first_of("/.", room);
  return file.substr(0, next);
}
using Arrows = std::map<std::string, std::set<std::string>>;
/// Whether includes lead from `part` to `sought`, over any parts of its room.
bool leads_to(const Arrows& arrows, const std::string& part, const std::string& sought, std::set<std::string>& seen) {
  const auto from = arrows.find(part);
  if (from == arrows.end() || !seen.insert(part).second) return false;
  return std::any_of(from->second.begin(), from->second.end(),
                     [&](const std::string& to) { return to == sought || leads_to(arrows, to, sought, seen); });
}
bool is_in_a_circle(const Arrows& arrows, const std::string& part) {
  std::set<std::string> seen;
  return leads_to(arrows, part, part, seen);
}

TEST(Layers, SubRoomsAreInNoCircle) {
  Arrows arrows;
  std::set<std::string> sub_rooms;
  for (const Include& include : includes_below(root / "src")) {
    const std::string file = fs::relative(include.file, root / "src").string(), part = part_of(file), to = part_of(include.target);
    if (file.starts_with(part + "/")) sub_rooms.insert(part);
    if (to != part && include.target.starts_with(room_of(include.file) + "/")) arrows[part].insert(to);
  }
  for (const std::string& part : sub_rooms) EXPECT_FALSE(is_in_a_circle(arrows, part)) << part;
  EXPECT_TRUE(sub_rooms.contains("image_io/openimageio"));
  EXPECT_TRUE(sub_rooms.contains("image_io/direct"));

  EXPECT_EQ(part_of("windshield/motion/glass.h"), "windshield/motion");
  EXPECT_EQ(part_of("windshield/uniforms.h"), "windshield/uniforms");
  EXPECT_TRUE(is_in_a_circle({{"a/x", {"a/y"}}, {"a/y", {"a/z"}}, {"a/z", {"a/x"}}}, "a/x"));
  EXPECT_FALSE(is_in_a_circle({{"a/x", {"a/y"}}, {"a/y", {"a/z"}}, {"a/z", {"a/y"}}}, "a/x"));
}

// The checker itself: it must refuse what it is there to refuse.
TEST(Layers, TheRulesRefuse) {
  EXPECT_EQ(broken_rule("math", "puddle/host.h"), "upward include");
  EXPECT_EQ(broken_rule("image", "rainref/puddle.h"), "upward include");
  EXPECT_EQ(broken_rule("puddle", "windshield/host.h"), "rooms of one floor keep apart");
  EXPECT_EQ(broken_rule("scene", "image_io/read.h"), "rooms of one floor keep apart");
  EXPECT_EQ(broken_rule("rainy_glass", "night_street/night_street.h"), "upward include") << "the street is an input";
  EXPECT_EQ(broken_rule("attic", "base/hash.h"), "room without a floor");
  EXPECT_EQ(broken_rule("puddle", "image/texture.h"), "");
  EXPECT_EQ(broken_rule("cli", "vector"), "");
}

/// Words that only some files may have.
struct Kept {
  const char *name, *words;
  bool in_public_headers_too, in_comments_too;
  std::vector<std::string> where;  ///< beginnings of those files
  friend void PrintTo(const Kept& k, std::ostream* out) { *out << k.name; }
};
const std::vector<Kept> kept_words{
    // What came from ports, packs and file names must not command a terminal: all text passes cli/terminal.cpp.
    {"OnlyTheTerminalPrints",
     "fmt::print\\(|std::(cout|cerr|clog)|\\b(printf|fprintf|puts|fputs|putchar|fputc)\\(|fwrite\\(.*(stdout|stderr)",
     false,
     true,
     {"src/cli/terminal.cpp", "src/cli/progress.cpp"}},
    // Which machine and compiler it is, only files ask that CMake chooses; the processor's floating-point unit, threads and rays have some.
    // The thread sanitizer sees nothing of Embree's threads.
    {"OnlySeamsAskForThePlatform",
     "__x86_64__|__i386__|__aarch64__|__arm__|__wasm|__EMSCRIPTEN__|_M_X64|__linux__|__APPLE__|_WIN32|__SANITIZE|__has_feature",
     true,
     true,
     {"src/compositor/tracer_embree.cpp", "include/rainref.h"}},
    // capture/json_read.h looks at size and depth first.
    {"JsonIsReadInOnePlace", "[jJ]son::(parse|accept|sax_parse|from_)", false, true, {"src/capture/json_read.cpp"}},
    // A library's reader says in one way or another that a number was too large, and is not always asked; base/number_text.h always asks.
    {"TextsBecomeNumbersInOnePlace",
     "\\b(from_chars|sto(i|l|ll|ul|ull|f|d|ld)|strto(l|ll|ul|ull|f|d|ld|imax|umax)|ato(i|l|ll|f)|s?scanf)\\(",
     true,
     false,
     {"src/base/number_text"}},
    // On Windows a path is UTF-16 with backslashes, and its own functions take and give text in the code page. There base/utf8_paths_only.h
    // keeps the compiler from making paths of text.
    {"PathsBecomeTextsInOnePlace", "(\\.|->)(generic_)?(u8|w)?string\\(\\)|\\bu8path\\(", true, false, {"src/base/path_text.cpp"}},
    // What would change bits between machines.
    {"KernelsHaveNoForbiddenWords",
     "std::(sin|cos|tan|exp|exp2|log|log2|pow|atan|atan2|hypot|fma|cbrt)\\(|MulAdd|NegMulAdd|ApproximateReciprocal|SumOfLanes|MinOfLanes|"
     "MaxOfLanes|"
     "parallel_reduce|std::hash|unordered_map|unordered_set|random_device|mt19937|long double|march=native|ffast-math",
     false,
     false,
     {}}};
class KeptWords : public testing::TestWithParam<Kept> {};
INSTANTIATE_TEST_SUITE_P(Layers, KeptWords, testing::ValuesIn(kept_words), [](const auto& tested) { return tested.param.name; });

TEST_P(KeptWords, StandWhereTheyMay) {
  const Kept& kept = GetParam();
  const std::regex words(kept.words);
  for (const char* top : {"src", "include"}) {
    if (top == std::string("include") && !kept.in_public_headers_too) continue;
    for_each_line(root / top, [&](const fs::path& file, int number, const std::string& line) {
      const std::string name = file.string();
      if (std::any_of(kept.where.begin(), kept.where.end(), [&](const std::string& may) { return name.starts_with(may); })) return;
      if (!kept.in_comments_too && line.find("#error") != std::string::npos) return;
      if (line.find("Lanes minus_four_times(Lanes a, Lanes b)") != std::string::npos) return;  // rounds once, fused or not
      EXPECT_FALSE(std::regex_search(kept.in_comments_too ? line : line.substr(0, line.find("//")), words))
          << name << ":" << number << ": " << line;
    });
  }
}

// What CMake chooses among is there.
TEST(Layers, SeamsHaveSeveralFiles) {
  std::ifstream in(root / "src/CMakeLists.txt");
  const std::regex chosen("^ *rainref_seam\\(([a-z_]+(?:/[a-z_]+)+) ([a-z0-9_]+)\\)");
  std::map<std::string, int> files;
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (!std::regex_search(line, match, chosen)) continue;
    const fs::path file = root / "src" / (match[1].str() + "_" + match[2].str() + ".cpp");
    EXPECT_TRUE(fs::exists(file)) << line;
    ++files[match[1]];
  }
  EXPECT_EQ(files.size(), 25u);
  for (const auto& [stem, count] : files) EXPECT_GE(count, 2) << stem;
}

/// Vectors of a pass text, named or not, made by parentheses of arguments that are computed: which of them first is the compiler's choice.
std::vector<std::string> unordered_vectors(const std::string& text) {
  std::vector<std::string> found;
  const std::regex made("\\b(Vec3|Two)(<N>)?( [a-z_0-9]+)?\\(");
  for (std::sregex_iterator at(text.begin(), text.end(), made), none; at != none; ++at) {
    const auto first = static_cast<std::size_t>(at->position()), begin = first + static_cast<std::size_t>(at->length());
    if (text.substr(0, first).ends_with("RAINREF_FN ")) continue;  // a constructor, or a function that gives one
    std::size_t end = begin;
    int depth = 1, parts = 1;
    for (; end < text.size() && depth > 0; ++end) {
      depth += text[end] == '(' || text[end] == '[' || text[end] == '{';
      depth -= text[end] == ')' || text[end] == ']' || text[end] == '}';
      parts += depth == 1 && text[end] == ',';
    }
    const std::string inside = text.substr(begin, end - begin - 1);
    if (parts > 1 && inside.find_first_of("(+*/-") != std::string::npos) found.push_back(text.substr(first, end - first));
  }
  return found;
}

// The diagnosis counts operations that are alike in the order in which they are made, so that order is in its words.
TEST(Layers, PassTextsMakeComponentsInOneOrder) {
  for (const auto& entry : fs::recursive_directory_iterator(root / "src")) {
    const std::string file = fs::relative(entry.path(), root / "src").string();
    if (!file.ends_with("-inl.h") && !file.ends_with(".pass.h")) continue;
    std::ifstream in(entry.path());
    std::string text;
    for (std::string line; std::getline(in, line);) text += line.substr(0, line.find("//")) + "\n";
    for (const std::string& one : unordered_vectors(text)) ADD_FAILURE() << file << ": in braces instead: " << one;
  }
  EXPECT_EQ(unordered_vectors("a = Vec3<N>(x + y,\n z, z); const Vec3<N> p(x, -y, z);").size(), 2u);
  EXPECT_EQ(unordered_vectors("a = Vec3<N>{x + y, z, z} + Vec3<N>(c[0], c[1], c[2]) + Vec3<N>(f(x)); RAINREF_FN Vec3(N x, N* y)").size(),
            0u);
}

}  // namespace
