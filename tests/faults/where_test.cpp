// Where a pass fails, in one sentence: each place by a port that fails there and nowhere else, and no sentence without one.
#include <cstring>

#include <gmock/gmock.h>

#include "faults/diagnose.h"
#include "judge/mini_port.h"

namespace rainref::faults {
namespace {

using namespace judge;
using capture::Array;
using capture::PassCase;
using testing::HasSubstr;

/// Breaks channel k of the texels that are chosen: the highest exponent bit of a half, or a code of 8 bits, turned over.
std::string where(const char* pack, const char* pass, const std::string& output,
                  const std::function<bool(const PassCase&, int x, int y, int channel)>& breaks) {
  MiniPort port(pack);
  port.after = [&](const PassCase& c, std::vector<Array>& out) {
    if (c.pass != pass) return;
    for (std::size_t o = 0; o < out.size(); ++o) {
      if (c.outputs[o].name != output) continue;
      const FormatInfo& f = info(out[o].format);
      for (int y = 0; y < out[o].height; ++y)
        for (int x = 0; x < out[o].width; ++x)
          for (int k = 0; k < std::min(f.channels, 3); ++k)
            if (breaks(c, x, y, k))
              out[o].levels[0].edit()[static_cast<std::size_t>((y * out[o].width + x) * f.texel_bytes() + (k + 1) * f.channel_bytes - 1)] ^=
                  std::byte{0x40};
    }
  };
  TemporaryFolder folder;
  port.run(folder.path());
  const PortJudgement j = judge::judge(port.pack, folder.path(), "vulkan", true);
  EXPECT_EQ(pass_of(j, pass).status, Status::fail);
  return pass_of(j, pass).where;
}

const char *const puddle = "puddle-corrected", *const windshield = "windshield-corrected";

TEST(Where, OneChannel) {
  EXPECT_EQ(where(puddle, "wave_step", "wave", [](const PassCase&, int, int, int k) { return k == 1; }), "only channel y of wave");
  EXPECT_EQ(where("edge_splash-corrected", "splash", "angle", [](const PassCase&, int, int, int) { return true; }),
            "only channel x of angle");
}
TEST(Where, RowsColumnsAndBorders) {
  const auto at = [](auto chosen) {
    return where(puddle, "display", "picture", [chosen](const PassCase& c, int x, int y, int) {
      return chosen(x, y, c.outputs[0].array.width, c.outputs[0].array.height);
    });
  };
  EXPECT_EQ(at([](int, int y, int, int h) { return y == h - 1; }), "only the last row");
  EXPECT_EQ(at([](int x, int, int, int) { return x == 0; }), "only the first column");
  EXPECT_EQ(at([](int x, int y, int w, int h) { return x < 2 || y < 2 || x >= w - 2 || y >= h - 2; }), "only a border of 2 texels");
  EXPECT_EQ(at([](int x, int, int, int) { return x % 2 == 1; }), "only odd columns");
  EXPECT_EQ(at([](int x, int y, int, int) { return (x + y) % 2 == 0; }), "only texels whose column and row add to an even number");
  EXPECT_EQ(at([](int x, int y, int, int) { return x % 8 == 7 && y % 8 == 0; }), "only texel (7, 0) of every 8x8 group");
  EXPECT_EQ(at([](int x, int y, int w, int h) { return x >= w / 8 * 8 || y >= h / 8 * 8; }),
            "only what lies beyond the last whole 8x8 group");
}
TEST(Where, NearRecords) {
  const std::string text = where(puddle, "wave_step", "wave", [](const PassCase& c, int x, int y, int) {
    const Array& drops = c.input("drops")->array;
    for (int r = 0; r < drops.width; ++r) {
      float drop[4];
      std::memcpy(drop, drops.levels[0].data() + static_cast<std::size_t>(r) * drops.record.size, sizeof drop);
      const float dx = static_cast<float>(x) + 0.5f - drop[0], dy = static_cast<float>(y) + 0.5f - drop[1];
      if (dx * dx + dy * dy <= 4) return true;
    }
    return false;
  });
  EXPECT_THAT(text, HasSubstr("only within 2 texels of a record of drops"));
}
TEST(Where, WhereABufferIsAboveZero) {
  const std::string text = where(windshield, "normals", "normal", [](const PassCase& c, int x, int y, int k) {
    const Array& height = c.input("height")->array;
    Half h;
    std::memcpy(&h, height.levels[0].data() + static_cast<std::size_t>(y * height.width + x) * 2, 2);
    return k == 2 && to_float(h) > 0;
  });
  EXPECT_THAT(text, HasSubstr("only where height > 0"));
}
TEST(Where, OneMipLevelAndOneRun) {
  EXPECT_THAT(where(windshield, "blur_pyramid", "blurred", [](const PassCase& c, int, int, int) { return c.level == 1; }),
              HasSubstr("only mip level 1"));
  const capture::Pack pack(small_packs / puddle);
  int first = -1, step = -1;
  for (const capture::PackCase& c : pack.cases)
    if (c.pass == "wave_step" && first < 0) first = c.frame, step = c.step;
  EXPECT_THAT(where(puddle, "wave_step", "wave", [&](const PassCase& c, int, int, int) { return c.frame == first && c.step == step; }),
              HasSubstr("only the first run"));
}
// Failures everywhere, in all channels, and a handful that could lie anywhere share nothing.
TEST(Where, NoSentenceWithoutAPlace) {
  EXPECT_EQ(where(puddle, "display", "picture", [](const PassCase&, int, int, int) { return true; }), "");
  EXPECT_EQ(where(puddle, "display", "picture", [](const PassCase&, int x, int y, int) { return (x * 7 + y * 13) % 11 == 3; }), "");
  EXPECT_EQ(where(puddle, "display", "picture", [](const PassCase&, int x, int y, int) { return x == 3 && (y == 4 || y == 9); }), "");
}

// ---- words ---------------------------------------------------------------------------------------------------------
Tried cause(What what, std::int64_t explained, std::int64_t inside, bool is_likely) {
  return {std::move(what), {"", "", explained, 100, inside, false, is_likely}};
}
/// Of a mistake whose words say nothing.
Tried cause(const char* name, std::int64_t explained, std::int64_t inside, bool is_likely) {
  What what;
  what.name = name;
  return cause(std::move(what), explained, inside, is_likely);
}
TEST(BestCauses, LikelyIsTheFirstAlone) {
  const std::vector<Tried> best = best_causes({cause("a", 100, 100, true), cause("b", 99, 100, true), cause("c", 30, 60, false)});
  ASSERT_EQ(best.size(), 3u);
  EXPECT_EQ(best[0].name, "a");
  EXPECT_TRUE(best[0].is_likely);
  EXPECT_FALSE(best[1].is_likely);
}
TEST(BestCauses, OfAboutEqualOnesTheEarlierIsBelieved) {
  EXPECT_EQ(best_causes({cause("a", 98, 99, true), cause("b", 100, 100, true)})[0].name, "a");
  EXPECT_EQ(best_causes({cause("a", 90, 90, true), cause("b", 100, 100, true)})[0].name, "b");
}
TEST(BestCauses, WhatWasSolvedForDoesNotWinByBitsThatItMeetsByChance) {
  const Tried plain = cause({Kind::term_left_out, {"", "x"}}, 11, 100, true);
  EXPECT_EQ(best_causes({cause({Kind::wrong_value, {"", "y", "x"}}, 28, 100, true), plain})[0].name, plain.name);
  EXPECT_EQ(best_causes({plain, cause({Kind::wrong_value, {"", "y", "x"}}, 96, 100, true)})[0].name, "wrong value: y for x");
}
TEST(BestCauses, OfEqualOnesThoseOfFewPlacesAreMeant) {
  const auto better = [](const What& a, const What& b) { return best_causes({cause(a, 90, 100, true), cause(b, 90, 100, true)})[0].name; };
  EXPECT_EQ(better({Kind::factor_left_out, {"", "a"}}, {Kind::not_squared, {"b"}}), "not squared: b");
  EXPECT_EQ(better({Kind::product_of_other_sign, {"a"}}, {Kind::difference_the_other_way, {"a - b"}}), "difference the other way: a - b");
  EXPECT_EQ(better({Kind::field_halved, {"half_width", "wipers"}}, {Kind::term_left_out, {"", "0.5"}}), "term left out: 0.5");
  EXPECT_EQ(better({Kind::mix_left_out, {"a"}}, {Kind::fraction_the_other_way, {"a - floor(a)"}}), "mix left out: a");
}
TEST(BestCauses, WhatExplainsLittleIsNoCauseAndAFewTexelsProveNothing) {
  EXPECT_TRUE(best_causes({cause("a", 20, 40, false)}).empty());
  Tried few = cause("a", 3, 3, true);
  few.of = 3;
  EXPECT_FALSE(best_causes({few})[0].is_likely);
  few.of_records = true;
  EXPECT_TRUE(best_causes({few})[0].is_likely);
}
TEST(BestCauses, WhereDozensExplainAsMuchNoneIsLikely) {
  std::vector<Tried> many;
  for (int k = 0; k < 21; ++k) many.push_back(cause("a", 100, 100, true));
  EXPECT_FALSE(best_causes(many)[0].is_likely);
  many.pop_back();
  EXPECT_TRUE(best_causes(many)[0].is_likely);
}

}  // namespace
}  // namespace rainref::faults
