// Mistakes in integer texel loads: the values read from other places.
#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "faults/generators.h"
#include "faults/members.h"
#include "faults/taps.h"
#include "faults/text.h"

namespace rainref::faults {
namespace {

using capture::Array;
using capture::CaseInput;

/// Adds mistakes in the taps of an input, or of several inputs with equal taps.
class TapAdder {
 public:
  TapAdder(std::vector<Fault>& out, std::string name) : out_(out), name_(std::move(name)) {}
  void take(const CaseInput& input, const Taps& taps) {
    of_.push_back({std::make_shared<const CaseInput>(input),
                   std::make_shared<const std::vector<float>>(capture::decoded(input.array)),
                   taps.all,
                   {taps.scale_x, taps.scale_y}});
  }

  /// change(tap): the tap that is read instead; `more`: further names in its text.
  void operator()(Kind kind, std::vector<std::string> more, const std::function<Tap(Tap)>& change,
                  std::optional<Address> address = {}) const {
    std::vector<Read> reads = of_;
    std::size_t count = 0;
    bool is_changed = address.has_value();
    for (Read& read_of : reads)
      for (Tap& t : read_of.taps) {
        const Tap now = change(t);
        is_changed |= now != t;
        t = now;
        count = std::max(count, t.load + 1);
      }
    if (!is_changed) return;
    more.insert(more.begin(), name_);
    Fault& d = out_.emplace_back(What{kind, std::move(more)});
    d.head = of_.front().input->name;
    d.at_texel = [reads, count, address](Texel at, perturbed::Behaviour& b, std::vector<float>& loads) {
      loads.assign(count, std::numeric_limits<float>::quiet_NaN());
      for (const Read& from : reads)
        for (const Tap& t : from.taps) {
          const auto texel = [&, channel = t.channel](int dx, int dy) {
            const Array& a = from.input->array;
            const int x = placed(from.scale.x * at.x + dx, a.width, address.value_or(from.input->address_u)),
                      y = placed(from.scale.y * at.y + dy, a.height, address.value_or(from.input->address_v));
            return x >= 0 && y >= 0 ? (*from.texels)[static_cast<std::size_t>((y * a.width + x) * info(a.format).channels + channel)]
                   : address        ? 0.0f
                                    : from.input->border[static_cast<std::size_t>(channel)];
          };
          loads[t.load] = t.is_extrapolated ? 2 * texel(0, 0) - texel(t.dx, t.dy) : texel(t.dx, t.dy);
        }
      b.loads = &loads;
    };
  }

