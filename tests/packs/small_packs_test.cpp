// The small packs that lie in the repository are what this build writes.
#include <map>

#include "capture/pack_read.h"
#include "cli/support.h"
#include "source_folder.h"

namespace rainref::cli {
namespace {

const std::filesystem::path here = rainref::test::source_folder() + "/tests/packs";

std::map<std::string, std::string> files_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) out[std::filesystem::relative(entry.path(), folder)] = contents(entry.path());
  }
  return out;
}

class SmallPack : public testing::TestWithParam<std::string> {};

// A change that is meant is recorded by scripts/accept_packs.
TEST_P(SmallPack, IsWhatThisBuildWrites) {
  TemporaryFolder folder;
  const std::string scene = (here / (GetParam() + ".toml")).string();
  Circumstances c;
  c.is_copy = true;
  // As scripts/accept_packs: the bakes of rainy glass and the background of screen drops run before frame 0.
  const std::string at = GetParam().starts_with("rainy_glass") || GetParam().starts_with("screen_drops") ? "0,12" : "11,12";
  const Outcome o = run_rainref(folder.path(), {"pack", scene, "--at", at, "-o", "fresh"}, c);
  ASSERT_EQ(o.code, 0) << o.err;
  const auto expected = files_of(here / GetParam()), found = files_of(folder / "fresh");
  EXPECT_EQ(found.size(), expected.size());
  for (const auto& [name, bytes] : expected) {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_TRUE(found.at(name) == bytes) << name << " differs";
  }
}

/// One record, or a level of a few texels.
bool is_small(const capture::PassCase& c) { return c.pass == "windshield_frame" || c.level > 2; }

TEST_P(SmallPack, IsWholeAndHasContent) {
  const capture::Pack pack(here / GetParam());
  EXPECT_EQ(pack.file_beside(), "");
  for (const capture::PackCase& entry : pack.cases) {
    const capture::PassCase c = pack.read(entry);
    for (const capture::CaseOutput& output : c.outputs) {
      // Of a buffer that is the same everywhere a port could not be told from a constant.
      const auto& bytes = output.array.levels[0];
      const std::size_t element = output.array.element_bytes();
      if (is_small(c)) continue;
      ASSERT_GT(bytes.size(), 2 * element) << c.folder() << ' ' << output.name;
      bool varies = false;
      for (std::size_t i = element; i < bytes.size(); i += element) varies = varies || !std::equal(&bytes[0], &bytes[element], &bytes[i]);
      EXPECT_TRUE(varies) << c.folder() << ' ' << output.name;
    }
  }
}

TEST_P(SmallPack, IsUnder350Kilobytes) {
  std::uintmax_t bytes = 0;
  for (const auto& [name, content] : files_of(here / GetParam())) bytes += content.size();
  EXPECT_LT(bytes, 350000u);
}

std::string name_of(const testing::TestParamInfo<std::string>& tested) {
  std::string name = tested.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Packs, SmallPack,
                         testing::Values("puddle-as-published", "puddle-corrected", "puddle-shore", "windshield-as-published",
                                         "windshield-corrected", "edge_splash-as-published", "edge_splash-corrected",
                                         "rainy_glass-as-published", "rainy_glass-corrected", "screen_drops-as-published",
                                         "screen_drops-corrected", "rainy_glass-slopes", "screen_drops-storm", "windshield-closing",
                                         "windshield-trails", "windshield-panes", "windshield-smear", "windshield-neck"),
                         name_of);

}  // namespace
}  // namespace rainref::cli
