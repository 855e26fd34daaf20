// A buffer that a pass reads and writes: effects of missing ping-pong, and of exchanging a texel's own two levels.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>

#include "capture/bound_texture.h"
#include "faults/generators.h"
#include "faults/taps.h"
#include "judge/slots.h"

namespace rainref::faults {
namespace {

using capture::Array;
using judge::Slot;

/// An input that the pass also writes, with one size and format: its values before and after.
struct Updated {
  const capture::CaseInput& input;
  Taps taps;
  std::vector<float> before, after;  ///< decoded; after: the port's stored values

  /// Texel of a load; false: outside, where the border is a number.
  bool place(const Tap& t, Texel at, Texel& from) const {
    const Array& a = input.array;
    from = {placed(at.x + t.dx, a.width, input.address_u), placed(at.y + t.dy, a.height, input.address_v)};
    return from.x >= 0 && from.y >= 0;
  }
  float value(const std::vector<float>& texels, Texel at, int channel) const {
    return texels[static_cast<std::size_t>((at.y * input.array.width + at.x) * info(input.array.format).channels + channel)];
  }
  /// All loads of an invocation at a texel: if is_new(texel), from the values after the pass, in channel channel_of(tap).
  template <class IsNew, class ChannelOf>
  std::vector<float> loads(Texel at, const IsNew& is_new, const ChannelOf& channel_of) const {
    std::size_t count = 0;
    for (const Tap& t : taps.all) count = std::max(count, t.load + 1);
    std::vector<float> out(count, std::numeric_limits<float>::quiet_NaN());
    for (const Tap& t : taps.all) {
      const int channel = channel_of(t);
      Texel from;
      out[t.load] =
          !place(t, at, from) ? input.border[static_cast<std::size_t>(channel)] : value(is_new(from) ? after : before, from, channel);
    }
    return out;
  }
};
int own_channel(const Tap& t) { return t.channel; }

using Of = std::shared_ptr<const Updated>;

Fault with_loads(What what, std::function<std::vector<float>(Texel)> loads_at) {
  Fault d(std::move(what));
  d.at_texel = [loads_at = std::move(loads_at)](Texel at, perturbed::Behaviour& b, std::vector<float>& loads) {
    loads = loads_at(at);
    b.loads = &loads;
  };
  return d;
}

/// Sequential evaluation: texels earlier in row order, upward or downward, are new.
void add_scans(std::vector<Fault>& out, const Of& u) {
  for (const bool is_upward : {true, false})
    out.push_back(with_loads({is_upward ? Kind::in_place : Kind::in_place_from_last_row, {u->input.name}}, [u, is_upward](Texel at) {
      const auto is_new = [=](Texel t) { return t.y == at.y ? t.x < at.x : (t.y < at.y) == is_upward; };
      return u->loads(at, is_new, own_channel);
    }));
}

/// Evaluation in groups: a neighbour in another group is new or old, in an unknown order of groups. For each texel, the order of its
/// neighbouring groups that is nearest to the port's values is taken. A texel inside a group has one possible order, at its edge two: too
/// few to fit by chance.
void add_group_orders(std::vector<Fault>& out, const Probed& p, const std::vector<Array>& port, const Of& u) {
  const std::vector<Slot> slots = judge::slots_of(p.c);
  constexpr std::pair<int, int> sizes[] = {{8, 8}, {16, 16}, {16, 8}, {8, 4}, {32, 32}, {32, 1}, {64, 1}};
  for (const auto& [width, height] : sizes) {
    if (width >= p.model.width() && height >= p.model.height()) continue;
    out.push_back(with_loads({Kind::in_place_by_groups, {u->input.name, std::to_string(width), std::to_string(height)}},
                             [u, slots, &model = p.model, &port, w = width, h = height](Texel at) {
                               const auto group_of = [=](Texel t) { return std::pair(t.x / w, t.y / h); };
                               std::vector<std::pair<int, int>> others;
                               for (const Tap& t : u->taps.all)
                                 if (Texel from; u->place(t, at, from) && group_of(from) != group_of(at) &&
                                                 std::find(others.begin(), others.end(), group_of(from)) == others.end())
                                   others.push_back(group_of(from));
                               constexpr std::size_t most = 3;
                               if (others.size() > most) others.clear();
                               std::vector<float> best;
                               double least = HUGE_VAL;
                               for (unsigned ran = 0; ran < 1u << others.size(); ++ran) {
                                 const auto is_new = [&](Texel t) {
                                   const auto found = std::find(others.begin(), others.end(), group_of(t));
                                   return found != others.end() && (ran >> (found - others.begin()) & 1) != 0;
                                 };
                                 std::vector<float> loads = u->loads(at, is_new, own_channel);
                                 perturbed::Behaviour behaviour;
                                 behaviour.loads = &loads;
                                 std::vector<perturbed::Perturbed> values(slots.size());
                                 {
                                   const perturbed::Scope scope(behaviour);
                                   model.evaluate(at.x, at.y, values.data());
                                 }
                                 double off = 0;
                                 for (std::size_t v = 0; v < slots.size(); ++v) {
                                   const Array& stored = port[static_cast<std::size_t>(slots[v].output)];
                                   off += std::abs(static_cast<double>(values[v].v) -
                                                   judge::stored_value(slots[v], slots[v].at(stored, at.x, at.y)));
                                 }
                                 if (best.empty() || off < least) least = off, best = std::move(loads);
                               }
                               return best;
                             }));
  }
}

/// Exchanges the two levels of a texel itself, with correct neighbours: in all of its loads, or in some of a few.
void add_own_exchange(std::vector<Fault>& out, const Of& u) {
  std::vector<Tap> own;
  for (const Tap& t : u->taps.all)
    if (!u->taps.is_neighbour(t)) own.push_back(t);
  const auto add = [&](std::vector<std::size_t> loads) {
    out.push_back(with_loads({Kind::own_channels_exchanged, {u->input.name}}, [u, loads = std::move(loads)](Texel at) {
      return u->loads(
          at, [](Texel) { return false; },
          [&](const Tap& t) { return std::find(loads.begin(), loads.end(), t.load) != loads.end() ? 1 - t.channel : t.channel; });
    }));
  };
  constexpr std::size_t few = 4;
  const unsigned all = own.size() > few ? 1 : (1u << own.size()) - 1;
  for (unsigned some = 1; some <= all; ++some) {
    std::vector<std::size_t> loads;
    bool has[2] = {false, false};
    for (std::size_t k = 0; k < own.size(); ++k)
      if (own.size() > few || (some >> k & 1) != 0) loads.push_back(own[k].load), has[own[k].channel] = true;
    if (has[0] && has[1]) add(std::move(loads));
  }
}

}  // namespace

void add_in_place_faults(std::vector<Fault>& out, const Probed& p, const std::vector<Array>& port) {
  for (std::size_t i = 0; i < p.c.inputs.size(); ++i) {
    const capture::CaseInput& input = p.c.inputs[i];
    const auto o = static_cast<std::size_t>(
        std::find_if(p.c.outputs.begin(), p.c.outputs.end(), [&](const capture::CaseOutput& one) { return one.name == input.name; }) -
        p.c.outputs.begin());
    if (input.array.is_records || o == p.c.outputs.size() || port[o].format != input.array.format || port[o].width != input.array.width ||
        port[o].height != input.array.height || input.array.width != p.model.width() || input.array.height != p.model.height())
      continue;
    Taps taps = taps_of(p, i);
    if (std::none_of(taps.all.begin(), taps.all.end(), [&](const Tap& t) { return taps.is_neighbour(t); })) continue;
    const Of u = std::make_shared<const Updated>(Updated{input, std::move(taps), capture::decoded(input.array), capture::decoded(port[o])});
    add_scans(out, u);
    add_group_orders(out, p, port, u);
    if (info(input.array.format).channels == 2) add_own_exchange(out, u);
  }
}

}  // namespace rainref::faults