 private:
  struct Read {
    std::shared_ptr<const CaseInput> input;
    std::shared_ptr<const std::vector<float>> texels;  ///< decoded
    std::vector<Tap> taps;
    Texel scale;
  };
  std::vector<Fault>& out_;
  std::string name_;
  std::vector<Read> of_;
};

std::string plain(int dx, int dy) { return fmt::format("({}, {})", dx, dy); }

void add_neighbours(const TapAdder& add, const Taps& taps) {
  const auto all = [&](Kind kind, auto move) {
    add(kind, {}, [move](Tap t) {
      const auto [dx, dy] = move(t.dx, t.dy);
      return Tap{t.load, dx, dy, t.channel};
    });
  };
  all(Kind::taps_twice_as_far, [](int x, int y) { return std::pair(2 * x, 2 * y); });
  all(Kind::taps_diagonal, [](int x, int y) { return std::pair(x - y, x + y); });
  all(Kind::taps_axes_exchanged, [](int x, int y) { return std::pair(y, x); });
  all(Kind::taps_mirrored_in_x, [](int x, int y) { return std::pair(-x, y); });
  all(Kind::taps_mirrored_in_y, [](int x, int y) { return std::pair(x, -y); });
  all(Kind::taps_mirrored, [](int x, int y) { return std::pair(-x, -y); });
  all(Kind::taps_on_one_side, [](int x, int y) { return std::pair(std::max(x, 0), std::max(y, 0)); });
  all(Kind::taps_on_other_side, [](int x, int y) { return std::pair(std::min(x, 0), std::min(y, 0)); });
  for (const int way : {1, -1})
    add(way > 0 ? Kind::taps_doubled_right : Kind::taps_doubled_left, {}, [way](Tap t) {
      const bool is_left_out = way * (t.dx + t.dy) < 0;
      return is_left_out ? Tap{t.load, -t.dx, -t.dy, t.channel, true} : t;
    });
  all(Kind::taps_not_reached, [](int, int) { return std::pair(0, 0); });
  for (const auto& [dx, dy, kind] : {std::tuple(1, 0, Kind::taps_right),
                                     {-1, 0, Kind::taps_left},
                                     {0, 1, Kind::taps_up},
                                     {0, -1, Kind::taps_down},
                                     {-1, -1, Kind::taps_left_down},
                                     {1, 1, Kind::taps_right_up}})
    all(kind, [dx = dx, dy = dy](int x, int y) { return std::pair(x + dx, y + dy); });
  // One tap alone.
  std::set<std::pair<int, int>> places;
  for (const Tap& one : taps.all) places.insert({one.dx, one.dy});
  constexpr std::size_t most_places = 12;
  if (places.size() > 1 && places.size() <= most_places)
    for (const auto& from : places)
      for (const auto& to : places) {
        if (from == to) continue;
        add(Kind::tap_elsewhere, {offset_text(from.first, from.second), offset_text(to.first, to.second)}, [from, to](Tap t) {
          return t.dx == from.first && t.dy == from.second ? Tap{t.load, to.first, to.second, t.channel} : t;
        });
      }
  // One load alone of a texel that is read several times.
  constexpr std::size_t most_loads = 16;
  if (taps.all.size() <= most_loads)
    for (const Tap& one : taps.all) {
      const auto is_same = [&](const Tap& t) { return t.dx == one.dx && t.dy == one.dy && t.channel == one.channel; };
      const auto reads = std::count_if(taps.all.begin(), taps.all.end(), is_same);
      if (reads < 2) continue;
      const auto number = std::count_if(taps.all.begin(), taps.all.end(), [&](const Tap& t) { return is_same(t) && t.load <= one.load; });
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          if (dx == one.dx && dy == one.dy) continue;
          add(Kind::one_read_elsewhere, {std::to_string(number), plain(one.dx, one.dy), plain(dx, dy), std::to_string(reads)},
              [load = one.load, dx, dy](Tap t) {
                return t.load == load ? Tap{t.load, dx, dy, t.channel} : t;
              });
        }
    }
  // All taps of one row or column.
  std::set<std::pair<bool, int>> lines;
  for (const Tap& one : taps.all)
    for (const bool is_row : {true, false}) {
      const int line = is_row ? one.dy : one.dx;
      const auto is_in = [is_row, line](const Tap& t) { return (is_row ? t.dy : t.dx) == line; };
      const auto count = std::count_if(taps.all.begin(), taps.all.end(), is_in);
      if (count < 2 || count == static_cast<std::ptrdiff_t>(taps.all.size()) || !lines.insert({is_row, line}).second || lines.size() > 10)
        continue;
      const auto moved = [&](Kind kind, const std::string& to, auto move) {
        add(kind, {std::to_string(line), to}, [is_in, move](Tap t) { return is_in(t) ? move(t) : t; });
      };
      for (const int to : {line - 1, line + 1, -line, 0})
        if (to != line)
          moved(is_row ? Kind::taps_of_row : Kind::taps_of_column, std::to_string(to), [is_row, to](Tap t) {
            return Tap{t.load, is_row ? t.dx : to, is_row ? to : t.dy, t.channel};
          });
      moved(is_row ? Kind::taps_across_row : Kind::taps_across_column, "", [is_row, line](Tap t) {
        return is_row ? Tap{t.load, t.dx + line, t.dy - line, t.channel} : Tap{t.load, t.dx - line, t.dy + line, t.channel};
      });
    }
  std::set<std::pair<int, int>> done;
  for (const Tap& one : taps.all) {
    if (!done.insert({one.dx, one.dy}).second || done.size() > 9 || taps.all.size() < 2) continue;
    const auto alone = [&](int dx, int dy, Kind kind) {
      add(kind, {plain(one.dx, one.dy), plain(dx, dy)}, [one, dx, dy](Tap t) {
        return t.dx == one.dx && t.dy == one.dy ? Tap{t.load, dx, dy, t.channel} : t;
      });
    };
    if (taps.is_neighbour(one)) {
      alone(0, 0, Kind::neighbour_itself);
      alone(-one.dx, -one.dy, Kind::neighbour_opposite);
      alone(2 * one.dx, 2 * one.dy, Kind::neighbour_too_far);
      alone(one.dy, one.dx, Kind::neighbour_across);
    }
    for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)})
      alone(one.dx + dx, one.dy + dy, Kind::neighbour_at);
  }
}

void add_channels(const TapAdder& add, int channels) {
  for (int from = 0; from < channels; ++from)
    for (int to = 0; to < channels; ++to)
      if (from != to)
        add(Kind::taps_in_channel, {component_name(to), component_name(from)}, [from, to](Tap t) {
          return Tap{t.load, t.dx, t.dy, t.channel == from ? to : t.channel};
        });
}

}  // namespace

void add_tap_faults(std::vector<Fault>& out, const Probed& p) {
  std::vector<std::pair<const CaseInput*, Taps>> neighbours;
  for (std::size_t i = 0; i < p.c.inputs.size(); ++i) {
    const CaseInput& input = p.c.inputs[i];
    const Taps taps = taps_of(p, i);
    const int channels = info(input.array.format).channels;
    if (taps.all.empty()) continue;
    TapAdder add(out, input.name);
    add.take(input, taps);
    add_neighbours(add, taps);
    add_channels(add, channels);
    if (std::none_of(taps.all.begin(), taps.all.end(), [&](const Tap& t) { return taps.is_neighbour(t); })) continue;
    for (const Address address : {Address::clamp, Address::repeat, Address::mirror, Address::border})
      if (input.address_u != address || input.address_v != address)
        add(
            Kind::taps_beyond_edge, {address_words(address)}, [](Tap t) { return t; }, address);
    neighbours.emplace_back(&input, taps);
  }
  if (neighbours.size() < 2) return;
  std::string names;
  for (const auto& [input, taps] : neighbours) names += (names.empty() ? "" : " and ") + input->name;
  TapAdder all(out, names);
  for (const auto& [input, taps] : neighbours) all.take(*input, taps);
  add_neighbours(all, neighbours.front().second);
}

}  // namespace rainref::faults
