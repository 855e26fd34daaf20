// Mistakes that are decided before any search: how bytes lie, what a format keeps, when a buffer is written. Each is made here by hand, on
// ports that fuse products and truncate halves, so that hardly any bit is the reference's.
#include "faults/diagnose.h"

#include <array>
#include <cmath>
#include <cstring>

#include <gmock/gmock.h>

#include "faults/mistakes_puddle.h"
#include "judge/mini_port.h"

namespace rainref::faults {
namespace {

using namespace judge;

using capture::Array;
using capture::PassCase;
using testing::HasSubstr;

const char *const corrected = "puddle-corrected", *const published = "puddle-as-published";

struct Made {
  const char* name;  ///< of the test
  const char* pack;
  const char* pass;
  const char* cause;                   ///< the likely cause, whole
  std::function<void(Array&)> change;  ///< of each of the pass's outputs

  friend void PrintTo(const Made& m, std::ostream* out) { *out << m.pack << '/' << m.pass << ": " << m.cause; }
};

/// The first bytes of memory whose rows lie `pitch` bytes apart.
void read_padded(Array& a, std::size_t pitch, std::byte padding) {
  const std::size_t row = static_cast<std::size_t>(a.width) * a.element_bytes();
  std::vector<std::byte> memory;
  for (int y = 0; y < a.height; ++y) {
    const auto from = a.levels[0].begin() + static_cast<std::ptrdiff_t>(row) * y;
    memory.insert(memory.end(), from, from + static_cast<std::ptrdiff_t>(row));
    if (y + 1 < a.height) memory.resize(memory.size() + pitch - row, padding);  // the last row is short
  }
  memory.resize(a.levels[0].size());
  a.levels[0] = std::move(memory);
}
template <class Change>
void each_half(Array& a, Change change) {
  for (std::size_t i = 0; i < a.levels[0].size(); i += 2) {
    Half h;
    std::memcpy(&h, &a.levels[0][i], 2);
    h = change(h, static_cast<int>(i / 2) % info(a.format).channels);
    std::memcpy(&a.levels[0].edit()[i], &h, 2);
  }
}
float held(float v) { return v > 0 ? v < 1 ? v : 1 : 0; }

std::vector<Made> made() {
  return {
      {"RowsOf256", corrected, "wave_step", "rows of 256 bytes taken as tight", [](Array& a) { read_padded(a, 256, std::byte{0}); }},
      {"RowsOf64Texels", corrected, "shade", "rows of 512 bytes taken as tight", [](Array& a) { read_padded(a, 512, std::byte{0}); }},
      {"RowsOf256OfCodes", published, "display", "rows of 256 bytes taken as tight", [](Array& a) { read_padded(a, 256, std::byte{0}); }},
      {"TightRowsTakenAsPadded", corrected, "wave_step", "tight rows taken as rows of 256 bytes",
       [](Array& a) {
         const std::vector<std::byte> tight = a.levels[0];
         const std::size_t row = static_cast<std::size_t>(a.width) * a.element_bytes();
         for (std::size_t i = 0; i < tight.size(); ++i) {
           const std::size_t from = i / row * 256 + i % row;
           a.levels[0].edit()[i] = from < tight.size() ? tight[from] : std::byte{0};
         }
       }},
      {"HalfATurn", corrected, "shade", "by half a turn",
       [](Array& a) {
         const std::size_t n = a.element_bytes(), texels = a.levels[0].size() / n;
         std::byte* const all = a.levels[0].edit().data();
         for (std::size_t t = 0; t < texels / 2; ++t) std::swap_ranges(all + t * n, all + (t + 1) * n, all + (texels - 1 - t) * n);
       }},
      {"TenBits", corrected, "shade", "through 10 bits",
       [](Array& a) {
         each_half(a, [](Half h, int k) {
           const float most = k == 3 ? 3 : 1023;
           return to_half(std::floor(held(to_float(h)) * most + 0.5f) / most);
         });
       }},
      {"ElevenBits", corrected, "shade", "through 11 and 10 bits, toward zero",
       [](Array& a) {
         each_half(a, [](Half h, int k) {
           if (k == 3) return to_half(1);
           return Half{static_cast<std::uint16_t>(h.bits & 0x8000u ? 0 : h.bits & (k == 2 ? 0xffe0u : 0xfff0u))};
         });
       }},
      {"TenBitsReadAsEight", corrected, "display", "RGB10A2 read as RGBA8",
       [](Array& a) {
         for (std::size_t i = 0; i < a.levels[0].size(); i += 4) {
           std::uint32_t packed = 0;
           for (std::size_t k = 0; k < 3; ++k)
             packed |= static_cast<std::uint32_t>(std::to_integer<int>(a.levels[0][i + k]) * 1023 / 255) << 10 * k;
           packed |= static_cast<std::uint32_t>(std::to_integer<int>(a.levels[0][i + 3]) / 85) << 30;
           std::memcpy(&a.levels[0].edit()[i], &packed, 4);
         }
       }},
      {"NoSubnormalHalves", corrected, "wave_step", "without subnormal halves",
       [](Array& a) { each_half(a, [](Half h, int) { return h.bits & 0x7c00u ? h : Half{0}; }); }},
      {"MultipliedByItsAlpha", "edge_splash-as-published", "splash", "multiplied by its alpha",
       [](Array& a) {
         if (a.format != Format::rgba16f) return;
         for (std::size_t i = 0; i < a.levels[0].size(); i += 8) {
           Half texel[4];
           std::memcpy(texel, &a.levels[0][i], 8);
           for (int k = 0; k < 3; ++k) texel[k] = to_half(to_float(texel[k]) * to_float(texel[3]), Rounding::rtz);
           std::memcpy(&a.levels[0].edit()[i], texel, 8);
         }
       }},
  };
}

class Decided : public testing::TestWithParam<Made> {};

TEST_P(Decided, IsTheLikelyCause) {
  const Made& m = GetParam();
  MiniPort port(m.pack);
  port.stores = HalfMode::rtz;
  port.behaviour.fault = perturbed::Fault::fused;
  port.after = [&](const PassCase& c, std::vector<Array>& out) {
    if (c.pass == m.pass)
      for (Array& a : out) m.change(a);
  };
  TemporaryFolder folder;
  port.run(folder.path());
  const PortJudgement j = judge::judge(port.pack, folder.path(), "vulkan", true);
  const PassJudgement& pass = pass_of(j, m.pass);
  ASSERT_EQ(pass.status, Status::fail) << why(j);
  ASSERT_FALSE(pass.causes.empty());
  EXPECT_EQ(pass.causes[0].name, m.cause) << pass.causes[0].explained << ", " << pass.causes[0].inside << " of " << pass.causes[0].of;
  EXPECT_TRUE(pass.causes[0].is_likely);
}
INSTANTIATE_TEST_SUITE_P(Ports, Decided, testing::ValuesIn(made()), [](const auto& tested) { return std::string(tested.param.name); });

// ---- what is computed with the mistake -----------------------------------------------------------------------------
/// The cause that is named when give(case, outputs) makes what a pass of a pack stores.
Cause cause_of(const char* pack_name, const std::string& pass,
               const std::function<void(PassCase&, const scene::UniformBlock&, std::vector<Array>&)>& give) {
  const capture::Pack pack(small_packs / pack_name);
  TemporaryFolder folder;
  for (const capture::PackCase& entry : pack.cases) {
    if (entry.pass != pass) continue;
    PassCase c = pack.read(entry);
    std::vector<Array> out;
    for (const capture::CaseOutput& o : c.outputs) out.push_back(o.array);
    give(c, pack.pass(pass).block, out);
    for (std::size_t o = 0; o < out.size(); ++o) put_array(folder / c.folder(), "out." + c.outputs[o].name, out[o]);
  }
  ValidateOptions options;
  options.only = {pass};
  options.explain = faults::diagnose;
  options.executor = &test_executor();
  const PassJudgement j = pass_of(validate(pack, folder.path(), options), pass);
  EXPECT_EQ(j.status, Status::fail);
  Cause found = j.causes.empty() ? Cause{"unknown", ""} : j.causes[0];
  found.sentence += " | " + j.where;
  return found;
}

/// One texel of the wave step, written by hand from the documents.
void step_texel(const hand::Loop loop, const hand::Run& run, int x, int y, Array& out) {
  float values[2];
  loop(run, x, y, values);
  for (std::size_t k = 0; k < 2; ++k) {
    const Half h = to_half(values[k]);
    std::memcpy(&out.levels[0].edit()[static_cast<std::size_t>(y * out.width + x) * 4 + 2 * k], &h, 2);
  }
}
/// In one buffer, group after group of `width` x `height` texels: what a group stores the next one reads.
Cause cause_of_step_in_place(const char* pack, const hand::Loop loop, int width, int height) {
  return cause_of(pack, "wave_step", [=](PassCase& c, const scene::UniformBlock& block, std::vector<Array>& out) {
    const hand::Run run(c, block, "");
    Array& wave = input_of(c, "wave").array;
    for (int y = 0; y < wave.height; y += height)
      for (int x = 0; x < wave.width; x += width) {
        Array stored = wave;
        for (int j = y; j < std::min(y + height, wave.height); ++j)
          for (int i = x; i < std::min(x + width, wave.width); ++i) step_texel(loop, run, i, j, stored);
        wave.levels = std::move(stored.levels);
      }
    out[0].levels = wave.levels;
  });
}
TEST(WrittenInPlace, IsNamedByItsGroups) {
  for (const auto& [pack, loop] : {std::pair<const char*, hand::Loop>(corrected, hand::wave_step_corrected),
                                   std::pair<const char*, hand::Loop>(published, hand::wave_step_published)}) {
    const Cause c = cause_of_step_in_place(pack, loop, 8, 8);
    EXPECT_EQ(c.name, "wave written in place, by groups of 8x8") << pack;
    EXPECT_TRUE(c.is_likely) << pack;
  }
}
TEST(WrittenInPlace, IsNamedTexelByTexel) {
  for (const auto& [pack, loop] : {std::pair<const char*, hand::Loop>(corrected, hand::wave_step_corrected),
                                   std::pair<const char*, hand::Loop>(published, hand::wave_step_published)}) {
    const Cause c = cause_of_step_in_place(pack, loop, 1, 1);
    EXPECT_EQ(c.name, "wave written in place, texel by texel") << pack;
    EXPECT_TRUE(c.is_likely) << pack;
  }
}

TEST(OwnTexel, ItsLevelsExchangedAreNamed) {
  const Cause c = cause_of(corrected, "wave_step", [](PassCase& taken, const scene::UniformBlock& block, std::vector<Array>& out) {
    const hand::Run run(taken, block, "");
    Array& wave = input_of(taken, "wave").array;
    for (int y = 0; y < wave.height; ++y)
      for (int x = 0; x < wave.width; ++x) {
        std::byte* const own = &wave.levels[0].edit()[static_cast<std::size_t>(y * wave.width + x) * 4];
        std::swap_ranges(own, own + 2, own + 2);
        step_texel(hand::wave_step_corrected, run, x, y, out[0]);
        std::swap_ranges(own, own + 2, own + 2);
      }
  });
  EXPECT_EQ(c.name, "wave with its two channels exchanged at the texel itself");
  EXPECT_TRUE(c.is_likely);
}

/// Every operation in half precision.
struct Low {
  float v;
  Low(float x) : v(to_float(to_half(x))) {}
  friend Low operator+(Low a, Low b) { return a.v + b.v; }
  friend Low operator*(Low a, Low b) { return a.v * b.v; }
};
Low low_fract(Low x) { return x.v - std::floor(x.v); }
std::array<Low, 3> low_hash(Low x, Low y, float a, float b, float c) {
  const Low p = low_fract(x * a), q = low_fract(y * b), r = low_fract(x * c);
  const Low d = ((p * (q + 33.33f)) + (q * (r + 33.33f))) + (r * (p + 33.33f));
  return {p + d, q + d, r + d};
}
TEST(Hash, InHalfPrecisionIsNamed) {
  const Cause c = cause_of(published, "raindrops", [](PassCase& taken, const scene::UniformBlock& block, std::vector<Array>& out) {
    const hand::Run r(taken, block, "");
    const float t = r.u("time") * r.u("rain_speed");
    for (int i = 0; i < r.whole("drop_count"); ++i) {
      const float offset = 0.3711f * static_cast<float>(i), sx = std::floor(t) + offset, sy = 17.3f * static_cast<float>(i);
      const auto q = low_hash(sx, sy, 0.1031f, 0.1030f, 0.0973f), s = low_hash(sx + 1, sy + 1, 0.1031f, 0.1031f, 0.1031f);
      const float strength = r.u("drop_intensity") * (0.5f + 0.5f * low_fract((s[0] + s[1]) * s[2]).v);
      const float pulse = hand::fract(t + 0.7f * offset);
      const float drop[4] = {low_fract((q[0] + q[1]) * q[2]).v * r.u("width"), low_fract((q[0] + q[2]) * q[1]).v * r.u("height"),
                             strength * (hand::smoothstep(0, 0.15f, pulse) * hand::smoothstep(0.35f, 0.2f, pulse)), 4};
      std::memcpy(&out[0].levels[0].edit()[static_cast<std::size_t>(i) * sizeof drop], drop, sizeof drop);
    }
  });
  EXPECT_EQ(c.name, "hash in half precision") << c.sentence;
  EXPECT_TRUE(c.is_likely);
}

// ---- lists and numbers ---------------------------------------------------------------------------------------------
/// The cause where 64 records more are stored behind each list of a pass: zeros, or copies of the first.
Cause cause_of_dead_records(const char* pack, const char* pass, bool are_zero) {
  return cause_of(pack, pass, [=](PassCase&, const scene::UniformBlock&, std::vector<Array>& out) {
    for (Array& a : out) {
      if (!a.is_records || a.width == 0) continue;
      std::vector<std::byte>& list = a.levels[0].edit();
      const std::vector<std::byte> first(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(a.record.size));
      for (int k = 0; k < 64; ++k) {
        list.resize(list.size() + a.record.size);
        if (!are_zero) std::copy(first.begin(), first.end(), list.end() - static_cast<std::ptrdiff_t>(a.record.size));
        ++a.width;
      }
    }
  });
}
TEST(Lists, ReadBeyondTheirEndAreNamed) {
  for (const auto& [pack, pass] : {std::pair("windshield-corrected", "integrate"), std::pair("windshield-corrected", "spawn"),
                                   std::pair("puddle-corrected", "raindrops")}) {
    const Cause zeros = cause_of_dead_records(pack, pass, true), copies = cause_of_dead_records(pack, pass, false);
    EXPECT_THAT(zeros.name, HasSubstr("drops read beyond its end")) << pass;
    EXPECT_THAT(zeros.sentence, HasSubstr("right records stand 64 more, all zero")) << pass;
    EXPECT_TRUE(zeros.is_likely) << pass;
    EXPECT_THAT(copies.name, HasSubstr("drops read beyond its end")) << pass;
    EXPECT_THAT(copies.sentence, HasSubstr("right records stand 64 more, all alike")) << pass;
  }
}

TEST(NotNumbers, AreSaidWithTheFirst) {
  const Cause c = cause_of(corrected, "shade", [](PassCase&, const scene::UniformBlock&, std::vector<Array>& out) {
    for (std::size_t t = 100; t < out[0].levels[0].size() / 8; t += 3) {
      const std::uint16_t none = 0x7e00;
      std::memcpy(&out[0].levels[0].edit()[t * 8 + 2], &none, 2);
    }
  });
  EXPECT_EQ(c.name, "not a number");
  EXPECT_TRUE(c.is_likely);
  EXPECT_THAT(c.sentence, HasSubstr("each failing element is not a number (NaN), the first is (30, 2).y of colour in puddle.shade/"));
}

}  // namespace
}  // namespace rainref::faults
