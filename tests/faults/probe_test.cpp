// What a pass computes at a texel, in words.
#include "faults/probe.h"

#include <gtest/gtest.h>

namespace rainref::faults {
namespace {

using perturbed::Op;

/// A march: each step's number is chosen between the one before and that plus something.
Probe march(int steps) {
  Probe p;
  p.trace.nodes.push_back({Op::constant, 1, 0, 0});
  p.names = {"start"};
  std::int32_t last = 0;
  for (int k = 0; k < steps; ++k) {
    p.trace.nodes.push_back({Op::sum, 1, 0, 0, {last, 0, -1, -1}});
    p.trace.nodes.push_back({Op::choice, 1, 0, 0, {last + 1, last, -1, -1}});
    last = static_cast<std::int32_t>(p.trace.nodes.size()) - 1;
  }
  p.names.resize(p.trace.nodes.size());
  return p;
}

TEST(Probe, TextOfAMarchIsShort) {
  const Probe one = march(1);
  EXPECT_EQ(one.text(2, 2), "start + start or start");
  // 2^60 terms without a limit on choices.
  const Probe many = march(60);
  EXPECT_LT(many.text(static_cast<std::int32_t>(many.trace.nodes.size()) - 1, 3).size(), 200u);
}

}  // namespace
}  // namespace rainref::faults
