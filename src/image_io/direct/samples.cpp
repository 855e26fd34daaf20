#include "image_io/direct/samples.h"

#include <cmath>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

namespace rainref::image_io::direct {

std::vector<StoredChannel> plain_channels(int count, const std::string& type, std::size_t bytes) {
  constexpr std::string_view letters = "RGBA";
  std::vector<StoredChannel> out;
  for (int c = 0; c < count; ++c) {
    const auto index = static_cast<std::size_t>(c);
    out.push_back({count == 1 ? "Y" : index < letters.size() ? std::string(1, letters[index]) : fmt::format("channel{}", c), type, bytes});
  }
  return out;
}

std::string gamma_name(double gamma) {
  const double hundredths = std::floor(100 * static_cast<double>(static_cast<float>(gamma)) + .5);
  return hundredths == 100 ? "linear" : fmt::format("Gamma{:.2g}", static_cast<double>(static_cast<float>(hundredths) / 100.0f));
}

void copy_channels(const StoredPicture& picture, std::size_t first, std::size_t end, const std::byte* row, std::byte* out) {
  const std::size_t step = picture.texel_bytes(), bytes = picture.texel_bytes(first, end);
  row += picture.texel_bytes(0, first);
  for (int x = 0; x < picture.width; ++x, row += step, out += bytes) std::memcpy(out, row, bytes);
}

}  // namespace rainref::image_io::direct
