// Which sides of decisions are counted, and where they are said to stand.
#include "math/coverage.h"

#include <gmock/gmock.h>

#include "math/perturbed.h"

namespace rainref::perturbed {
namespace {

using testing::ElementsAre;
using testing::Pair;

template <class Text>
std::map<Decision, Coverage::Counts> met(const Text& text) {
  Coverage coverage;
  Behaviour counting;
  counting.coverage = &coverage;
  {
    const Scope scope(counting);
    text();
  }
  text();  // none of these
  return coverage.decisions();
}
Decision here(int line, DecisionKind kind) { return {"math/coverage_test.cpp", line, kind, ""}; }
Perturbed n(float x) { return Perturbed::of(x); }

TEST(Coverage, CountsEachSideAtTheLineOfThePassText) {
  const auto all = met([] {
    for (const float x : {-1.0f, 0.25f, 0.5f, 3.0f}) {
      select(n(x) < n(0.0f), n(1.0f), n(2.0f));
      min(n(x), n(0.5f));
      max(n(x), n(0.5f));
      clamp(n(x), n(0.0f), n(1.0f));
    }
  });
  const int line = __LINE__ - 6;
  EXPECT_THAT(all, ElementsAre(Pair(here(line, DecisionKind::choice), ElementsAre(1, 3, 0)),
                               Pair(here(line + 1, DecisionKind::minimum), ElementsAre(3, 1, 0)),
                               Pair(here(line + 2, DecisionKind::maximum), ElementsAre(2, 2, 0)),
                               Pair(here(line + 3, DecisionKind::clamp), ElementsAre(1, 2, 1))));
}

// What a named function decides is one decision, of the line that calls it.
TEST(Coverage, NamedFunctionsAreOneDecision) {
  const auto all = met([] {
    saturate(n(2.0f));
    smoothstep(0.0f, 1.0f, n(0.5f));
    smoothstep(4.0f, 0.5f, n(5.0f));
    select(true, scalar::Vec3<Perturbed>(), scalar::Vec3<Perturbed>());
    refract(scalar::Vec3<Perturbed>(n(0.8f), n(-0.6f), n(0.0f)), scalar::Vec3<Perturbed>(n(0.0f), n(1.0f), n(0.0f)), 1.333f);
    refract(scalar::Vec3<Perturbed>(n(0.8f), n(-0.6f), n(0.0f)), scalar::Vec3<Perturbed>(n(0.0f), n(1.0f), n(0.0f)), 0.75f);
  });
  const int line = __LINE__ - 7;
  EXPECT_THAT(all, ElementsAre(Pair(here(line, DecisionKind::clamp), ElementsAre(0, 0, 1)),
                               Pair(here(line + 1, DecisionKind::clamp), ElementsAre(0, 1, 0)),
                               Pair(here(line + 2, DecisionKind::clamp), ElementsAre(1, 0, 0)),
                               Pair(here(line + 3, DecisionKind::choice), ElementsAre(3, 0, 0)),
                               Pair(here(line + 4, DecisionKind::total_reflection), ElementsAre(0, 1, 0)),
                               Pair(here(line + 5, DecisionKind::total_reflection), ElementsAre(1, 0, 0))));
}

// A lookup's coordinates belong to the image that is fetched next; the numbers of the texels that they make are its own.
TEST(Coverage, LookupsAreOfTheImageThatTheyRead) {
  Coverage coverage;
  const float bed[4] = {}, sky[4] = {};
  coverage.addressed("clamp", DecisionKind::address, 0);
  coverage.addressed("clamp", DecisionKind::address, 1);
  coverage.addressed("clamp", DecisionKind::load, 2);
  for (int k = 0; k < 4; ++k) coverage.fetched(bed);
  coverage.addressed("repeat", DecisionKind::load, 2);
  coverage.addressed("repeat", DecisionKind::load, 1);
  coverage.fetched(sky);
  coverage.name_inputs([&](const float* texel) { return texel == bed ? "bed" : ""; });
  EXPECT_THAT(coverage.decisions(), ElementsAre(Pair(Decision{"clamp", 0, DecisionKind::address, "bed"}, ElementsAre(1, 1, 0)),
                                                Pair(Decision{"repeat", 0, DecisionKind::load, ""}, ElementsAre(0, 1, 1))));
}

// Counting changes no value.
TEST(Coverage, ChangesNoResult) {
  Coverage coverage;
  Behaviour counting;
  counting.coverage = &coverage;
  for (float x = -2; x <= 2; x += 0.0625f) {
    const auto value = [&] {
      return (smoothstep(-1.0f, 1.0f, n(x)) + saturate(n(x)) + clamp(n(x), n(-1.0f), n(0.5f)) + max(n(x), n(0.0f))).v;
    };
    const float without = value();
    const Scope scope(counting);
    EXPECT_EQ(value(), without) << x;
  }
}

}  // namespace
}  // namespace rainref::perturbed
