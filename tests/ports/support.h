// Runs the ports and asks the judge, as a user does.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/temporary_folder.h"
#include "shipped_packs.h"

namespace rainref::ports {

namespace fs = std::filesystem;
using test::PackPasses, test::pack_folder, test::packed_effects, test::proven_packs;
inline const std::string source = RAINREF_SOURCE_DIR, spirv = RAINREF_SPIRV, examples = source + "/examples/ports";
inline std::string pack_of(const std::string& variant, const std::string& effect = "puddle") { return pack_folder(effect + "-" + variant); }

struct Outcome {
  int code;
  std::string text;  ///< standard output and error
};
inline Outcome call(const std::string& command) {
  const TemporaryFolder folder;
  const fs::path log = folder / "log";
  const int status = std::system((command + " >'" + log.string() + "' 2>&1").c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(log)};
}
// The software device, the same on every machine. A driver is not built with sanitizers: it leaks what it keeps, and its threads
// look like races; the runner itself has one thread.
inline const std::string quiet = "ASAN_OPTIONS=detect_leaks=0 TSAN_OPTIONS=report_bugs=0 ";
inline Outcome run_port(const std::string& pack, const fs::path& out, const std::string& more = "", const std::string& folder = "puddle") {
  return call(quiet + RAINREF_PORT_RUNNER " --device cpu --pack '" + pack + "' --spirv '" + spirv + "/" + folder + "' --out '" +
              out.string() + "' " + more);
}
/// port_mutants on a file of tests/ports/mutants, or another one.
inline Outcome run_mutants(const fs::path& file, const std::string& ids, const std::string& more = "") {
  return call(quiet + RAINREF_PORT_MUTANTS " --device cpu --glslang '" RAINREF_GLSLANG "' --mutants '" +
              (fs::path(source) / "tests/ports/mutants" / file).string() + "' --packs '" + test::packs_folder() + "' --ports '" + examples +
              "' --spirv '" + spirv + "' --ids " + ids + " " + more);
}
/// The same, and each is judged.
inline Outcome judge_mutants(const std::string& file, const std::string& ids) {
  const TemporaryFolder folder;
  return run_mutants(file, ids, "--rainref '" RAINREF_PROGRAM "' --out '" + folder.path().string() + "'");
}
inline Outcome judge(const std::string& pack, const fs::path& port, const std::string& more = "") {
  return call(RAINREF_PROGRAM " validate '" + pack + "' --port '" + port.string() + "' " + more);
}

/// What a file of tests/ports/mutants says is complete, each mutant once. Gives their number.
inline std::size_t check_mutants(const std::string& file) {
  const auto all = nlohmann::json::parse(contents(source + "/tests/ports/mutants/" + file))["mutants"];
  std::vector<std::string> names;
  for (const auto& m : all) {
    names.push_back(m["id"].dump() + m["pass"].dump() + m["variant"].dump());
    const std::vector<std::string> verdicts{"FAIL",    "equivalent", "below-storage-ulp", "inside-envelope", "inside-rearrangements",
                                            "UNTESTED"};
    EXPECT_THAT(verdicts, testing::Contains(m["expected"])) << m;
    EXPECT_EQ(m["expected"] != "FAIL", m.contains("reason")) << m;
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  return all.size();
}

/// Uniform blocks and records in an effect's shaders are what describe prints for this version. Gives their number.
inline int check_blocks(const std::string& effect) {
  const std::string described = call(RAINREF_PROGRAM " describe " + effect + " --layout glsl").text;
  int blocks = 0;
  for (const auto& file : fs::directory_iterator(examples + "/" + effect)) {
    const std::string text = contents(file.path());
    for (const std::string opening :
         {"layout(std140, binding = 0) uniform ", "struct Drop {", "struct Wiper {", "struct Glint {", "struct Neck {",
          "struct GlassFrame {", "struct Streak {", "struct Tap {", "struct Droplet {", "struct Trail {"}) {
      const std::size_t begin = text.find(opening);
      if (begin == std::string::npos) continue;
      const std::string block = text.substr(begin, text.find("\n}", begin) + 2 - begin);
      EXPECT_THAT(described, testing::HasSubstr(block)) << file.path();
      ++blocks;
    }
  }
  return blocks;
}

}  // namespace rainref::ports
