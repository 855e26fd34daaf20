// Pictures without alpha, of buffers whose alpha is declared as the constant 1.
#include <cstring>

#include <gmock/gmock.h>

#include "base/npy.h"
#include "judge/mini_port.h"
#include "judge/support.h"
#include "registry/registry.h"

namespace rainref::judge {
namespace {

using capture::Array;
using testing::Contains;
using testing::HasSubstr;

/// An image of four channels without the fourth, as NumPy saves it.
void put_three_channels(const std::filesystem::path& file, const Array& a) {
  const FormatInfo& f = info(a.format);
  const auto texel = static_cast<std::size_t>(f.texel_bytes()), kept = static_cast<std::size_t>(3 * f.channel_bytes);
  std::string data;
  for (std::size_t t = 0; t < a.levels[0].size(); t += texel) data.append(reinterpret_cast<const char*>(&a.levels[0][t]), kept);
  put(file, npy(f.channel_bytes == 1   ? "'|u1'"
                : f.channel_bytes == 2 ? "'<f2'"
                                       : "'<f4'",
                "(" + std::to_string(a.height) + ", " + std::to_string(a.width) + ", 3)", data));
}

TEST(PicturesWithoutAlpha, AreJudgedWhereItIsOne) {
  MiniPort port("puddle-corrected");
  TemporaryFolder folder;
  port.run(folder.path());
  for (const capture::PackCase& entry : port.pack.cases)
    for (const capture::CaseOutput& o : port.pack.read(entry).outputs)
      if (entry.pass == "shade" || entry.pass == "display") put_three_channels(folder / entry.id / ("out." + o.name + ".npy"), o.array);
  const PortJudgement j = judge(port.pack, folder.path());
  EXPECT_EQ(j.status, Status::pass) << why(j);
  EXPECT_THAT(j.notes, Contains(HasSubstr("3 channels, the buffer's fourth is 1 everywhere: taken as 1")));
}

// What is declared as 1 is 1 in every pack.
TEST(PicturesWithoutAlpha, TheDeclaredAlphaIsWhatPassesGive) {
  int checked = 0;
  for (const auto& folder : std::filesystem::directory_iterator(small_packs)) {
    if (!std::filesystem::is_regular_file(folder.path() / "manifest.json")) continue;
    const capture::Pack pack(folder.path());
    const capture::EffectInfo& effect = *registry::effect_of_pack(pack.effect).info;
    for (const capture::PackCase& entry : pack.cases)
      for (const capture::PackOutput& o : entry.outputs) {
        if (o.shape.is_records || info(o.shape.format).channels != 4) continue;
        const std::string& alpha = effect.buffer(o.name, pack.variant).alpha;
        if (alpha != "1" && alpha != "opaque") continue;
        const Array a = pack.read(o);
        const FormatInfo& f = info(a.format);
        const float one = 1;
        const Half half{0x3c00};
        const std::byte code{255};
        const void* wanted = f.channel_bytes == 1   ? static_cast<const void*>(&code)
                             : f.channel_bytes == 2 ? static_cast<const void*>(&half)
                                                    : &one;
        ++checked;
        for (std::size_t t = 0; t < a.levels[0].size(); t += a.element_bytes())
          ASSERT_EQ(std::memcmp(&a.levels[0][t + 3 * static_cast<std::size_t>(f.channel_bytes)], wanted,
                                static_cast<std::size_t>(f.channel_bytes)),
                    0)
              << pack.folder() << ' ' << entry.id << ' ' << o.name;
      }
  }
  EXPECT_GT(checked, 50);
}

}  // namespace
}  // namespace rainref::judge
