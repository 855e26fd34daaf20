// What is read when a port takes texels loaded by integers from elsewhere.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "faults/taps.h"
#include "faults/whole_faults.h"

namespace rainref::faults {
namespace {

using capture::Array;
using capture::CaseInput;

/// Adds what is read in place of the taps of an input, or of several that are read alike.
class Adder {
 public:
  Adder(std::vector<Fault>& out, std::string name) : out_(out), name_(std::move(name)) {}
  void take(const CaseInput& input, const Taps& taps) {
    of_.push_back({std::make_shared<const CaseInput>(input),
                   std::make_shared<const std::vector<float>>(capture::decoded(input.array)),
                   taps.all,
                   {taps.scale_x, taps.scale_y}});
  }
  const std::string& name() const { return name_; }

  /// change(tap): what is read in place of it.
  void operator()(const std::string& what, std::string sentence, const std::function<Tap(Tap)>& change,
                  std::optional<Address> address = {}) const {
    std::vector<Read> reads = of_;
    std::size_t count = 0;
    bool changes = address.has_value();
    for (Read& read_of : reads)
      for (Tap& t : read_of.taps) {
        const Tap now = change(t);
        changes |= now != t;
        t = now;
        count = std::max(count, t.load + 1);
      }
    if (!changes) return;
    Fault d;
    d.name = fmt::format("{} {}", name_, what);
    d.sentence = std::move(sentence);
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
    d.for_diagnosis = true;
    out_.push_back(std::move(d));
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

void add_neighbours(const Adder& add, const Taps& taps) {
  const std::string& in = add.name();
  const auto all = [&](const char* name, const char* sentence, auto move) {
    add(name, fmt::format("{} {}", in, sentence), [move](Tap t) {
      const auto [dx, dy] = move(t.dx, t.dy);
      return Tap{t.load, dx, dy, t.channel};
    });
  };
  all("neighbours two texels away", "is read at twice the distance", [](int x, int y) { return std::pair(2 * x, 2 * y); });
  all("diagonal neighbours", "is read at the diagonal neighbours", [](int x, int y) { return std::pair(x - y, x + y); });
  all("neighbours with x and y exchanged", "is read with columns and rows exchanged", [](int x, int y) { return std::pair(y, x); });
  all("neighbours mirrored in x", "is read to the left where it should be to the right", [](int x, int y) { return std::pair(-x, y); });
  all("neighbours mirrored in y", "is read above where it should be below", [](int x, int y) { return std::pair(x, -y); });
  all("neighbours on both sides mirrored", "is read on the opposite sides", [](int x, int y) { return std::pair(-x, -y); });
  all("neighbours on one side alone", "is read at the texel itself in place of the neighbours to the left and below: one-sided differences",
      [](int x, int y) { return std::pair(std::max(x, 0), std::max(y, 0)); });
  all("neighbours on the other side alone", "is read at the texel itself in place of the neighbours to the right and above",
      [](int x, int y) { return std::pair(std::min(x, 0), std::min(y, 0)); });
  for (const int way : {1, -1}) {
    const char* const sides = way > 0 ? "to the right and above" : "to the left and below";
    add(fmt::format("differences on one side, twice, {}", sides),
        fmt::format(
            "{} is not read on both sides: in place of central differences stands twice the difference between the texel itself and "
            "its neighbours {}",
            in, sides),
        [way](Tap t) {
          const bool is_left_out = way * (t.dx + t.dy) < 0;
          return is_left_out ? Tap{t.load, -t.dx, -t.dy, t.channel, true} : t;
        });
  }
  all("neighbours not reached", "is read at the texel itself in place of its neighbours", [](int, int) { return std::pair(0, 0); });
  for (const auto& [dx, dy, way] : {std::tuple(1, 0, "one column to the right"),
                                    {-1, 0, "one column to the left"},
                                    {0, 1, "one row up"},
                                    {0, -1, "one row down"},
                                    {-1, -1, "one column to the left and one row down"},
                                    {1, 1, "one column to the right and one row up"}}) {
    all(fmt::format("read {}", way).c_str(), fmt::format("is read {}", way).c_str(),
        [dx = dx, dy = dy](int x, int y) { return std::pair(x + dx, y + dy); });
  }
  // One of them alone.
  std::set<std::pair<int, int>> places;
  for (const Tap& one : taps.all) places.insert({one.dx, one.dy});
  constexpr std::size_t most_places = 12;
  if (places.size() > 1 && places.size() <= most_places)
    for (const auto& from : places)
      for (const auto& to : places) {
        if (from == to) continue;
        const auto place = [](const std::pair<int, int>& at) {
          return at.first == 0 && at.second == 0 ? std::string("the texel itself") : fmt::format("({}, {})", at.first, at.second);
        };
        add(fmt::format("tap {} at {}", place(from), place(to)),
            fmt::format("{} is read at {} where {} is meant, columns and rows from the texel itself", in, place(to), place(from)),
            [from, to](Tap t) {
              return t.dx == from.first && t.dy == from.second ? Tap{t.load, to.first, to.second, t.channel} : t;
            });
      }
  // Of a texel that is read several times one read alone.
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
          add(fmt::format("read {} of ({}, {}) at ({}, {})", number, one.dx, one.dy, dx, dy),
              fmt::format("{} is read at ({}, {}) where ({}, {}) is meant, columns and rows from the texel itself, in read {} of {} of it",
                          in, dx, dy, one.dx, one.dy, number, reads),
              [load = one.load, dx, dy](Tap t) {
                return t.load == load ? Tap{t.load, dx, dy, t.channel} : t;
              });
        }
    }
  // All of one row or one column of them.
  std::set<std::pair<bool, int>> lines;
  for (const Tap& one : taps.all)
    for (const bool is_row : {true, false}) {
      const int line = is_row ? one.dy : one.dx;
      const auto is_in = [is_row, line](const Tap& t) { return (is_row ? t.dy : t.dx) == line; };
      const auto count = std::count_if(taps.all.begin(), taps.all.end(), is_in);
      if (count < 2 || count == static_cast<std::ptrdiff_t>(taps.all.size()) || !lines.insert({is_row, line}).second || lines.size() > 10)
        continue;
      const std::string which = fmt::format("neighbours in {} {}", is_row ? "row" : "column", line);
      const auto moved = [&](const std::string& words, auto move) {
        add(fmt::format("{} {}", which, words),
            fmt::format("the texels of {} in {} {} from here are {}", in, is_row ? "row" : "column", line, words),
            [is_in, move](Tap t) { return is_in(t) ? move(t) : t; });
      };
      for (const int to : {line - 1, line + 1, -line, 0})
        if (to != line)
          moved(fmt::format("read in {} {}", is_row ? "row" : "column", to), [is_row, to](Tap t) {
            return Tap{t.load, is_row ? t.dx : to, is_row ? to : t.dy, t.channel};
          });
      moved("read along the other axis", [is_row, line](Tap t) {
        return is_row ? Tap{t.load, t.dx + line, t.dy - line, t.channel} : Tap{t.load, t.dx - line, t.dy + line, t.channel};
      });
    }
  std::set<std::pair<int, int>> done;
  for (const Tap& one : taps.all) {
    if (!done.insert({one.dx, one.dy}).second || done.size() > 9 || taps.all.size() < 2) continue;
    const auto alone = [&](int dx, int dy, const std::string& words) {
      add(fmt::format("neighbour ({}, {}) {}", one.dx, one.dy, words),
          fmt::format("the texel ({}, {}) away of {} is {}", one.dx, one.dy, in, words), [one, dx, dy](Tap t) {
            return t.dx == one.dx && t.dy == one.dy ? Tap{t.load, dx, dy, t.channel} : t;
          });
    };
    if (taps.is_neighbour(one)) {
      alone(0, 0, "the texel itself");
      alone(-one.dx, -one.dy, "the one opposite");
      alone(2 * one.dx, 2 * one.dy, "read one too far");
      alone(one.dy, one.dx, "read along the other axis");
    }
    for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)})
      alone(one.dx + dx, one.dy + dy, fmt::format("read at ({}, {})", one.dx + dx, one.dy + dy));
  }
}

