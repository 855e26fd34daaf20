#include "windshield/motion/wipers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/number_text.h"
#include "math/real64.h"
#include "rainref/error.h"
#include "scene/rows_of_text.h"

namespace rainref::windshield {
namespace {

constexpr double largest_sweep = 170;   // [deg] below a half turn, so that the sector is the intersection of two half planes
constexpr double largest_drop = 0.010;  // [m] base radius of the heaviest drop, 2^24 mass units: 8 mm

// Angle by cycles since time 0.
double angle_at(const Blade& b, double cycles) {
  const double turn = 2 * pi * (cycles - std::floor(cycles));
  return b.start_angle + 0.5 * b.sweep * (1 - cos_real(Real64(turn)).v);
}

void put(const Real2& from, float (&to)[2]) {
  to[0] = static_cast<float>(from[0]);
  to[1] = static_cast<float>(from[1]);
}

Wiper record_of(const Blade& b, double half_width, const PlaneFrame& plane, double angle0, double angle1, double duration) {
  Wiper w{};
  const Real2 axis0{cos_real(Real64(angle0)).v, sin_real(Real64(angle0)).v}, axis1{cos_real(Real64(angle1)).v, sin_real(Real64(angle1)).v};
  const auto end = [&](const Real2& axis, double radius) {
    return plane.to_glass({b.pivot[0] + radius * axis[0], b.pivot[1] + radius * axis[1]});
  };
  put(end(axis0, b.inner_radius), w.previous_inner);
  put(end(axis0, b.outer_radius), w.previous_outer);
  put(end(axis1, b.inner_radius), w.inner);
  put(end(axis1, b.outer_radius), w.outer);
  put(b.pivot, w.pivot);
  w.inner_radius = static_cast<float>(b.inner_radius);
  w.outer_radius = static_cast<float>(b.outer_radius);
  put(axis0, w.previous_axis);
  put(axis1, w.axis);
  w.half_width = static_cast<float>(half_width);
  if (angle1 != angle0) {
    w.rate = static_cast<float>((angle1 - angle0) / duration);
    w.direction = angle1 > angle0 ? 1.0f : -1.0f;
  }
  return w;
}

}  // namespace

std::vector<Blade> arranged_blades(std::string_view arrangement, int count, const Glass& glass) {
  constexpr std::array<Blade, most_wipers> opposed{
      {{{0.06, -0.05}, 0.15, 0.8, 5 * degree, 88 * degree, 0}, {{1.34, -0.05}, 0.15, 0.8, 175 * degree, -88 * degree, 0}}};
  const std::array<Blade, most_wipers>& blades = arrangement == "opposed" ? opposed : tandem_blades;
  const PlaneFrame plane = glass.plane();
  const double across = plane.frame[0] / 1.4, up = plane.frame[2] / 0.8, size = std::min(across, up);
  std::vector<Blade> out(blades.begin(), blades.begin() + count);
  for (Blade& b : out) {
    b.pivot = {b.pivot[0] * across, b.pivot[1] * up};
    b.inner_radius *= size;
    b.outer_radius *= size;
  }
  return out;
}

void check(const WiperSettings& s, const Glass& glass, std::string_view table) {
  const double diagonal_sq = glass.metric[0] + glass.metric[2] + 2 * std::abs(glass.metric[1]), diagonal = __builtin_sqrt(diagonal_sq);
  for (std::size_t i = 0; i < s.blades.size(); ++i) {
    const Blade& b = s.blades[i];
    const auto refuse = [&](const char* key, const std::string& expected, double found, const char* unit) {
      throw Error(ExitCode::usage, fmt::format("{}.{}_{}: expected {}, found {:g}{}", table, key, i, expected, found, unit));
    };
    const double sweep = b.sweep / degree, length = b.outer_radius - b.inner_radius, innermost = 2 * s.half_width + largest_drop;
    if (!(sweep != 0 && std::abs(sweep) <= largest_sweep * (1 + 1e-9))) {
      refuse("sweep", fmt::format("a turn of at most {:g} deg to either side, not 0", largest_sweep), sweep, " deg");
    }
    if (!(length > 0))
      refuse("outer_radius", fmt::format("more than {}.inner_radius_{} = {:g} m", table, i, b.inner_radius), b.outer_radius, " m");
    if (!(length <= diagonal))
      refuse("outer_radius", fmt::format("a blade of at most {:.4g} m, the diagonal of the glass", diagonal), length, " m");
    if (!(b.inner_radius >= innermost)) {
      refuse("inner_radius", fmt::format("at least {:g} m, two half widths and the largest drop", innermost), b.inner_radius, " m");
    }
  }
}

double wiper_angle(const Blade& b, double cycles_per_minute, double t) { return angle_at(b, cycles_per_minute / 60 * t + b.phase); }

std::vector<Wiper> wipers_between(const WiperSettings& s, const PlaneFrame& plane, double from, double to, bool corrected) {
  std::vector<Wiper> records;
  const double steady = s.cycles_per_minute / 60;
  const auto cycles_at = [&](double t) { return s.keyed ? s.keyed->cycles(t) : steady * t; };
  std::vector<double> times{from};
  if (corrected && s.keyed) times = s.keyed->changes(from, to), times.insert(times.begin(), from);
  times.push_back(to);
  const bool rests = cycles_at(to) == cycles_at(from);
  for (const Blade& b : s.blades) {
    for (std::size_t part = 1; part < times.size(); ++part) {
      const double begin = times[part - 1], end = times[part];
      const double first = cycles_at(begin) + b.phase, last = cycles_at(end) + b.phase;
      // In a step in which they move part of the time, only the moving parts; in a step at rest, one record.
      if (rests ? part > 1 : s.keyed && corrected && last == first) continue;
      const double rate = s.keyed ? (last - first) / (end - begin) : steady;
      std::vector<double> cycles{first};
      if (corrected) {
        // A blade reverses at every whole and half cycle.
        for (double k = std::floor(2 * first) + 1; k < 2 * last; ++k) cycles.push_back(0.5 * k);
      }
      cycles.push_back(last);
      for (std::size_t i = 1; i < cycles.size(); ++i) {
        const double duration = corrected && rate > 0 ? (cycles[i] - cycles[i - 1]) / rate : end - begin;
        records.push_back(record_of(b, s.half_width, plane, angle_at(b, cycles[i - 1]), angle_at(b, cycles[i]), duration));
      }
    }
  }
  return records;
}

std::vector<Wiper> wipers_at(const WiperSettings& s, const PlaneFrame& plane, double t) {
  std::vector<Wiper> records;
  for (const Blade& b : s.blades) {
    const double angle = s.keyed ? angle_at(b, s.keyed->cycles(t) + b.phase) : wiper_angle(b, s.cycles_per_minute, t);
    records.push_back(record_of(b, s.half_width, plane, angle, angle, 1));
  }
  return records;
}

namespace {

constexpr double longest_period = 3600;  // s

struct Key {
  double time;
  std::string_view mode;
  double period;
};
std::vector<Key> parse(std::string_view text, std::string_view table) {
  std::vector<Key> keys;
  int row = 0;
  const auto fail = [&](const std::string& what) {
    throw Error(ExitCode::usage, fmt::format("{}.key_frames, key frame {}: {}", table, row, what));
  };
  for (const std::string_view frame : scene::split(text, ';')) {
    if (frame.empty()) continue;
    ++row;
    const std::vector<std::string_view> words = scene::words_of(frame);
    const bool pauses = words.size() == 3 && words[1] == "intermittent";
    const bool runs = words.size() == 2 && (words[1] == "off" || words[1] == "slow" || words[1] == "fast");
    if (!pauses && !runs)
      fail(fmt::format("expected \"time off\", \"time intermittent PERIOD\", \"time slow\" or \"time fast\", found '{}'", frame));
    const std::optional<double> time = number_from<double>(words[0]), period = pauses ? number_from<double>(words[2]) : 0;
    if (!time || *time < 0) fail(fmt::format("time: expected a number not below 0, found '{}'", words[0]));
    if (!keys.empty() && !(*time > keys.back().time))
      fail(fmt::format("time: expected more than {:g} of the row before, found {:g}", keys.back().time, *time));
    if (pauses && !(period && *period > 0 && *period <= longest_period))
      fail(fmt::format("period: expected more than 0 and at most {:g} s, found '{}'", longest_period, words[2]));
    keys.push_back({*time, words[1], *period});
  }
  if (keys.empty()) fail("expected at least one row, found none");
  return keys;
}

}  // namespace

WiperMotion::WiperMotion(std::string_view key_frames, double slow, double fast, std::string_view table) {
  const std::vector<Key> keys = parse(key_frames, table);
  parts_.push_back({0, 0, 0, 0});
  const auto from = [&](double time, double cycles, double rate, double period) {
    if (parts_.back().from == time) parts_.pop_back();
    parts_.push_back({time, cycles, rate, period});
  };
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Key& key = keys[i];
    const double begin = i == 0 ? 0 : key.time, end = i + 1 < keys.size() ? keys[i + 1].time : HUGE_VAL;
    const double at = cycles(begin), rate = (key.mode == "fast" ? fast : slow) / 60;
    if (key.mode == "slow" || key.mode == "fast" || (key.period > 0 && key.period * rate <= 1)) {
      from(begin, at, rate, 0);
      continue;
    }
    // The current stroke continues at its speed.
    const Part& before = parts_[part_at(begin)];
    const double whole = std::ceil(at);
    double rests = begin;
    if (whole > at && before.rate > 0) {
      const double its_rate = before.rate;
      from(begin, at, its_rate, 0);
      rests = begin + (whole - at) / its_rate;
    }
    if (rests >= end) continue;
    from(rests, whole, 0, 0);
    if (key.period == 0 || rate == 0) continue;
    const double first = begin + std::ceil((rests - begin) / key.period) * key.period;
    if (first < end) from(first, whole, rate, key.period);
  }
}

