// A second hand for the reference: the example ports, executed in float, have the bits of our models on every small pack. Programs and
// packs are found by their files.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "capture/pack_read.h"
#include "image/code_range.h"
#include "shipped_packs.h"
#include "spirv/bindings.h"

namespace rainref::spirv {
namespace {

namespace fs = std::filesystem;
using capture::Array, capture::CaseOutput, capture::PassCase;

// ---- where a port and our model differ -----------------------------------------------------------------------------
// Each row says by which rounding. u = 2^-24: a rounded operation is off by u of its result, at most. Nothing else may differ, and each row
// is needed. Codes are floats or halves counted in order.
struct Difference {
  const char *formula, *output, *reason;
  int codes;      ///< that a value may be off
  double places;  ///< or, of a place in space, u times this of its distance from the eye and from the origin
};
const std::vector<Difference> differences{
    // The share of the cycle is off by 3 u, its root by half of that and two roundings, the radius by two more: 5.5 u, and a code is at
    // least u.
    {"screen_drops.cells.corrected/1", "cells", "divides by `impact`; our model multiplies by its reciprocal", 5, 0},
    // The sum of all that stands before the lookup is off by some u; what the lookup finds, a half, is then one code off where it lies
    // between two of them.
    {"rainy_glass.rain_on_glass.corrected/1", "colour",
     "divides by `impact`, by half_width and by lengths; our model multiplies by reciprocals", 1, 0},
    // The ray's parameter is off by 3 u, product and sum by u each, and the end is rounded: 7 u.
    {"puddle.surface_hit.corrected/2", "hit", "divides by the ray's fall; our model multiplies by its reciprocal", 0, 7},
    // Looked up at that place.
    {"puddle.surface_hit.corrected/2", "normal", "is looked up at a place that is some roundings off", 1, 0},
};

/// One program on one case.
struct PortRun {
  std::string name;  ///< "puddle-sun, puddle.display/0011.0, hlsl"
  std::string formula;
  std::string wrong;  ///< what is not as it should be; "": nothing
  std::set<const Difference*> used;
};

struct Folder {
  std::string name;
  std::map<std::string, Program> programs;
};
std::vector<Folder> folders() {
  std::vector<Folder> found;
  for (const auto& entry : fs::directory_iterator(RAINREF_SPIRV))
    if (fs::exists(entry.path() / "bindings.json")) found.push_back({entry.path().filename().string(), read_programs(entry.path())});
  return found;
}

using Record = std::vector<std::byte>;
std::vector<Record> elements(const Array& a) {
  std::vector<Record> out;
  const auto size = static_cast<std::ptrdiff_t>(a.element_bytes());
  for (auto at = a.levels.at(0).begin(); at != a.levels[0].end(); at += size) out.emplace_back(at, at + size);
  return out;
}
double value_of(FormatInfo::Kind kind, const std::byte* at) {
  float x = 0;
  if (kind == FormatInfo::float32) std::memcpy(&x, at, sizeof x);
  return x;
}
bool is_allowed(const Difference& d, const PassCase& c, FormatInfo::Kind kind, int channel, const std::byte* got,
                const std::byte* expected) {
  if (std::abs(enclosed::ordered_code(kind, got) - enclosed::ordered_code(kind, expected)) <= d.codes) return true;
  if (d.places == 0 || channel > 2) return false;
  float eye = 0;
  std::memcpy(&eye, c.uniforms.data() + 4 * channel, sizeof eye);  // camera_position is the block's first member
  const double x = value_of(kind, got), y = value_of(kind, expected);
  return std::abs(x - y) <= d.places * 0x1p-24 * (std::abs(y) + std::abs(eye));
}

void compare(const PassCase& c, const CaseOutput& expected, const Array& got, PortRun& run) {
  if (got.levels.at(0).size() != expected.array.levels.at(0).size()) {
    run.wrong += fmt::format("{}: {} bytes for {}; ", expected.name, got.levels[0].size(), expected.array.levels[0].size());
    return;
  }
  std::vector<Record> ours = elements(got), theirs = elements(expected.array);
  // The order of such a list is no part of it.
  if (expected.judge == capture::Judge::keyed && expected.array.is_records) {
    std::sort(ours.begin(), ours.end());
    std::sort(theirs.begin(), theirs.end());
  }
  const auto row = std::find_if(differences.begin(), differences.end(),
                                [&](const Difference& d) { return run.formula == d.formula && expected.name == d.output; });
  const FormatInfo& format = info(expected.array.format);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    if (ours[i] == theirs[i]) continue;
    bool is_explained = row != differences.end() && !expected.array.is_records;
    for (int k = 0; is_explained && k < format.channels; ++k) {
      const int at = k * format.channel_bytes;
      is_explained = is_allowed(*row, c, format.kind, k, ours[i].data() + at, theirs[i].data() + at);
    }
    wrong += !is_explained;
    if (is_explained) run.used.insert(&*row);
  }
  if (wrong > 0) run.wrong += fmt::format("{}: {} of {} differ; ", expected.name, wrong, ours.size());
}

/// All programs on all cases of all packs, once for all tests: 20 s of one processor.
const std::vector<PortRun>& runs() {
  static const std::vector<PortRun> all = [] {
    std::vector<PortRun> made;
    const std::vector<Folder> ports = folders();
    for (const test::PackPasses& p : test::shipped_packs()) {
      const capture::Pack pack(test::pack_folder(p.name));
      for (const capture::PackCase& entry : pack.cases) {
        const PassCase c = pack.read(entry);
        for (const Folder& folder : ports) {
          const auto found = folder.programs.find(pack.pass(entry.pass).formula);
          if (found == folder.programs.end()) continue;
          const Program& program = found->second;
          PortRun& run = made.emplace_back(PortRun{p.name + ", " + c.folder() + ", " + folder.name, found->first, "", {}});
          try {
            const std::vector<Array> outputs = execute(c, program, read_spirv(program), "'" + program.spirv.filename().string() + "'");
            for (std::size_t o = 0; o < outputs.size(); ++o) compare(c, *c.output(program.outputs[o]), outputs[o], run);
          } catch (const Error& e) {
            run.wrong = e.what();
          }
        }
      }
    }
    return made;
  }();
  return all;
}

class ExamplePorts : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(RAINREF_SPIRV) == "") GTEST_SKIP() << "needs glslangValidator";
  }
};

