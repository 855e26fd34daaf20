// The documents: links and anchors resolve, and commands name verbs that exist.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/temporary_folder.h"

namespace {

using rainref::contents;

namespace fs = std::filesystem;
const fs::path root = RAINREF_SOURCE_DIR;

std::string name_of(const fs::path& file) { return fs::relative(file, root).string(); }

/// Every document of the repository: Markdown at its root and below these folders.
std::vector<fs::path> documents() {
  std::vector<fs::path> found;
  const auto take = [&](const fs::directory_entry& entry) {
    if (entry.is_regular_file() && entry.path().extension() == ".md") found.push_back(entry.path());
  };
  for (const auto& entry : fs::directory_iterator(root)) take(entry);
  for (const char* folder : {"docs", "bench", "examples", "src", "tests", "scenes", "scripts"}) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) take(entry);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// A document in two parts: what stands in fenced blocks, and the rest.
struct Parts {
  std::string prose, code;
};
Parts parts_of(const std::string& text) {
  Parts parts;
  bool is_code = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first != std::string::npos && line.compare(first, 3, "```") == 0) {
      is_code = !is_code;
    } else {
      (is_code ? parts.code : parts.prose) += line + '\n';
    }
  }
  return parts;
}
/// The prose without inline code, and that code alone.
Parts spans_of(const std::string& prose) {
  Parts parts;
  bool is_code = false;
  for (const char c : prose) {
    if (c == '`') is_code = !is_code;
    (is_code ? parts.code : parts.prose) += c == '`' ? '\n' : c;
  }
  return parts;
}

/// The anchor that a heading gets: lower case, hyphens for spaces, no punctuation.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ') {
      anchor += '-';
    } else if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80) {
      anchor += static_cast<char>(std::tolower(byte));
    }
  }
  return anchor;
}
std::set<std::string> anchors_of(const std::string& text) {
  std::set<std::string> anchors;
  std::istringstream lines(parts_of(text).prose);
  const std::regex heading("^#{1,6} +(.*)$");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, heading)) continue;
    const std::string anchor = anchor_of(match[1]);
    std::string free = anchor;
    for (int k = 1; !anchors.insert(free).second; ++k) free = anchor + "-" + std::to_string(k);
  }
  return anchors;
}

/// What stands in round brackets behind square ones.
std::vector<std::string> links_of(const std::string& text) {
  std::vector<std::string> links;
  const std::string prose = spans_of(parts_of(text).prose).prose;
  const std::regex link(R"(\]\(([^)\s]+)\))");
  for (std::sregex_iterator i(prose.begin(), prose.end(), link), end; i != end; ++i) links.push_back((*i)[1]);
  return links;
}
/// Why a link of this document leads nowhere, or "".
std::string broken_link(const fs::path& document, const std::string& link) {
  if (std::regex_search(link, std::regex("^[a-z]+:"))) return "";
  const std::size_t hash = link.find('#');
  const std::string path = link.substr(0, hash);
  const fs::path target = path.empty() ? document : (document.parent_path() / path).lexically_normal();
  if (!fs::exists(target)) return "no such file";
  if (name_of(target).starts_with("..")) return "outside the repository";
  if (hash == std::string::npos) return "";
  return anchors_of(contents(target)).contains(link.substr(hash + 1)) ? "" : "no such heading";
}

/// The verbs of the command line, from its own source.
std::set<std::string> verbs() {
  std::set<std::string> found{"help"};
  const std::regex verb("add_subcommand\\(\"([a-z]+)\"");
  for (const auto& file : fs::directory_iterator(root / "src/cli")) {
    if (!file.is_regular_file()) continue;
    const std::string source = contents(file.path());
    for (std::sregex_iterator i(source.begin(), source.end(), verb), end; i != end; ++i) found.insert((*i)[1]);
  }
  return found;
}
/// The words behind `rainref` in code, blocks and spans alike.
std::vector<std::string> called_verbs(const std::string& text) {
  const Parts parts = parts_of(text);
  const std::string code = parts.code + spans_of(parts.prose).code;
  std::vector<std::string> found;
  const std::regex call("\\brainref +([a-z]+)");
  for (std::sregex_iterator i(code.begin(), code.end(), call), end; i != end; ++i) found.push_back((*i)[1]);
  return found;
}

