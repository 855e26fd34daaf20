// Which sides of decisions are counted, and where they are said to stand.
#include "math/coverage.h"

#include <gmock/gmock.h>

#include "math/perturbed.h"

namespace rainref::perturbed {
namespace {

using testing::ElementsAre;
using testing::Pair;

template <class Text>
std::map<Decision, Sides> met(const Text& text) {
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
/// In a lambda of a test.
Decision here(int line, DecisionKind kind) { return {"math/coverage_test.cpp", line, kind, "operator()", ""}; }
template <class... Counts>
auto taken(Counts... counts) {
  return testing::Field(&Sides::counts, ElementsAre(counts...));
}
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
  EXPECT_THAT(
      all,
      ElementsAre(Pair(here(line, DecisionKind::choice), taken(1, 3, 0)), Pair(here(line + 1, DecisionKind::minimum), taken(3, 1, 0)),
                  Pair(here(line + 2, DecisionKind::maximum), taken(2, 2, 0)), Pair(here(line + 3, DecisionKind::clamp), taken(1, 2, 1))));
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
  EXPECT_THAT(
      all,
      ElementsAre(Pair(here(line, DecisionKind::clamp), taken(0, 0, 1)), Pair(here(line + 1, DecisionKind::clamp), taken(0, 1, 0)),
                  Pair(here(line + 2, DecisionKind::clamp), taken(1, 0, 0)), Pair(here(line + 3, DecisionKind::choice), taken(3, 0, 0)),
                  Pair(here(line + 4, DecisionKind::total_reflection), taken(0, 1, 0)),
                  Pair(here(line + 5, DecisionKind::total_reflection), taken(1, 0, 0))));
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
  EXPECT_THAT(coverage.decisions(), ElementsAre(Pair(Decision{"clamp", 0, DecisionKind::address, "", "bed"}, taken(1, 1, 0)),
                                                Pair(Decision{"repeat", 0, DecisionKind::load, "", ""}, taken(0, 1, 1))));
}

// A guard is the decision that it holds, and says of which sides nothing takes them.
TEST(Coverage, AGuardSaysWhyASideIsNeverTaken) {
  using scalar::guard, scalar::guard_below;
  const auto all = met([] {
    EXPECT_EQ(guard<Perturbed>(max(n(2), min(n(1), n(0))), "larger").v, 2);
    EXPECT_EQ(guard<Perturbed>(saturate(n(0.5f)), "a share").v, 0.5f);
    EXPECT_EQ(guard_below<Perturbed>(saturate(n(3)), "a length").v, 1);
    EXPECT_EQ(guard<Perturbed>(select(true, scalar::Vec3<Perturbed>(n(4), n(5), n(6)), scalar::Vec3<Perturbed>()), "there").z.v, 6);
  });
  const int line = __LINE__ - 5;
  const auto because = [](const char* first, const char* second, const char* third) {
    return testing::Field(&Sides::reasons, ElementsAre(first, second, third));
  };
  EXPECT_THAT(all, ElementsAre(Pair(here(line, DecisionKind::minimum), because("", "", "")),
                               Pair(here(line, DecisionKind::maximum), because("", "larger", "")),
                               Pair(here(line + 1, DecisionKind::clamp), because("a share", "", "a share")),
                               Pair(here(line + 2, DecisionKind::clamp), because("a length", "", "")),
                               Pair(here(line + 3, DecisionKind::choice), because("", "there", ""))));
  EXPECT_EQ(guard<scalar::Scalar<float>>(scalar::Scalar<float>(7.0f), "of any number").v, 7);
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