TEST_F(ExamplePorts, HaveTheBitsOfOurModels) {
  for (const PortRun& run : runs()) EXPECT_EQ(run.wrong, "") << run.name;
  EXPECT_GT(runs().size(), 400u);
}
TEST_F(ExamplePorts, AllRanOnSomePack) {
  std::set<std::string> ran;
  for (const PortRun& run : runs()) ran.insert(run.formula + " in " + run.name.substr(run.name.rfind(' ') + 1));
  std::size_t programs = 0;
  for (const Folder& folder : folders()) {
    for (const auto& [formula, program] : folder.programs) {
      EXPECT_TRUE(ran.contains(formula + " in " + folder.name)) << formula << " in " << folder.name;
      ++programs;
    }
  }
  EXPECT_GE(programs, 67u);
}
TEST_F(ExamplePorts, DifferWhereTheTableSaysAndOnlyThere) {
  std::set<const Difference*> used;
  for (const PortRun& run : runs()) used.insert(run.used.begin(), run.used.end());
  for (const Difference& d : differences)
    EXPECT_TRUE(used.contains(&d)) << d.formula << ", " << d.output << ": has our bits now; take the row away";
}
// The comparison can fail: a program of another pass, and one of the other variant.
TEST_F(ExamplePorts, OfAnotherFormulaDiffer) {
  const capture::Pack pack(test::pack_folder("puddle-corrected"));
  const auto entry = std::find_if(pack.cases.begin(), pack.cases.end(), [](const capture::PackCase& c) { return c.pass == "display"; });
  const PassCase c = pack.read(*entry);
  Program program = read_programs(fs::path(RAINREF_SPIRV) / "puddle").at("puddle.display.corrected/1");
  program.spirv = program.spirv.parent_path() / "display_as_published.spv";
  PortRun run{"", "puddle.display.corrected/1", "", {}};
  compare(c, *c.output("picture"), execute(c, program, read_spirv(program), "'a'")[0], run);
  EXPECT_NE(run.wrong, "");
}
// A module that asks for what its bindings have not is refused by name.
TEST_F(ExamplePorts, BoundWronglyAreRefused) {
  const capture::Pack pack(test::pack_folder("puddle-corrected"));
  const auto entry = std::find_if(pack.cases.begin(), pack.cases.end(), [](const capture::PackCase& c) { return c.pass == "wave_step"; });
  const PassCase c = pack.read(*entry);
  const Program program = read_programs(fs::path(RAINREF_SPIRV) / "puddle").at("puddle.wave_step.corrected/2");
  const auto said = [&](const Program& p) -> std::string {
    try {
      execute(c, p, read_spirv(p), "'a.spv'");
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(said(program), "");
  Program exchanged = program;
  std::swap(exchanged.inputs[0], exchanged.inputs[1]);
  EXPECT_EQ(said(exchanged), "'a.spv': binding 1 ('wave') is a sampled image, and the program binds a storage buffer");
  Program fewer = program;
  fewer.inputs.pop_back();
  EXPECT_EQ(said(fewer), "'a.spv': binding 3 ('shore') is a sampled image, and the program binds a storage image");
  fewer.constants.clear();
  fewer.outputs = {"rain"};
  EXPECT_EQ(said(fewer), "puddle.wave_step/0011.0: the pack expects no output 'rain'");
}

}  // namespace
}  // namespace rainref::spirv
