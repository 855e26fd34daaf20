#include "image_io/channels.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rainref/error.h"

namespace rainref::image_io {

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

}  // namespace rainref::image_io
