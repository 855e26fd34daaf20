#include "image_io/channels.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rainref/error.h"

namespace rainref::image_io {

namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}
std::string last_part(std::string_view name) { return lower(name.substr(name.rfind('.') + 1)); }  // npos + 1 is 0

class DepthNames {
 public:
  explicit DepthNames(std::span<const std::string> names) : names_(names) {}

  /// The priority of a channel, smaller is better; none if it has no claim.
  std::optional<int> claim_of(std::size_t i) const {
    const std::string_view layer = layer_of(names_[i]);
    const bool is_depths = last_part(layer) == "depth";
    const char letter = letter_of(names_[i]);
    if (letter == 'Z' && !(has(layer, 'X') && has(layer, 'Y'))) return layer.empty() ? 0 : is_depths ? 1 : 2;
    if (last_part(names_[i]) == "depth") return 3;
    if (letter == 'V' && layer.empty() && !has(layer, 'U')) return 4;
    if (is_depths && letter != 'A' && count(layer) == 1) return 5;
    return std::nullopt;
  }

 private:
  bool has(std::string_view layer, char letter) const {
    return std::ranges::any_of(names_, [&](const std::string& n) { return layer_of(n) == layer && letter_of(n) == letter; });
  }
  std::ptrdiff_t count(std::string_view layer) const {
    return std::ranges::count_if(names_, [&](const std::string& n) { return layer_of(n) == layer && letter_of(n) != 'A'; });
  }
  std::span<const std::string> names_;
};

std::optional<int> depth_channel(std::string_view file, std::span<const std::string> names) {
  const DepthNames depths(names);
  std::optional<int> best, claim;
  std::vector<std::string> equals;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::optional<int> found = depths.claim_of(i);
    if (!found || (claim && *found > *claim)) continue;
    if (!claim || *found < *claim) equals.clear();
    claim = found;
    best = static_cast<int>(i);
    equals.push_back(names[i]);
  }
  if (equals.size() > 1)
    throw Error(ExitCode::usage, fmt::format("{}: expected one depth, found {}; save one of them alone", file, fmt::join(equals, " and ")));
  return best;
}

}  // namespace

std::string_view layer_of(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : name.substr(0, dot);
}

char letter_of(std::string_view name) {
  const std::string_view base = name.substr(name.rfind('.') + 1);  // npos + 1 is 0
  if (base.size() != 1) return '\0';
  return base[0] >= 'a' && base[0] <= 'z' ? static_cast<char>(base[0] - 'a' + 'A') : base[0];
}

ChannelPick pick_channels(std::string_view file, std::span<const std::string> names, std::string_view layer) {
  if (layer.empty() && std::ranges::none_of(names, [](const std::string& n) { return layer_of(n).empty(); })) {
    layer = layer_of(names.front());
  }
  std::vector<int> members;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (layer_of(names[i]) == layer) members.push_back(static_cast<int>(i));
  }
  if (members.empty()) {
    std::vector<std::string> layers;
    for (const std::string& name : names) layers.emplace_back(layer_of(name));
    throw Error(ExitCode::usage, fmt::format("{}: no layer '{}'{}", file, layer, did_you_mean(layer, layers)));
  }
  const auto find = [&](char letter) {
    for (const int i : members) {
      if (letter_of(names[i]) == letter) return i;
    }
    return ChannelPick::zero;
  };
  const int alpha = find('A');
  const int opaque = alpha >= 0 ? alpha : ChannelPick::one;
  if (find('R') >= 0 || find('G') >= 0 || find('B') >= 0) return {{find('R'), find('G'), find('B'), opaque}};
  if (find('X') >= 0) return {{find('X'), find('Y'), find('Z'), opaque}};
  if (find('U') >= 0 && find('V') >= 0) return {{find('U'), find('V'), ChannelPick::zero, opaque}};
  if (members.size() == 1) return {{members[0], members[0], members[0], ChannelPick::one}};
  if (members.size() == 2 && alpha >= 0) {
    const int grey = members[0] == alpha ? members[1] : members[0];
    return {{grey, grey, grey, alpha}};
  }
  throw Error(ExitCode::usage, fmt::format("{}: channels {} are not understood; expected R G B, X Y Z or U V, or a single grey channel, "
                                           "each with or without A",
                                           file, fmt::join(names, " ")));
}

ChannelPick pick_quantity(std::string_view file, std::span<const std::string> names, bool is_depth) {
  if (is_depth) {
    if (const std::optional<int> z = depth_channel(file, names)) return {{*z, *z, *z, ChannelPick::one}};
  }
  ChannelPick pick = pick_channels(file, names, {});
  if (pick.source[0] < 0) pick.source[0] = *std::ranges::find_if(pick.source, [](int c) { return c >= 0; });
  return pick;
}

}  // namespace rainref::image_io
