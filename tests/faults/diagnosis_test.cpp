// Mistakes that ports make, and whether the likely cause names them. The ports are of a device that fuses products and
// truncates halves, as the ones that were measured do, so that hardly any bit is the reference's.
#include "judge/mini_port.h"
#include "judge/rearrange.h"

#include <cmath>
#include <cstring>

#include <gmock/gmock.h>

namespace rainref::faults {
namespace {

using namespace judge;

using capture::Array;
using capture::PassCase;
using perturbed::Fault;
using testing::HasSubstr;

struct Mistake {
  const char* name;  ///< of the test
  const char* pack;
  const char* pass;
  const char* cause;  ///< the likely cause begins like this
  std::function<void(MiniPort&)> make;

  friend void PrintTo(const Mistake& m, std::ostream* out) { *out << m.pack << '/' << m.pass << ": " << m.cause; }
};

/// Texel (x, y) becomes that of from(x, y).
template <class From>
void move_texels(Array& a, From from) {
  const std::vector<std::byte> old = a.levels[0];
  const std::size_t n = a.element_bytes(), width = static_cast<std::size_t>(a.width);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const auto [u, v] = from(x, y);
      std::memcpy(a.levels[0].edit().data() + (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)) * n,
                  old.data() + (static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u)) * n, n);
    }
}
void each_output(MiniPort& port, const std::string& pass, std::function<void(Array&)> change) {
  port.after = [pass, change](const PassCase& c, std::vector<Array>& out) {
    if (c.pass == pass)
      for (Array& a : out) change(a);
  };
}
void each_case(MiniPort& port, const std::string& pass, std::function<void(PassCase&)> change) {
  port.before = [pass, change](PassCase& c) {
    if (c.pass == pass) change(c);
  };
}
/// The pass computes like this instead of fusing.
std::function<void(MiniPort&)> fault(Fault s, const char* pass) {
  return [s, pass](MiniPort& port) {
    port.behaviour.fault = s;
    port.only = pass;
  };
}
/// A float of the uniform block.
void put_uniform(PassCase& c, std::size_t offset, float value) { std::memcpy(c.uniforms.data() + offset, &value, 4); }
float uniform(const PassCase& c, std::size_t offset) {
  float value;
  std::memcpy(&value, c.uniforms.data() + offset, 4);
  return value;
}

const char *const corrected = "puddle-corrected", *const published = "puddle-as-published";

