#include "judge/half_votes.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rainref::judge {
namespace {

const char* words(HalfMode mode) { return mode == HalfMode::rne ? "to nearest" : "toward zero"; }

/// The place of a rounding among the two that were tried.
std::size_t place(const HalfVotes& pass, HalfMode mode) { return pass.modes[0] == mode ? 0 : 1; }

bool has_vote(const HalfVotes& pass) { return pass.modes.size() >= 2 && !pass.rounds_inside; }

/// Passes that can be stored by this rounding alone.
std::vector<std::string> only_under(HalfMode mode, const std::vector<HalfVotes>& passes) {
  std::vector<std::string> out;
  for (const HalfVotes& p : passes) {
    if (!has_vote(p)) continue;
    const std::size_t k = place(p, mode);
    if (p.failing[k] == 0 && p.failing[1 - k] > 0) out.push_back(p.pass);
  }
  return out;
}

}  // namespace

HalfMode port_rounding(const std::vector<HalfVotes>& passes) {
  const auto voter = std::find_if(passes.begin(), passes.end(), has_vote);
  if (voter == passes.end()) return HalfMode::either;
  const auto against = [&](std::size_t k) {
    std::int64_t failing_passes = 0, failing = 0;
    for (const HalfVotes& p : passes) {
      if (!has_vote(p)) continue;
      failing_passes += p.failing[k] > 0;
      failing += p.failing[k];
    }
    return std::pair(failing_passes, failing);
  };
  const auto [passes_0, failing_0] = against(0);
  const auto [passes_1, failing_1] = against(1);
  const bool is_second = passes_1 != passes_0 ? passes_1 < passes_0 : 10 * failing_1 <= 9 * failing_0 && failing_1 < failing_0;
  return voter->modes[is_second ? 1 : 0];
}

bool is_rounding_open(const std::vector<HalfVotes>& passes) {
  const bool fails = std::any_of(passes.begin(), passes.end(),
                                 [](const HalfVotes& p) { return p.modes.size() >= 2 && p.failing[0] > 0 && p.failing[1] > 0; });
  return fails && only_under(HalfMode::rne, passes).empty() && only_under(HalfMode::rtz, passes).empty();
}

FoundRounding pass_rounding(const HalfVotes& pass, const std::vector<HalfVotes>& passes, HalfMode asked, const std::string& profile) {
  if (pass.modes.size() < 2) return {};
  // A pass without a vote may be all that there is.
  const HalfMode votes = port_rounding(passes), port = votes == HalfMode::either ? pass.modes[0] : votes;
  const std::size_t own = place(pass, port), other = 1 - own;
  // What fails either way says nothing of stores.
  const bool fits_better = pass.failing[other] < pass.failing[own] && (pass.failing[other] == 0 || pass.rounds_inside);
  const std::size_t found = fits_better ? other : own;
  // Stores of one device round one way. Only when both ways fail and a mixture does not is it a mixture.
  if (pass.modes.size() == 3 && pass.failing[found] > 0 && pass.failing[2] == 0)
    return {2, "some stores to binary16 round to nearest and some toward zero"};
  const HalfMode mode = pass.modes[found];
  std::vector<std::string> doubts;
  if (asked != HalfMode::either && mode != asked && pass.failing[place(pass, asked)] > 0)
    doubts.push_back(fmt::format("stores to binary16 round {}, where the profile {} asks for {}", words(mode), profile, words(asked)));
  if (const std::vector<std::string> others = only_under(port, passes);
      has_vote(pass) && mode != port && pass.failing[found] == 0 && !others.empty())
    doubts.push_back(fmt::format("stores to binary16 round {} in this pass and {} in {}: a port has one rounding", words(mode), words(port),
                                 fmt::join(others, ", ")));
  return {found, fmt::format("{}", fmt::join(doubts, "; "))};
}

}  // namespace rainref::judge
