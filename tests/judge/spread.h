// How wide envelopes are over what conforming devices spread.
#pragma once

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "judge/support.h"
#include "math/path_enumeration.h"

namespace rainref::judge::test {

struct Measure {
  std::vector<double> ratios, widths;  // of values with an open envelope; widths in ULP
  std::int64_t ambiguous = 0, gave_up = 0, exact = 0, constant = 0;
};

/// The values of one invocation: the envelope that holds the reference, judged at the reference's own stored values,
/// over the spread of the devices that it holds: others took another branch.
inline void measure(const BoundCase& b, int x, int y, const enclosed::Profile& declared, int devices, Measure& m) {
  // Where the pass rounds on its way, by devices that round as the reference does.
  enclosed::Profile p = declared;
  if (b.model->rounds_inside()) p.half_store = enclosed::StoreRounding::rne;
  const perturbed::Variations variations = perturbed::variations_of(p);
  const std::size_t n = b.slots.size();
  std::vector<scalar::Scalar<float>> reference(n);
  b.model->evaluate(x, y, reference.data());
  std::vector<float> port, low;
  for (std::size_t v = 0; v < n; ++v) {
    port.push_back(stored_value(b.slots[v], b.slots[v].at(b.c->outputs[static_cast<std::size_t>(b.slots[v].output)].array, x, y)));
    low.push_back(reference[v].v);
  }
  std::vector<float> high = low;
  std::vector<enclosed::Enclosure> e(n), one(n);
  const auto held = [&](const std::vector<enclosed::Enclosure>& in, const std::vector<float>& values) {
    for (std::size_t v = 0; v < n; ++v)
      if (!b.model->is_free(static_cast<int>(v)) && !in[v].contains(values[v])) return false;
    return true;
  };
  {
    const enclosed::ProfileScope scope(p);
    enclosed::PathEnumeration paths;
    bool found = false;
    const bool whole = paths.for_each_alternative([&] {
      b.model->enclose(x, y, port.data(), one.data());
      if (!found && held(one, low)) {
        e = one;
        found = true;
      }
    });
    m.ambiguous += paths.runs() != 1;
    if (!whole) {
      ++m.gave_up;
      return;
    }
    ASSERT_TRUE(found);
  }
  for (int k = 0; k < devices; ++k) {
    const std::vector<float> got =
        conforming_values(*b.model, x, y, variations, static_cast<std::uint64_t>(k) + 1000u * static_cast<std::uint64_t>(x + 1000 * y));
    if (!held(e, got)) continue;
    for (std::size_t v = 0; v < n; ++v) {
      low[v] = std::min(low[v], got[v]);
      high[v] = std::max(high[v], got[v]);
    }
  }
  for (std::size_t v = 0; v < n; ++v) {
    if (b.model->is_free(static_cast<int>(v))) continue;
    if (e[v].is_point()) {
      ++m.exact;
      continue;
    }
    m.widths.push_back(e[v].width_in_ulp());
    m.ratios.push_back(high[v] > low[v] ? (static_cast<double>(e[v].hi) - e[v].lo) / (static_cast<double>(high[v]) - low[v]) : 1e9);
    m.constant += high[v] == low[v];
    if (std::getenv("RAINREF_TRACE"))
      fmt::print("v {} at {} {} width {} ulp spread {} ratio {} ref {}\n", v, x, y, e[v].width_in_ulp(),
                 enclosed::Enclosure(low[v], high[v]).width_in_ulp(), m.ratios.back(), reference[v].v);
  }
}

/// The median of width over spread is at most 4 for every pass and profile.
inline void expect_tight(const std::vector<BoundPass>& passes) {
  const int devices = 128;
  const std::int64_t texels = 1200;
  const auto enough = static_cast<std::size_t>(count_from("RAINREF_SPREADS", 100));  // values with an open envelope
  const char* only = std::getenv("RAINREF_ONLY");
  fmt::print("{:<26} {:<8} {:>7} {:>7} {:>12} {:>10} {:>10} {:>9}\n", "pass", "profile", "ratio", "p90", "width (ULP)", "exact",
             "ambiguous", "constant");
  for (const BoundPass& pass : passes) {
    if (only && pass.name() != only) continue;
    // The cases of the last frame, which are levels of a pyramid or one.
    std::vector<const BoundCase*> cases;
    for (const BoundCase& b : pass.cases)
      if (b.c->frame == pass.cases.back().c->frame) cases.push_back(&b);
    for (const std::string& name : inexact_profiles()) {
      Measure m;
      for (std::int64_t k = 0; k < texels && m.ratios.size() < enough; ++k) {
        const BoundCase& b = *cases[static_cast<std::size_t>(k) % cases.size()];
        const std::int64_t texel = (k * 37 + 5) % (static_cast<std::int64_t>(b.model->width()) * b.model->height());
        measure(b, static_cast<int>(texel % b.model->width()), static_cast<int>(texel / b.model->width()), profile(name), devices, m);
      }
      const auto at = [](std::vector<double>& values, double share) {
        std::sort(values.begin(), values.end());
        return values.empty() ? 0.0 : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
      };
      fmt::print("{:<26} {:<8} {:7.2f} {:7.3g} {:12.0f} {:10} {:10} {:9}\n", pass.name(), name, at(m.ratios, 0.5), at(m.ratios, 0.9),
                 at(m.widths, 0.5), m.exact, m.ambiguous, m.constant);
      if (cases[0]->model->rounds_inside()) {
        // What is rounded on the way is one half but for a few, where the two neighbours are the whole envelope.
        EXPECT_GT(m.exact, static_cast<std::int64_t>(20 * m.ratios.size())) << pass.name() << ' ' << name;
        EXPECT_LE(at(m.widths, 0.9), 0x1p13) << pass.name() << ' ' << name;
        continue;
      }
      if (pass.is_one_number(profile(name))) continue;
      EXPECT_TRUE(pass.is_of_masks() || m.ratios.size() > 10) << pass.name() << ' ' << name;
      // Most of its elements have no bound there: sines of hundreds.
      if (pass.pass_and_variant == "screen_drops-as-published drops" && (name == "webgpu" || name == "metal")) continue;
      // What a sum of many taps spreads by grows as a root of their number, its envelope as the number. So do the six roundings of
      // the weights of a lookup between two levels. A hash has few roundings, magnified alike: to nearest, devices give few numbers.
      const std::string& what = pass.pass_and_variant;
      // So it is with the blends of falling_rain: devices differ there by 2 ULP at most, often not at all (RAINREF_TRACE=1 prints them),
      // while a blend's four roundings are bounded by several ULP, where they round to nearest.
      const bool is_nearest = profile(name).basic == enclosed::BasicRounding::nearest;
      const double most = what == "screen_drops-corrected background" ? 7
                          : what == "puddle-as-published raindrops"   ? 8
                          : pass.pass == "falling_rain" && is_nearest ? 10
                                                                      : 4;
      EXPECT_LE(at(m.ratios, 0.5), most) << pass.name() << ' ' << name;
    }
  }
}

}  // namespace rainref::judge::test