std::vector<Mistake> mistakes() {
  return {
      {"UpsideDown", corrected, "shade", "upside down",
       [](MiniPort& p) {
         each_output(p, "shade", [](Array& a) { move_texels(a, [&](int x, int y) { return std::pair(x, a.height - 1 - y); }); });
       }},
      {"Mirrored", corrected, "wave_step", "mirrored",
       [](MiniPort& p) {
         each_output(p, "wave_step", [](Array& a) { move_texels(a, [&](int x, int y) { return std::pair(a.width - 1 - x, y); }); });
       }},
      {"Transposed", corrected, "wave_step", "transposed",
       [](MiniPort& p) {
         each_output(p, "wave_step", [](Array& a) {
           move_texels(a, [&](int x, int y) { return x < a.height && y < a.height ? std::pair(y, x) : std::pair(x, y); });
         });
       }},
      {"Bgra", published, "display", "picture as BGRA",
       [](MiniPort& p) {
         each_output(p, "display", [](Array& a) {
           for (std::size_t i = 0; i < a.levels[0].size(); i += 4) std::swap(a.levels[0].edit()[i], a.levels[0].edit()[i + 2]);
         });
       }},
      {"SwappedPingPong", corrected, "wave_step", "wave with its first two channels swapped",
       [](MiniPort& p) {
         each_output(p, "wave_step", [](Array& a) {
           std::byte* const all = a.levels[0].edit().data();
           for (std::size_t i = 0; i < a.levels[0].size(); i += 4) std::swap_ranges(all + i, all + i + 2, all + i + 2);
         });
       }},
      {"SwappedPingPongInput", corrected, "wave_step", "input wave with its first two channels swapped",
       [](MiniPort& p) {
         each_case(p, "wave_step", [](PassCase& c) {
           Array& a = input_of(c, "wave").array;
           std::byte* const all = a.levels[0].edit().data();
           for (std::size_t i = 0; i < a.levels[0].size(); i += 4) std::swap_ranges(all + i, all + i + 2, all + i + 2);
         });
       }},
      {"MissingSwap", corrected, "wave_step", "wave is its own input",
       [](MiniPort& p) {
         p.after = [](const PassCase& c, std::vector<Array>& out) {
           if (c.pass == "wave_step") out[0] = c.input("wave")->array;
         };
       }},
      {"StaleInput", corrected, "shade", "input normal stale",
       [](MiniPort& p) {
         const auto old = std::make_shared<Array>();
         each_case(p, "shade", [old](PassCase& c) {
           Array& now = input_of(c, "normal").array;
           if (c.frame == 11)
             *old = now;
           else
             now = *old;
         });
       }},
      {"HalfTexelMissing", corrected, "surface_hit", "half texel missing", fault(Fault::half_texel_missing, "surface_hit")},
      {"HalfTexelMissingInShade", published, "shade", "half texel missing", fault(Fault::half_texel_missing, "shade")},
      {"NearestFilter", published, "shade", "nearest for linear", fault(Fault::nearest_filter, "shade")},
      {"HalfIntermediates", published, "shade", "half intermediates", fault(Fault::half_intermediates, "shade")},
      {"ClampForRepeat", published, "shade", "clamp address mode", fault(Fault::address_clamped, "shade")},
      {"FirstDropMissing", corrected, "wave_step", "input drops without its first record",
       [](MiniPort& p) {
         each_case(p, "wave_step", [](PassCase& c) {
           Array& drops = input_of(c, "drops").array;
           drops.levels[0].edit().erase(drops.levels[0].begin(), drops.levels[0].begin() + 16);
           --drops.width;
         });
       }},
      {"SrgbTwice", corrected, "display", "picture sRGB encoded twice",
       [](MiniPort& p) {
         each_output(p, "display", [](Array& a) {
           for (std::size_t i = 0; i < a.levels[0].size(); ++i) {
             if (i % 4 == 3) continue;
             const double v = std::to_integer<int>(a.levels[0][i]) / 255.0,
                          e = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
             a.levels[0].edit()[i] = static_cast<std::byte>(e * 255 + 0.5);
           }
         });
       }},
      {"MissingAspect", corrected, "surface_hit", "uniform camera_plane_left is camera_plane_bottom",
       [](MiniPort& p) { each_case(p, "surface_hit", [](PassCase& c) { put_uniform(c, 28, uniform(c, 44)); }); }},
      {"WidthForHeight", corrected, "display", "uniform width is height",
       [](MiniPort& p) { each_case(p, "display", [](PassCase& c) { put_uniform(c, 8, uniform(c, 12)); }); }},
      {"DampingTooLarge", corrected, "wave_step", "another value of damping",
       [](MiniPort& p) { each_case(p, "wave_step", [](PassCase& c) { put_uniform(c, 0, 1.01f * uniform(c, 0)); }); }},
      {"UniformNotSet", corrected, "shade", "uniform water_turbidity is zero",
       [](MiniPort& p) { each_case(p, "shade", [](PassCase& c) { put_uniform(c, 92, 0); }); }},
      {"LastColumnNotWritten", corrected, "wave_step", "last column not written",
       [](MiniPort& p) {
         each_output(p, "wave_step", [](Array& a) {
           for (int y = 0; y < a.height; ++y)
             std::memset(a.levels[0].edit().data() + static_cast<std::size_t>(y * a.width + a.width - 1) * a.element_bytes(), 0,
                         a.element_bytes());
         });
       }},
      {"PartialWorkgroups", published, "shade", "partial workgroups not written",
       [](MiniPort& p) {
         each_output(p, "shade", [](Array& a) {
           for (int y = 0; y < a.height; ++y)
             for (int x = 0; x < a.width; ++x)
               if (x >= 32 || y >= 16)
                 std::memset(a.levels[0].edit().data() + static_cast<std::size_t>(y * a.width + x) * a.element_bytes(), 0,
                             a.element_bytes());
         });
       }},
      {"InputUpsideDown", corrected, "shade", "input hit upside down",
       [](MiniPort& p) {
         each_case(p, "shade", [](PassCase& c) {
           Array& a = input_of(c, "hit").array;
           move_texels(a, [&](int x, int y) { return std::pair(x, a.height - 1 - y); });
         });
       }},
      {"EightBitWave", published, "wave_step", "wave through 8 bits",
       [](MiniPort& p) {
         each_output(p, "wave_step", [](Array& a) {
           for (std::size_t i = 0; i < a.levels[0].size(); i += 2) {
             Half h;
             std::memcpy(&h, &a.levels[0][i], 2);
             h = to_half(to_float(to_unorm8(to_float(h))));
             std::memcpy(&a.levels[0].edit()[i], &h, 2);
           }
         });
       }},
  };
}

class Diagnosis : public testing::TestWithParam<Mistake> {};

