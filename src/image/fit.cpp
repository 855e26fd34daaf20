#include "image/fit.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace rainref {
namespace {

/// The texels from which a new one is made. The weights are whole numbers, and their sum is the same for all.
struct Taps {
  int first;
  std::vector<double> weights;
};
struct Axis {
  double sum;
  std::vector<Taps> taps;
};
Taps mean_taps(std::int64_t begin, std::int64_t end, std::int64_t texel) {
  Taps t{static_cast<int>(begin / texel), {}};
  for (std::int64_t i = t.first; i * texel < end; ++i)
    t.weights.push_back(static_cast<double>(std::min(end, (i + 1) * texel) - std::max(begin, i * texel)));
  return t;
}
/// `place`: distance from the first centre to that of the new texel, where neighbouring centres are `step` apart.
Taps linear_taps(std::int64_t place, std::int64_t step, int texels) {
  const std::int64_t last = texels - 1;
  if (place <= 0) return {0, {static_cast<double>(step)}};
  if (place >= last * step) return {texels - 1, {static_cast<double>(step)}};
  const std::int64_t rest = place % step;
  return {static_cast<int>(place / step), {static_cast<double>(step - rest), static_cast<double>(rest)}};
}
Axis axis_of(int texels, int wanted) {
  Axis axis{texels >= wanted ? static_cast<double>(texels) : 2.0 * wanted, {}};
  for (std::int64_t o = 0; o < wanted; ++o) {
    axis.taps.push_back(texels >= wanted ? mean_taps(o * texels, (o + 1) * texels, wanted)
                                         : linear_taps((2 * o + 1) * texels - wanted, std::int64_t{2} * wanted, texels));
  }
  return axis;
}

/// Rows of the part in the new width. The last two are kept, because neighbouring new rows share them.
class NarrowRows {
 public:
  NarrowRows(const ReadRow& row, Size of, const Part& part, int width)
      : row_(row), part_(part), columns_(axis_of(part.width, width)), texels_(4 * static_cast<std::size_t>(of[0])) {
    for (Kept& k : kept_) k.texels.resize(4 * static_cast<std::size_t>(width));
  }
  const std::vector<double>& at(int y) {
    for (const Kept& k : kept_)
      if (k.y == y) return k.texels;
    std::swap(kept_[0], kept_[1]);
    kept_[1].y = y;
    read(y, kept_[1].texels);
    return kept_[1].texels;
  }

 private:
  struct Kept {
    int y = -1;
    std::vector<double> texels;
  };
  void read(int y, std::vector<double>& out) {
    row_(part_.y + y, texels_.data());
    double* to = out.data();
    for (const Taps& t : columns_.taps) {
      const float* from = texels_.data() + 4 * static_cast<std::size_t>(part_.x + t.first);
      double sums[4] = {0, 0, 0, 0};
      for (const double weight : t.weights)
        for (double& sum : sums) sum += weight * *from++;
      for (const double sum : sums) *to++ = sum / columns_.sum;
    }
  }

  const ReadRow& row_;
  Part part_;
  Axis columns_;
  std::vector<float> texels_;
  Kept kept_[2];
};

}  // namespace

Part centred_part(Size picture, Size aspect) {
  const auto [width, height] = picture;
  const std::int64_t columns = aspect[0], rows = aspect[1];
  // Rounded up: less than a texel too much.
  const auto kept_width = static_cast<int>(std::min<std::int64_t>(width, (height * columns + rows - 1) / rows)),
             kept_height = static_cast<int>(std::min<std::int64_t>(height, (width * rows + columns - 1) / columns));
  return {(width - kept_width) / 2, (height - kept_height) / 2, kept_width, kept_height};
}

Image fitted(const ReadRow& row, Size of, const Part& part, Size size) {
  Image out(Format::rgba32f, size[0], size[1]);
  NarrowRows narrow(row, of, part, size[0]);
  const Axis rows = axis_of(part.height, size[1]);
  std::vector<double> sums(4 * static_cast<std::size_t>(size[0]));
  for (int y = 0; y < size[1]; ++y) {
    const Taps& taps = rows.taps[static_cast<std::size_t>(y)];
    std::fill(sums.begin(), sums.end(), 0.0);
    for (std::size_t k = 0; k < taps.weights.size(); ++k) {
      const std::vector<double>& from = narrow.at(taps.first + static_cast<int>(k));
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += taps.weights[k] * from[i];
    }
    std::transform(sums.begin(), sums.end(), out.row<float>(y), [&](double sum) { return static_cast<float>(sum / rows.sum); });
  }
  return out;
}

Image fitted_nearest(const Image& copy, Size of, const Part& part, Size size) {
  // The centre of new texel o lies (2 (first size + o part) + part) / (2 size) texels of the picture from its edge.
  const auto texels_of = [](int first, int length, int wanted, int picture, int texels) {
    std::vector<int> all;
    for (std::int64_t o = 0; o < wanted; ++o) {
      const std::int64_t twice = 2 * (std::int64_t{first} * wanted + o * length) + length;
      all.push_back(static_cast<int>(twice * texels / (std::int64_t{2} * wanted * picture)));
    }
    return all;
  };
  const std::vector<int> columns = texels_of(part.x, part.width, size[0], of[0], copy.width()),
                         rows = texels_of(part.y, part.height, size[1], of[1], copy.height());
  Image out(copy.format(), size[0], size[1]);
  const std::size_t bytes = static_cast<std::size_t>(info(copy.format()).texel_bytes());
  for (int y = 0; y < size[1]; ++y) {
    const std::byte* from = copy.row_bytes(rows[static_cast<std::size_t>(y)]);
    std::byte* to = out.row_bytes(y);
    for (const int column : columns) {
      std::memcpy(to, from + bytes * static_cast<std::size_t>(column), bytes);
      to += bytes;
    }
  }
  return out;
}

}  // namespace rainref
