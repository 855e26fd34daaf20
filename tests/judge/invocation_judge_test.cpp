// What is allowed for an invocation is kept for the next port, and no answer hangs on which port came first.
#include <gtest/gtest.h>

#include <vector>

#include "judge/invocation_judge.h"
#include "judge/mini_port.h"
#include "judge/profiles.h"
#include "judge/support.h"

namespace rainref::judge {
namespace {

TEST(InvocationJudge, AnswersAsOneWhoWasNeverAsked) {
  std::map<Accepted, int> met;
  for (const test::PackPasses& proven : test::proven_packs()) {
    const std::string& name = proven.name;
    MiniPort port(name);
    for (const capture::PackPass& pass : port.pack.passes) {
      if (!proven.has(pass.name)) continue;
      const auto entry = std::find_if(port.pack.cases.begin(), port.pack.cases.end(), [&](const auto& c) { return c.pass == pass.name; });
      const capture::PassCase c = port.pack.read(*entry);
      const capture::PassEvaluations* evaluations = evaluations_of(port.pack.effect, pass.name);
      if (!evaluations || !evaluations->bind || slots_of(c).empty()) continue;
      const std::unique_ptr<capture::PassModel> model = evaluations->bind(c);
      for (const HalfMode mode : {HalfMode::rne, HalfMode::rtz}) {
        const InvocationJudge keeps(c, *model, profile("vulkan"), mode, true);
        for (const perturbed::Fault fault : {perturbed::Fault::none, perturbed::Fault::fused, perturbed::Fault::half_intermediates}) {
          port.behaviour.fault = fault;
          const std::vector<capture::Array> outputs = port.outputs(c);
          for (int y = 0; y < model->height(); y += 1 + model->height() / 4)
            for (int x = 0; x < model->width(); x += 1 + model->width() / 4) {
              const Accepted expected = InvocationJudge(c, *model, profile("vulkan"), mode).accepts(x, y, outputs);
              EXPECT_EQ(keeps.accepts(x, y, outputs), expected) << name << ' ' << pass.name << ' ' << x << ' ' << y;
              ++met[expected];
            }
        }
      }
    }
  }
  EXPECT_EQ(met.size(), 3u) << "every answer is among them";
}

}  // namespace
}  // namespace rainref::judge
