#include "image_io/direct/exr_channels.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "image_io/channels.h"

namespace rainref::image_io::direct {
namespace {

// Names in lower case. Y is luminance, or the second part of a vector.
constexpr std::string_view colour_order[] = {"r",     "red", "g",  "green", "b",  "blue", "y",  "real", "imag",  "a",
                                             "alpha", "ar",  "ra", "ag",    "ga", "ab",   "ba", "z",    "depth", "zback"};
constexpr std::string_view vector_order[] = {"r", "red",   "g",  "green", "b",  "blue", "x",  "y",  "z",     "real", "imag",
                                             "a", "alpha", "ar", "ra",    "ag", "ga",   "ab", "ba", "depth", "zback"};

/// A channel and what it is sorted by.
struct Named {
  StoredChannel channel;
  std::string layer, suffix, lower;
  std::size_t rank = 0;
};

Named named(const char* name, const Imf::Channel& channel) {
  Named out;
  out.channel.name = name;
  out.channel.type = channel.type == Imf::UINT ? "uint" : channel.type == Imf::HALF ? "half" : "float";
  out.channel.bytes = channel.type == Imf::HALF ? 2 : 4;
  out.layer = layer_of(out.channel.name);
  out.suffix = out.layer.empty() ? out.channel.name : out.channel.name.substr(out.layer.size() + 1);
  for (const char c : out.suffix) out.lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

void rank(std::span<Named> layer) {
  const auto has = [&](std::string_view name) { return std::ranges::find(layer, name, &Named::lower) != layer.end(); };
  const bool is_vector = has("x") && (has("y") || has("z"));
  const std::span<const std::string_view> order = is_vector ? std::span<const std::string_view>(vector_order) : colour_order;
  for (Named& one : layer) one.rank = static_cast<std::size_t>(std::ranges::find(order, one.lower) - order.begin());
}

}  // namespace

std::vector<StoredChannel> exr_channels(const Imf::ChannelList& channels) {
  std::vector<Named> all;
  std::string refusal;
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    const Imf::Channel& channel = c.channel();
    all.push_back(named(c.name(), channel));
    if (channel.xSampling != 1 || channel.ySampling != 1)
      refusal += fmt::format("{}Subsampled channels are not supported (channel \"{}\" has sampling {},{}).", refusal.empty() ? "" : "\n",
                             c.name(), channel.xSampling, channel.ySampling);
  }
  if (!refusal.empty()) throw std::runtime_error(refusal);
  if (all.empty()) throw std::runtime_error("No channels found");
  std::ranges::stable_sort(all, {}, &Named::layer);
  for (auto begin = all.begin(); begin != all.end();) {
    const auto end = std::find_if(begin, all.end(), [&](const Named& one) { return one.layer != begin->layer; });
    rank({begin, end});
    std::sort(begin, end, [](const Named& a, const Named& b) { return a.rank != b.rank ? a.rank < b.rank : a.suffix < b.suffix; });
    begin = end;
  }
  std::vector<StoredChannel> out;
  std::ranges::transform(all, std::back_inserter(out), &Named::channel);
  return out;
}

Imf::PixelType pixel_type(const StoredChannel& channel) {
  return channel.type == "uint" ? Imf::UINT : channel.type == "half" ? Imf::HALF : Imf::FLOAT;
}

}  // namespace rainref::image_io::direct
