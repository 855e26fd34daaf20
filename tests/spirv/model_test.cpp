// A port's SPIR-V as a model: with floats what is executed, with intervals what a device may make of it.
#include "spirv/spirv_model.h"

#include <cstring>
#include <filesystem>

#include <gtest/gtest.h>

#include "capture/pack_read.h"
#include "image/code_range.h"
#include "math/path_enumeration.h"
#include "math/profiles.h"
#include "shipped_packs.h"

namespace rainref::spirv {
namespace {

namespace fs = std::filesystem;
using capture::Array, capture::PassCase, capture::PassModel;

PassCase case_of(const std::string& pack_name, const std::string& pass) {
  const capture::Pack pack(test::pack_folder(pack_name));
  for (const capture::PackCase& entry : pack.cases)
    if (entry.pass == pass) return pack.read(entry);
  throw std::runtime_error(pack_name + ": no pass " + pass);
}
struct Bound {
  PassCase c;
  Program program;
  std::vector<std::byte> spirv;

  Bound(const std::string& pack, const std::string& pass, const std::string& formula, const std::string& file = "")
      : c(case_of(pack, pass)), program(read_programs(fs::path(RAINREF_SPIRV) / c.effect).at(formula)) {
    if (file != "") program.spirv = program.spirv.parent_path() / file;
    spirv = read_spirv(program);
  }
  std::unique_ptr<PassModel> model() const { return spirv_model(c, program, spirv, "'a.spv'"); }
};

enum class Held { yes, no, open };
/// Whether the stored texel of each output may be what this model gives.
Held holds(const PassModel& model, const PassCase& c, const std::vector<Array>& dump, int x, int y, const enclosed::Profile& profile) {
  const enclosed::ProfileScope scope(profile);
  enclosed::PathEnumeration paths;
  std::vector<enclosed::Enclosure> values(static_cast<std::size_t>(model.values()));
  bool any = false;
  const bool is_settled = paths.for_each_alternative([&] {
    model.enclose(x, y, nullptr, values.data());
    bool all = true;
    std::size_t v = 0;
    for (std::size_t o = 0; o < c.outputs.size(); ++o) {
      const FormatInfo& format = info(c.outputs[o].array.format);
      const std::size_t texel = static_cast<std::size_t>(y) * static_cast<std::size_t>(dump[o].width) + static_cast<std::size_t>(x);
      for (int k = 0; k < format.channels; ++k, ++v) {
        const std::byte* at = dump[o].levels[0].data() + texel * dump[o].element_bytes() + k * format.channel_bytes;
        const auto range = enclosed::code_range(format.kind, values[v], enclosed::store_rules(profile, c.outputs[o].store_rounding));
        all &= range.contains(enclosed::ordered_code(format.kind, at));
      }
    }
    any |= all;
  });
  return !is_settled ? Held::open : any ? Held::yes : Held::no;
}
struct Count {
  int yes = 0, no = 0, open = 0;
};
/// Counts some texels of what the reference gives.
Count count(const Bound& b, const std::string& profile_name) {
  const enclosed::Profile& profile = test::profile_named(profile_name);
  const auto model = b.model();
  std::vector<Array> dump;
  for (const auto& o : b.c.outputs) dump.push_back(o.array);
  Count out;
  for (int y = 0; y < model->height(); y += 3)
    for (int x = y % 2; x < model->width(); x += 3) {
      const Held held = holds(*model, b.c, dump, x, y, profile);
      ++(held == Held::yes ? out.yes : held == Held::no ? out.no : out.open);
    }
  return out;
}

class SpirvModel : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(RAINREF_SPIRV) == "") GTEST_SKIP() << "needs glslangValidator";
  }
};