void add_channels(const Adder& add, const Taps& taps, int channels) {
  for (int from = 0; from < channels; ++from)
    for (int to = 0; to < channels; ++to)
      if (from != to)
        add(fmt::format("read in {} for {}", "xyzw"[to], "xyzw"[from]),
            fmt::format("{}.{} is read where {}.{} is meant", taps.input, "xyzw"[to], taps.input, "xyzw"[from]), [from, to](Tap t) {
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
    Adder add(out, input.name);
    add.take(input, taps);
    add_neighbours(add, taps);
    add_channels(add, taps, channels);
    if (std::none_of(taps.all.begin(), taps.all.end(), [&](const Tap& t) { return taps.is_neighbour(t); })) continue;
    for (const auto& [address, words] : {std::pair(Address::clamp, "clamped"), std::pair(Address::repeat, "repeated"),
                                         std::pair(Address::mirror, "mirrored"), std::pair(Address::border, "0")}) {
      if (input.address_u == address && input.address_v == address) continue;
      add(
          fmt::format("{} beyond its edge", words), fmt::format("beyond its edge {} is {}: another address mode", input.name, words),
          [](Tap t) { return t; }, address);
    }
    neighbours.emplace_back(&input, taps);
  }
  if (neighbours.size() < 2) return;
  std::string names;
  for (const auto& [input, taps] : neighbours) names += (names.empty() ? "" : " and ") + input->name;
  Adder all(out, names);
  for (const auto& [input, taps] : neighbours) all.take(*input, taps);
  add_neighbours(all, neighbours.front().second);
}

}  // namespace rainref::faults
