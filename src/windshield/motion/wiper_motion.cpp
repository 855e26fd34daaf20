#include "windshield/motion/wipers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/number_text.h"
#include "rainref/error.h"
#include "scene/rows_of_text.h"

namespace rainref::windshield {
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
    // The stroke that they are in goes on at its rate.
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