TEST_F(SpirvModel, FloatsAreWhatIsExecuted) {
  const Bound b("puddle-corrected", "wave_step", "puddle.wave_step.corrected/2");
  const auto model = b.model();
  const Array got = execute(b.c, b.program, b.spirv, "'a.spv'")[0];
  ASSERT_EQ(model->width(), got.width);
  ASSERT_EQ(model->values(), 2);
  for (int y = 0; y < model->height(); y += 2) {
    for (int x = 0; x < model->width(); ++x) {
      Float values[2];
      model->evaluate(x, y, values);
      Half stored[2];
      std::memcpy(
          stored,
          got.levels[0].data() + (static_cast<std::size_t>(y) * static_cast<std::size_t>(got.width) + static_cast<std::size_t>(x)) * 4, 4);
      for (int k = 0; k < 2; ++k) {
        Half mine{};
        scalar::store(&mine, values[k], b.c.outputs[0].store_rounding);
        EXPECT_EQ(mine.bits, stored[k].bits) << x << ' ' << y;
      }
    }
  }
}
// What a right port says may give the reference's bits, by the exact rules and by those of a GPU.
TEST_F(SpirvModel, OfARightPortHoldsTheReference) {
  const Bound ports[] = {{"puddle-corrected", "wave_step", "puddle.wave_step.corrected/2"},
                         {"puddle-corrected", "shade", "puddle.shade.corrected/2"},
                         {"puddle-corrected", "display", "puddle.display.corrected/1"},
                         {"rainy_glass-corrected", "rain_on_glass", "rainy_glass.rain_on_glass.corrected/1"},
                         {"edge_splash-corrected", "splash", "edge_splash.splash.corrected/1"},
                         {"screen_drops-corrected", "cells", "screen_drops.cells.corrected/1"}};
  for (const Bound& b : ports) {
    const Count vulkan = count(b, "vulkan");
    EXPECT_EQ(vulkan.no, 0) << b.c.folder();
    EXPECT_GT(vulkan.yes, 5 * vulkan.open) << b.c.folder();
    if (b.c.pass == "wave_step" || b.c.pass == "display") {
      EXPECT_EQ(count(b, "ieee").no, 0) << b.c.folder();
    }
  }
}
// And what a wrong one says may not.
TEST_F(SpirvModel, OfAWrongPortDoesNot) {
  const Bound b("puddle-corrected", "display", "puddle.display.corrected/1", "display_as_published.spv");
  const Count vulkan = count(b, "vulkan");
  EXPECT_GT(vulkan.no, 10 * (vulkan.yes + vulkan.open));
}
// A shader that looks at the bits of what it computed says nothing certain there, and nothing wrong.
TEST_F(SpirvModel, BitsOfAnIntervalAreLeftOpen) {
  const Count vulkan = count({"windshield-as-published", "splat", "windshield.splat.as-published/1"}, "vulkan");
  EXPECT_EQ(vulkan.no, 0);
  EXPECT_GT(vulkan.open, 0);
  EXPECT_GT(vulkan.yes, 0);
}
TEST_F(SpirvModel, OfAListIsRefused) {
  const Bound b("windshield-corrected", "integrate", "windshield.integrate.corrected/1");
  EXPECT_THROW(b.model(), Refusal);
}

// What is followed ends in what is stored, and each operation has its instruction.
TEST_F(SpirvModel, AnInvocationIsFollowedToWhatItStores) {
  for (const auto& [pass, formula] : {std::pair{"wave_step", "puddle.wave_step.corrected/2"}, {"shade", "puddle.shade.corrected/2"}}) {
    const Bound b("puddle-corrected", pass, formula);
    const auto program = spirv_model(b.c, b.program, b.spirv, "'a.spv'");
    std::vector<scalar::Scalar<float>> values(static_cast<std::size_t>(program->values()));
    for (int x = 1; x < program->width(); x += 9) {
      program->evaluate(x, 5, values.data());
      capture::ProgramTrace trace;
      program->trace(x, 5, trace);
      ASSERT_EQ(trace.steps.size(), trace.values.nodes.size());
      ASSERT_EQ(trace.outputs.size(), values.size());
      for (std::size_t k = 0; k < values.size(); ++k) {
        ASSERT_GE(trace.outputs[k], 0);
        EXPECT_EQ(trace.values.nodes[static_cast<std::size_t>(trace.outputs[k])].value, values[k].v) << pass << " at " << x;
      }
    }
  }
}
TEST_F(SpirvModel, NoMoreIsFollowedThanMayBe) {
  const Bound b("puddle-corrected", "shade", "puddle.shade.corrected/2");
  Limits few;
  few.followed = 50;
  const auto program = spirv_model(b.c, b.program, b.spirv, "'a.spv'", few);
  capture::ProgramTrace trace;
  EXPECT_THROW(program->trace(3, 5, trace), Refusal);
  EXPECT_LT(trace.values.nodes.size(), 200u);
}

}  // namespace
}  // namespace rainref::spirv
