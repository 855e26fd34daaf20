// Ports that do nothing: which of them a case knows, and that a pass which one of them passes is found out.
#include <gmock/gmock.h>

#include <cstring>

#include "judge/null_ports.h"
#include "judge/profiles.h"
#include "judge/reference_outputs.h"
#include "judge/support.h"

namespace rainref::judge {
namespace {

using testing::Contains;
using testing::IsEmpty;

/// `gain` times the input "from", loaded by its texel.
struct Scaled {
  int width = 8, height = 4, values = 1;
  float gain = 1;
  std::vector<float> from;
  template <class N>
  void operator()(int x, int y, N* out) const {
    out[0] = N(gain) * N(from[static_cast<std::size_t>(y * width + x)]);
  }
};
/// A sine of hundreds.
struct Sine : Scaled {
  template <class N>
  void operator()(int x, int y, N* out) const {
    out[0] = sin(N(gain) * N(from[static_cast<std::size_t>(y * width + x)]));
  }
};
struct Made {
  capture::PassCase c;
  std::unique_ptr<capture::PassModel> model;

  Made(float gain, float level) { make<Scaled>(gain, level); }
  static Made sine(float gain, float level) {
    Made m;
    m.make<Sine>(gain, level);
    return m;
  }

 private:
  Made() = default;
  template <class Pass>
  void make(float gain, float level) {
    Pass pass;
    pass.gain = gain;
    pass.from.assign(32, level);
    model = capture::model_of(pass);
    c.effect = "made_up";
    c.pass = "scaled";
    capture::CaseOutput out;
    out.name = "to";
    out.array.format = Format::r32f;
    out.array.width = 8;
    out.array.height = 4;
    out.array.levels.emplace_back(8 * 4 * 4);
    capture::CaseInput in;
    in.name = "from";
    in.array = out.array;
    std::memcpy(in.array.levels[0].edit().data(), pass.from.data(), 8 * 4 * 4);
    c.inputs = {in};
    c.outputs = {out};
    const parallel::Executor executor(1);
    c.outputs[0].array = reference_outputs(c, *model, executor)[0];
  }
};
std::string passing(const std::vector<const Made*>& cases, const std::string& rules = "vulkan", const std::string& typical = "") {
  const parallel::Executor executor(2);
  NullPorts ports;
  for (const Made* m : cases)
    ports.judge(m->c, m->model.get(), profile(rules), typical.empty() ? nullptr : &profile(typical), HalfMode::either, executor);
  return ports.passing();
}

TEST(NullPorts, APassThatDoesNothingIsFound) {
  const Made copies(1, 0.5f), clears(0, 0.5f), halves(0.5f, 0.5f), rests(0.5f, 0);
  EXPECT_EQ(passing({&copies}), "a copy of its input from");
  EXPECT_EQ(passing({&clears}), "zeros");
  EXPECT_EQ(passing({&halves}), "");
  EXPECT_EQ(passing({&rests}), "zeros");
  EXPECT_EQ(passing({}), "") << "nothing was judged";
}
// One case in which it does something is enough; another null port in each case is not one that passes all.
TEST(NullPorts, EachMustPassEveryCase) {
  const Made copies(1, 0.5f), clears(0, 0.5f), halves(0.5f, 0.5f), rests(0.5f, 0);
  EXPECT_EQ(passing({&rests, &halves}), "");
  EXPECT_EQ(passing({&rests, &copies}), "a copy of its input from");
  EXPECT_EQ(passing({&copies, &clears}), "");
}
// WGSL promises nothing of such a sine, so every value lies inside its profile; what known devices do says no.
TEST(NullPorts, OneThatAJudgementWouldWarnOfDoesNotPass) {
  const Made sine = Made::sine(300, 1);  // sin 300 = -0.9998
  EXPECT_EQ(passing({&sine}, "webgpu"), "zeros");
  EXPECT_EQ(passing({&sine}, "webgpu", "typical"), "");
  const Made nearly = Made::sine(628.318531f, 0);
  EXPECT_EQ(passing({&nearly}, "webgpu", "typical"), "zeros") << "a sine of 0 is 0";
}
TEST(NullPorts, NoPassOfTheSmallPacksIsPassedByOne) {
  const parallel::Executor executor(2);
  for (const test::BoundPass& pass : test::judged_passes()) {
    NullPorts ports;
    for (const test::BoundCase& b : pass.cases)
      ports.judge(*b.c, b.model.get(), profile("vulkan"), &profile("typical"), HalfMode::either, executor);
    EXPECT_THAT(ports.passing(), IsEmpty()) << pass.name();
  }
}
TEST(NullPorts, AreZerosAndTheInputsOfTheOutputsFormat) {
  std::vector<std::string> names;
  for (const test::BoundPass& pass : test::judged_passes({test::shipped_pack("puddle-corrected", {"wave_step"})}))
    for (const NullPort& port : null_ports(*pass.cases.front().c)) names.push_back(port.what);
  EXPECT_THAT(names, Contains("zeros"));
  EXPECT_THAT(names, Contains("a copy of its input wave"));
}

}  // namespace
}  // namespace rainref::judge
