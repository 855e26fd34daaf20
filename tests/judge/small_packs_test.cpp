// The small packs are whole, small, and hold nothing that a constant could stand for. Which bytes they have scripts/accept_packs --check
// compares (the test PackHashes).
#include <filesystem>

#include <gtest/gtest.h>

#include "capture/pack_read.h"
#include "shipped_packs.h"

namespace rainref::judge {
namespace {

using rainref::test::pack_folder, rainref::test::PackPasses;

class SmallPack : public testing::TestWithParam<PackPasses> {};

/// One record, or a level of a few texels.
bool is_small(const capture::PassCase& c) { return c.pass == "windshield_frame" || c.level > 2; }

TEST_P(SmallPack, IsWholeAndHasContent) {
  const capture::Pack pack(pack_folder(GetParam().name));
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
  for (const auto& file : std::filesystem::recursive_directory_iterator(pack_folder(GetParam().name)))
    if (file.is_regular_file()) bytes += file.file_size();
  EXPECT_LT(bytes, 350000u);
}

INSTANTIATE_TEST_SUITE_P(Packs, SmallPack, testing::ValuesIn(rainref::test::shipped_packs()), rainref::test::name_of_pack_test);

}  // namespace
}  // namespace rainref::judge