TEST_P(Diagnosis, NamesTheMistake) {
  const Mistake& m = GetParam();
  MiniPort port(m.pack);
  port.stores = HalfMode::rtz;
  port.behaviour.fault = Fault::fused;
  m.make(port);
  TemporaryFolder folder;
  port.run(folder.path());
  const PortJudgement j = judge::judge(port.pack, folder.path(), "vulkan", true);
  const PassJudgement& pass = pass_of(j, m.pass);
  ASSERT_EQ(pass.status, Status::fail) << why(j);
  ASSERT_FALSE(pass.causes.empty());
  std::string found;
  for (const Cause& c : pass.causes)
    found += c.name + ": " + std::to_string(c.explained) + ", " + std::to_string(c.inside) + " of " + std::to_string(c.of) + "\n";
  EXPECT_THAT(pass.causes[0].name, HasSubstr(m.cause)) << found;
  for (const PassJudgement& other : j.passes) EXPECT_EQ(other.status == Status::fail, other.pass == m.pass) << other.pass << '\n' << why(j);
}

INSTANTIATE_TEST_SUITE_P(Ports, Diagnosis, testing::ValuesIn(mistakes()),
                         [](const auto& tested) { return std::string(tested.param.name); });

// A port says that it rounds to nearest, and truncates.
TEST(HalfStores, OtherThanDeclaredFailsAndIsNamed) {
  MiniPort port(corrected);
  port.stores = HalfMode::rtz;
  TemporaryFolder folder;
  port.run(folder.path());
  EXPECT_EQ(judge::judge(port.pack, folder.path()).status, Status::pass);
  put(folder / "port.json", R"({"half_store": "rne"})");
  const PortJudgement j = judge::judge(port.pack, folder.path(), "vulkan", true);
  const PassJudgement& wave = pass_of(j, "wave_step");
  ASSERT_EQ(wave.status, Status::fail);
  ASSERT_FALSE(wave.causes.empty());
  EXPECT_EQ(wave.causes[0].name, "half stores toward zero");
  EXPECT_EQ(wave.causes[0].explained, wave.causes[0].of);
  put(folder / "port.json", R"({"half_store": "rtz"})");
  EXPECT_EQ(judge::judge(port.pack, folder.path()).status, Status::pass);
}

// A profile that asks for one rounding warns of the other and does not fail; ieee means bits.
TEST(HalfStores, OtherThanTheProfileAsksForWarns) {
  MiniPort port(corrected);
  TemporaryFolder folder;
  port.run(folder.path());
  PortJudgement j = judge::judge(port.pack, folder.path(), "d3d");
  EXPECT_EQ(pass_of(j, "wave_step").status, Status::warn);
  EXPECT_EQ(pass_of(j, "wave_step").reason, "stores to binary16 round to nearest, where the profile d3d asks for toward zero");
  port.stores = HalfMode::rtz;
  port.run(folder.path());
  EXPECT_EQ(judge::judge(port.pack, folder.path(), "d3d").status, Status::pass);
  j = judge::judge(port.pack, folder.path(), "ieee");
  EXPECT_EQ(pass_of(j, "wave_step").status, Status::fail);
}

// Water lost in a buffer that is nearly dry. Mirrored or moved it would have zeros there, too, but water where there is none.
TEST(Diagnosis, ABufferThatLostALittleIsNotCalledMirrored) {
  MiniPort port("windshield-corrected");
  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.pass != "splat") return;
    Array& height = out[0];
    for (int y = 0; y < height.height; y += 3)
      std::memset(height.levels[0].edit().data() + static_cast<std::size_t>(y * height.width) * height.element_bytes(), 0,
                  height.element_bytes() * static_cast<std::size_t>(height.width));
  };
  TemporaryFolder folder;
  port.run(folder.path());
  const PortJudgement j = judge::judge(port.pack, folder.path(), "vulkan", true);
  ASSERT_EQ(pass_of(j, "splat").status, Status::fail);
  for (const Cause& cause : pass_of(j, "splat").causes)
    ADD_FAILURE() << cause.name << ": " << cause.explained << ", " << cause.inside << " of " << cause.of;
}

// What no single mistake explains has no cause.
TEST(Diagnosis, NoiseHasNoCause) {
  MiniPort port(corrected);
  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.pass != "display") return;
    for (std::size_t i = 0; i < out[0].levels[0].size(); ++i)
      if (i % 4 != 3) out[0].levels[0].edit()[i] ^= static_cast<std::byte>((i * 2654435761u >> 7 & 0x78u) | 8u);
  };
  TemporaryFolder folder;
  port.run(folder.path());
  const PortJudgement j = judge::judge(port.pack, folder.path(), "vulkan", true);
  ASSERT_EQ(pass_of(j, "display").status, Status::fail);
  EXPECT_TRUE(pass_of(j, "display").causes.empty()) << pass_of(j, "display").causes[0].name;
}

}  // namespace
}  // namespace rainref::faults
