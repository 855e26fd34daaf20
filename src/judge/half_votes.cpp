#include "judge/half_votes.h"

#include <algorithm>
#include <array>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rainref::judge {
namespace {

const char* words(HalfMode mode) { return mode == HalfMode::rne ? "to nearest" : "toward zero"; }

/// Index of a rounding in the two that were tried.
std::size_t place(const HalfVotes& pass, HalfMode mode) { return pass.modes[0] == mode ? 0 : 1; }

bool has_vote(const HalfVotes& pass) { return pass.modes.size() >= 2 && !pass.rounds_inside; }

/// Index of the rounding with clearly more of the reference's bits: by far more than a wrong formula has by chance. Nothing: neither.
std::optional<std::size_t> place_by_bits(const std::vector<HalfVotes>& passes) {
  constexpr std::int64_t least = 16, share = 8;
  std::array<std::int64_t, 2> bits{};
  for (const HalfVotes& p : passes)
    for (std::size_t k = 0; has_vote(p) && !p.with_bits.empty() && k < 2; ++k) bits[k] += p.with_bits[k];
  const auto [few, many] = std::minmax(bits[0], bits[1]);
  if (many - few < least || (many - few) * share < many) return std::nullopt;
  return bits[1] > bits[0] ? 1 : 0;
}

/// Passes that fit only this rounding.
std::vector<std::string> only_under(HalfMode mode, const std::vector<HalfVotes>& passes) {
  std::vector<std::string> out;
  for (const HalfVotes& p : passes) {
    if (!has_vote(p)) continue;
    const std::size_t k = place(p, mode);
    if (p.failing[k] == 0 && p.failing[1 - k] > 0) out.push_back(p.pass);
  }
  return out;
}

/// True if it is known under which of the two roundings a pass fails.
bool is_settled(const HalfVotes& pass) { return pass.is_known(0) && pass.is_known(1); }

/// The port's rounding if all undecided invocations fail under one of the two, and none under the other.
HalfMode extreme_rounding(std::vector<HalfVotes> passes, std::size_t most) {
  for (HalfVotes& p : passes)
    if (has_vote(p)) p.failing[most] = p.most(most);
  return port_rounding(passes);
}

/// True if the undecided invocations of a pass could change its pass_rounding.
bool is_pass_open(const HalfVotes& pass, HalfMode port, HalfMode asked) {
  const std::size_t own = port == HalfMode::either ? 0 : place(pass, port), other = 1 - own;
  if (pass.most(own) == 0) return asked != HalfMode::either && pass.modes[own] != asked && !pass.is_known(place(pass, asked));
  if (!pass.is_known(own) || !pass.is_known(other) || pass.rounds_inside) return true;
  const std::size_t found = pass.failing[other] == 0 ? other : own;
  return pass.most(found) != pass.failing[found] || (pass.modes.size() == 3 && !pass.is_known(2));
}

}  // namespace

bool HalfVotes::is_whole() const {
  return std::all_of(undecided.begin(), undecided.end(), [](std::int64_t count) { return count == 0; });
}

HalfMode port_rounding(const std::vector<HalfVotes>& passes) {
  const auto voter = std::find_if(passes.begin(), passes.end(), has_vote);
  if (voter == passes.end()) return HalfMode::either;
  const auto against = [&](std::size_t k) {
    std::int64_t failing_passes = 0, failing = 0, with_bits = 0;
    for (const HalfVotes& p : passes) {
      if (!has_vote(p)) continue;
      failing_passes += p.failing[k] > 0;
      failing += p.failing[k];
      with_bits += p.with_bits.empty() ? 0 : p.with_bits[k];
    }
    return std::tuple(failing_passes, failing, with_bits);
  };
  const auto [passes_0, failing_0, bits_0] = against(0);
  const auto [passes_1, failing_1, bits_1] = against(1);
  if (failing_0 + failing_1 == 0) return voter->modes[bits_1 > bits_0 ? 1 : 0];
  const std::optional<std::size_t> by_bits = place_by_bits(passes);
  if (passes_1 == passes_0 && by_bits) return voter->modes[*by_bits];
  const bool is_second = passes_1 != passes_0 ? passes_1 < passes_0 : 10 * failing_1 <= 9 * failing_0 && failing_1 < failing_0;
  return voter->modes[is_second ? 1 : 0];
}

bool fails_by_each(const HalfVotes& pass) { return pass.modes.size() >= 2 && pass.failing[0] > 0 && pass.failing[1] > 0; }
bool is_rounding_open(const std::vector<HalfVotes>& passes) {
  return std::any_of(passes.begin(), passes.end(), fails_by_each) && !place_by_bits(passes) && only_under(HalfMode::rne, passes).empty() &&
         only_under(HalfMode::rtz, passes).empty();
}

FoundRounding pass_rounding(const HalfVotes& pass, const std::vector<HalfVotes>& passes, HalfMode asked, const std::string& profile) {
  if (pass.modes.size() < 2) return {};
  // There may be only passes without a vote.
  const HalfMode votes = port_rounding(passes), port = votes == HalfMode::either ? pass.modes[0] : votes;
  const std::size_t own = place(pass, port), other = 1 - own;
  // A pass that fails under both roundings tells nothing about stores.
  const bool fits_better = pass.failing[other] < pass.failing[own] && (pass.failing[other] == 0 || pass.rounds_inside);
  const std::size_t found = fits_better ? other : own;
  // All stores of a device round one way. A mixture is assumed only if both ways fail and the mixture does not.
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

std::optional<std::size_t> first_undecided(const std::vector<HalfVotes>& passes, HalfMode asked) {
  const auto first = [&](const auto& counts) -> std::optional<std::size_t> {
    for (std::size_t k = 0; k < passes.size(); ++k)
      if (passes[k].modes.size() >= 2 && !passes[k].is_whole() && counts(passes[k])) return k;
    return std::nullopt;
  };
  const auto unsettled = [&] { return first([](const HalfVotes& p) { return !is_settled(p); }); };
  // More failures under a rounding never favour it, so the extreme cases suffice.
  const HalfMode port = extreme_rounding(passes, 0);
  if (port != extreme_rounding(passes, 1)) return first(has_vote);
  const bool may_fail =
      std::any_of(passes.begin(), passes.end(), [](const HalfVotes& p) { return p.modes.size() >= 2 && p.most(0) > 0 && p.most(1) > 0; });
  const bool tells = place_by_bits(passes) || std::any_of(passes.begin(), passes.end(), [](const HalfVotes& p) {
                       return has_vote(p) && ((p.most(0) == 0 && p.failing[1] > 0) || (p.most(1) == 0 && p.failing[0] > 0));
                     });
  if (may_fail && !tells && unsettled()) return unsettled();
  if (const auto open = first([&](const HalfVotes& p) { return is_pass_open(p, port, asked); })) return open;
  // A pass that fits only the other rounding is doubtful if other passes fit only the port's.
  const bool names_others = std::any_of(passes.begin(), passes.end(), [&](const HalfVotes& p) {
    return has_vote(p) && p.failing[place(p, port)] > 0 && p.most(1 - place(p, port)) == 0;
  });
  return names_others ? first([](const HalfVotes& p) { return has_vote(p) && !is_settled(p); }) : std::nullopt;
}

}  // namespace rainref::judge
