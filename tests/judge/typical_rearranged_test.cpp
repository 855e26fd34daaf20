// Real devices rearrange where their API lets them, with the errors that real devices have.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "judge/mini_port.h"
#include "windshield/surface/wipe_texture.pass.h"

namespace rainref::judge::test {
namespace {

using windshield::Wiper;
using windshield::WipeTextureUniforms;

/// A device of its own: the document's formula in float, the blade's two products made one, (outer - inner) axis, as a compiler may.
float time_since_wipe(const WipeTextureUniforms& u, const Wiper& w, float wiped, int x, int y) {
  const float column = static_cast<float>(x) + 0.5f, row = static_cast<float>(y) + 0.5f;
  const float px = (u.frame[0] * column + u.frame[1] * row) - w.pivot[0], py = u.frame[2] * row - w.pivot[1];
  const auto to_blade = [&](const float(&axis)[2]) {
    const float length = w.outer_radius - w.inner_radius, along_x = length * axis[0], along_y = length * axis[1];
    const float from_x = px - w.inner_radius * axis[0], from_y = py - w.inner_radius * axis[1];
    const float t = std::clamp((from_x * along_x + from_y * along_y) / (along_x * along_x + along_y * along_y), 0.0f, 1.0f);
    return std::hypot(from_x - t * along_x, from_y - t * along_y);
  };
  const float(&c0)[2] = w.previous_axis, (&c1)[2] = w.axis;
  const float turn = w.direction < 0 ? -1.0f : 1.0f, r = std::sqrt(px * px + py * py);
  const float beside = std::max({turn * (px * c0[1] - py * c0[0]), turn * (py * c1[0] - px * c1[1]), 0.0f});
  const float behind = std::max(-(px * (c0[0] + c1[0]) + py * (c0[1] + c1[1])), 0.0f);
  const float between = std::max({w.inner_radius - r, r - w.outer_radius, 0.0f}) + 2 * (beside + behind);
  const float away = std::min({to_blade(c0), to_blade(c1), between});
  const float coverage = std::clamp(0.5f + (w.half_width - away) / u.edge_width, 0.0f, 1.0f);
  return std::min(wiped + u.dt, u.wiped_limit) * (1 - coverage) + 0.0f;
}

PassJudgement judged(const std::string& profile) {
  MiniPort port("windshield-neck");
  port.after = [](const capture::PassCase& c, std::vector<capture::Array>& outputs) {
    if (c.pass != "wipe_texture") return;
    WipeTextureUniforms u;
    Wiper w;
    std::memcpy(&u, c.uniforms.data(), sizeof u);
    ASSERT_EQ(u.wiper_count, 1);
    std::memcpy(&w, c.input("wipers")->array.levels[0].data(), sizeof w);
    for (std::size_t o = 0; o < outputs.size(); ++o) {
      if (c.outputs[o].name != "wiped") continue;
      capture::Array& to = outputs[o];
      for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
          const std::size_t at =
              sizeof(float) * (static_cast<std::size_t>(y) * static_cast<std::size_t>(to.width) + static_cast<std::size_t>(x));
          float wiped;
          std::memcpy(&wiped, c.input("wiped")->array.levels[0].data() + at, sizeof wiped);
          const float since = time_since_wipe(u, w, wiped, x, y);
          std::memcpy(to.levels[0].edit().data() + at, &since, sizeof since);
        }
      }
    }
  };
  return pass_of(judge::judged(port, profile), "wipe_texture");
}

std::int64_t atypical(const PassJudgement& pass) {
  std::int64_t sum = 0;
  for (const CaseJudgement& c : pass.cases)
    for (const OutputJudgement& o : c.outputs) sum += o.atypical;
  return sum;
}

TEST(Typical, WhatARearrangementGivesIsWhatDevicesDoWhereItIsAllowed) {
  const PassJudgement allowed = judged("vulkan"), forbidden = judged("cuda");
  EXPECT_EQ(allowed.status, Status::pass) << allowed.reason;
  EXPECT_EQ(atypical(allowed), 0);
  // CUDA lets no compiler do so.
  EXPECT_NE(forbidden.status, Status::pass);
}

}  // namespace
}  // namespace rainref::judge::test