TEST(Documents, TheCitationHasTheVersion) {
  const std::string citation = contents(root / "CITATION.cff"), header = contents(root / "include/rainref/version.h");
  std::string version;
  const std::regex number("#define RAINREF_VERSION_[A-Z]+ ([0-9]+)");
  for (std::sregex_iterator m(header.begin(), header.end(), number), end; m != end; ++m)
    version += (version.empty() ? "" : ".") + (*m)[1].str();
  EXPECT_TRUE(std::regex_search(citation, std::regex("\nversion: " + version + "\n"))) << version;
}

TEST(Documents, LinksResolve) {
  int checked = 0;
  for (const fs::path& document : documents()) {
    for (const std::string& link : links_of(contents(document))) {
      EXPECT_EQ(broken_link(document, link), "") << name_of(document) << ": " << link;
      ++checked;
    }
  }
  EXPECT_GT(checked, 50);
}

TEST(Documents, CommandsNameVerbsThatExist) {
  const std::set<std::string> known = verbs();
  ASSERT_TRUE(known.contains("validate"));
  int checked = 0;
  for (const fs::path& document : documents()) {
    if (document.filename() == "CHANGELOG.md") continue;  // tells of what was
    for (const std::string& verb : called_verbs(contents(document))) {
      EXPECT_TRUE(known.contains(verb)) << name_of(document) << ": rainref " << verb;
      ++checked;
    }
  }
  EXPECT_GT(checked, 30);
}

TEST(Documents, PicturesAreShown) {
  std::set<fs::path> shown;
  for (const fs::path& document : documents()) {
    for (const std::string& link : links_of(contents(document))) shown.insert((document.parent_path() / link).lexically_normal());
  }
  for (const auto& entry : fs::directory_iterator(root / "docs/images")) {
    EXPECT_TRUE(shown.contains(entry.path().lexically_normal())) << name_of(entry.path());
  }
}

