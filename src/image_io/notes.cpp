#include "image_io/notes.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "image_io/exr_header.h"
#include "image_io/png_chunks.h"
#include "rainref/error.h"

namespace rainref::image_io {
namespace {

constexpr std::array<unsigned char, 8> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::array<unsigned char, 4> exr{0x76, 0x2f, 0x31, 0x01};

bool begins_with(std::span<const std::byte> bytes, std::span<const unsigned char> signature) {
  return bytes.size() >= signature.size() &&
         std::equal(signature.begin(), signature.end(), bytes.begin(), [](unsigned char s, std::byte b) { return std::byte{s} == b; });
}

}  // namespace

bool may_have_notes(std::span<const std::byte> bytes) { return begins_with(bytes, png) || begins_with(bytes, exr); }

std::optional<std::string> find_note(std::string_view file, std::span<const std::byte> bytes, std::string_view key) {
  if (begins_with(bytes, png)) return find_png_text(file, bytes, key);
  if (!begins_with(bytes, exr)) return std::nullopt;
  try {
    return find_exr_text(file, bytes, key);
  } catch (const Error& e) {
    throw Error(ExitCode::usage, e.what());  // here it is not a port's file
  }
}

}  // namespace rainref::image_io