std::size_t WiperMotion::part_at(double t) const {
  const auto after = std::upper_bound(parts_.begin() + 1, parts_.end(), t, [](double x, const Part& p) { return x < p.from; });
  return static_cast<std::size_t>(after - parts_.begin()) - 1;
}

double WiperMotion::cycles(double t) const {
  const Part& p = parts_[part_at(t)];
  const double since = t - p.from;
  if (p.period == 0) {
    // A stroke that is to end does so at a whole number, whatever the rounding of its time.
    const double now = p.cycles + p.rate * since;
    const std::size_t next = part_at(t) + 1;
    return next < parts_.size() ? std::min(now, parts_[next].cycles) : now;
  }
  const double strokes = std::floor(since / p.period);
  return p.cycles + strokes + std::clamp(p.rate * (since - strokes * p.period), 0.0, 1.0);
}

std::vector<double> WiperMotion::changes(double from, double to) const {
  std::vector<double> times;
  const auto add = [&](double t) {
    if (from < t && t < to) times.push_back(t);
  };
  for (std::size_t i = part_at(from); i < parts_.size() && parts_[i].from < to; ++i) {
    const Part& p = parts_[i];
    add(p.from);
    if (p.period == 0) continue;
    const double end = i + 1 < parts_.size() ? std::min(to, parts_[i + 1].from) : to;
    for (double k = std::max(std::floor((from - p.from) / p.period), 0.0); p.from + k * p.period < end; ++k) {
      if (k > 0) add(p.from + k * p.period);
      if (const double stops = p.from + k * p.period + 1 / p.rate; stops < end) add(stops);
    }
  }
  return times;
}

}  // namespace rainref::windshield