// Sources name documents in their comments.
TEST(Documents, SourcesNameDocumentsThatExist) {
  int checked = 0;
  const fs::path here = root / "tests/structure/documents_test.cpp";  // names some that must not be there
  for (const char* folder : {"src", "include", "tests", "bench", "scripts"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (!entry.is_regular_file() || entry.path() == here ||
          (extension != ".h" && extension != ".cpp" && extension != ".txt" && !extension.empty()))
        continue;
      const std::string text = contents(entry.path());
      for (std::size_t at = 0; (at = text.find("docs/", at)) != std::string::npos; ++at) {
        const std::size_t end = text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_/", at);
        if (end == std::string::npos || text.compare(end, 3, ".md") != 0) continue;
        const std::string document = text.substr(at, end + 3 - at);
        EXPECT_TRUE(fs::exists(root / document)) << name_of(entry.path()) << ": " << document;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 10);
}

/// Why what stands in backticks in statements.txt is nowhere, or "": a file, a scene key of an effect, or a suite of tests.
std::string missing_place(const std::string& place, const std::string& manifests, const std::string& tests) {
  if (place.find('/') != std::string::npos && std::regex_search(place, std::regex("\\.(h|cpp|toml)$")))
    return fs::exists(root / place) || fs::exists(root / "src" / place) ? "" : "no such file";
  if (std::regex_match(place, std::regex("[a-z]+(_[a-z]+)*\\.[a-z_]+")))
    return manifests.find('"' + place + "\":") != std::string::npos ? "" : "no such key";
  std::smatch suite;
  if (std::regex_match(place, suite, std::regex("([A-Z][A-Za-z]+)(\\.[A-Za-z0-9]+)?")))
    return tests.find("(" + suite[1].str() + ", " + (suite[2].length() > 0 ? suite[2].str().substr(1) : "")) != std::string::npos
               ? ""
               : "no such test";
  return "";
}
TEST(Documents, TheSourcesNamePlacesThatExist) {
  // The small packs hold every key of both variants as the program knows it.
  std::string manifests, tests;
  for (const auto& pack : fs::directory_iterator(RAINREF_PACKS)) manifests += contents(pack.path() / "manifest.json");
  for (const auto& file : fs::recursive_directory_iterator(root / "tests"))
    if (file.path().extension() == ".cpp") tests += contents(file.path());
  const std::string prose = parts_of(contents(root / "tests/structure/statements.txt")).prose;
  std::istringstream places(spans_of(prose).code);
  int checked = 0;
  for (std::string place; std::getline(places, place);) {
    if (place.empty()) continue;
    EXPECT_EQ(missing_place(place, manifests, tests), "") << place;
    ++checked;
  }
  EXPECT_GT(checked, 150);
  EXPECT_EQ(missing_place("puddle/nowhere.h", manifests, tests), "no such file");
  EXPECT_EQ(missing_place("puddle.nowhere", manifests, tests), "no such key");
  EXPECT_EQ(missing_place("NoSuchSuite.OfTests", manifests, tests), "no such test");
}

/// A build folder somewhere below the root, or what lies in somebody's home or in /tmp.
bool names_a_folder(const std::string& text, std::smatch& path) {
  static const std::regex folder("/[A-Za-z0-9_/.-]+/build/[a-z]+/|(^|[^A-Za-z0-9_.~/-])/(tmp|root|home)/[A-Za-z0-9_.-]+");
  return std::regex_search(text, path, folder);
}
// What a machine wrote into a document or a kept run names nobody's folders.
TEST(Documents, NameNoFolderOfAMachine) {
  int read = 0;
  for (const auto& file : fs::recursive_directory_iterator(root / "docs")) {
    if (file.path().extension() != ".md" && file.path().extension() != ".json") continue;
    const std::string text = contents(file.path());
    std::smatch path;
    EXPECT_FALSE(names_a_folder(text, path)) << name_of(file.path()) << ": " << path[0];
    ++read;
  }
  EXPECT_GT(read, 20);
}

TEST(Documents, TheCheckOfFoldersRefuses) {
  std::smatch path;
  for (const std::string text : {"in /tmp/d/lib,", "'/root/a'", "/home/me/x", "at /x/build/release/bin"})
    EXPECT_TRUE(names_a_folder(text, path)) << text;
  for (const std::string text : {"build/release/bin", "a/tmp/b", "https://x.org/root/a", "/usr/lib", "/tmp"})
    EXPECT_FALSE(names_a_folder(text, path)) << text;
}

// The checker itself: it must refuse what it is there to refuse.
TEST(Documents, TheChecksRefuse) {
  const fs::path readme = root / "README.md";
  EXPECT_EQ(broken_link(readme, "docs/porting.md"), "");
  EXPECT_EQ(broken_link(readme, "docs/nowhere.md"), "no such file");
  EXPECT_EQ(broken_link(readme, "docs/porting.md#nowhere"), "no such heading");
  EXPECT_EQ(broken_link(readme, "https://example.org/nowhere"), "");
  EXPECT_EQ(anchor_of("Judging a port's own run"), "judging-a-ports-own-run");
  EXPECT_EQ(anchors_of("# A b\n```\n# c\n```\n## A b\n"), (std::set<std::string>{"a-b", "a-b-1"}));
  EXPECT_EQ(links_of("[a](b.md) `[c](d.md)`\n```\n[e](f.md)\n```\n"), std::vector<std::string>{"b.md"});
  EXPECT_EQ(called_verbs("`rainref list`, `rainref` `is`, rainref is\n```\nrainref run x\n```\n"),
            (std::vector<std::string>{"run", "list"}));
}

}  // namespace
