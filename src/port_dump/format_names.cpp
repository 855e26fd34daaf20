#include "port_dump/format_names.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

#include "rainref/image.h"

namespace rainref::port_dump {
namespace {

/// In lower case, only letters and digits, without the prefix before the format itself.
std::string plain(std::string_view name) {
  if (const std::size_t scope = name.find_last_of(".:"); scope != std::string_view::npos) name.remove_prefix(scope + 1);
  std::string out;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c))) out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  for (const std::string_view prefix : {"dxgiformat", "vkformat", "mtlpixelformat", "wgputextureformat", "imageformat", "format", "gl"}) {
    if (!out.starts_with(prefix)) continue;
    out.erase(0, prefix.size());
    break;
  }
  return out;
}

/// Channels, bits of each and their type: "rg", "16", "sfloat" for "r16g16sfloat"; "rg", "", "half" for "rghalf".
struct Parts {
  std::string channels, bits, holds;
  bool is_uniform = true;  ///< all channels have these bits
};
Parts parts_of(const std::string& text) {
  Parts out;
  std::size_t at = 0;
  const auto is_channel = [&](char c) { return c == 'r' || c == 'g' || c == 'b' || c == 'a'; };
  while (at < text.size() && is_channel(text[at])) {
    while (at < text.size() && is_channel(text[at])) out.channels += text[at++];
    std::string bits;
    while (at < text.size() && std::isdigit(static_cast<unsigned char>(text[at]))) bits += text[at++];
    if (bits.empty()) break;
    out.is_uniform &= out.bits.empty() || out.bits == bits;
    out.bits = bits;
  }
  out.holds = text.substr(at);
  return out;
}

struct Meaning {
  std::string_view holds, bits, own_bits;  ///< own_bits: the suffix after the channels in rainref's name
};
constexpr std::array<Meaning, 16> meanings{{{"unorm", "8", "8"},
                                            {"", "8", "8"},
                                            {"srgb", "8", "8_srgb"},
                                            {"unormsrgb", "8", "8_srgb"},
                                            {"float", "16", "16f"},
                                            {"sfloat", "16", "16f"},
                                            {"f", "16", "16f"},
                                            {"half", "", "16f"},
                                            {"h", "", "16f"},
                                            {"float", "32", "32f"},
                                            {"sfloat", "32", "32f"},
                                            {"f", "32", "32f"},
                                            {"float", "", "32f"},
                                            {"f", "", "32f"},
                                            {"uint", "32", "32ui"},
                                            {"ui", "32", "32ui"}}};

}  // namespace

std::string hint_of_other_name(std::string_view name) {
  const std::string text = plain(name);
  Parts parts = parts_of(text);
  if (text == "srgb8alpha8") parts = {"rgba", "8", "srgb"};
  const bool is_bgra = parts.channels == "bgra";
  if (is_bgra || parts.channels == "argb") parts.channels = "rgba";
  const auto meaning = std::ranges::find_if(meanings, [&](const Meaning& m) { return m.holds == parts.holds && m.bits == parts.bits; });
  if (!parts.is_uniform || meaning == meanings.end()) return "";
  const std::string own = fmt::format("{}{}", parts.channels, meaning->own_bits);
  for (int i = 0; i <= static_cast<int>(Format::r32ui); ++i) {
    if (info(static_cast<Format>(i)).name != own) continue;
    return fmt::format("; did you mean '{}'{}?", own, is_bgra ? " with channel_order 'bgra'" : "");
  }
  return "";
}

}  // namespace rainref::port_dump
