#include "sweep/sheet.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "base/path_text.h"
#include "image_io/read.h"

namespace rainref::sweep {
namespace {

constexpr int gap = 2;

std::filesystem::path last_picture(const Cell& cell, const Row& row, const Store& store) {
  std::string last;
  for (const KeptFile& f : row.files)
    if (f.path.starts_with("picture.") && f.path.ends_with(".png")) last = std::max(last, f.path);
  return last.empty() ? std::filesystem::path() : store.cell(cell.id) / utf8_path(last);
}

Image shrunk(const Image& picture, int largest) {
  const int by = std::max(1, (picture.width() + largest - 1) / largest);
  const int width = std::max(1, picture.width() / by), height = std::max(1, picture.height() / by);
  Image small(Format::rgba8, width, height);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < 4 * width; ++i) {
      int sum = 0, count = 0;
      for (int dy = 0; dy < by && by * y + dy < picture.height(); ++dy) {
        const std::byte* const row = picture.row_bytes(by * y + dy);
        for (int dx = 0; dx < by && by * (i / 4) + dx < picture.width(); ++dx, ++count)
          sum += std::to_integer<int>(row[4 * (by * (i / 4) + dx) + i % 4]);
      }
      small.row_bytes(y)[i] = static_cast<std::byte>((2 * sum + count) / (2 * count));
    }
  }
  return small;
}

}  // namespace

Image contact_sheet(const Cells& cells, const Table& table, const Store& store, int most, int largest) {
  std::vector<Image> pictures;
  for (std::size_t i = 0; i < table.rows.size() && static_cast<int>(pictures.size()) < most; ++i) {
    const std::filesystem::path file = last_picture(cells.all()[i], table.rows[i], store);
    if (file.empty()) continue;
    const image_io::Picture picture = image_io::read(file);
    if (picture.image.format() == Format::rgba8) pictures.push_back(shrunk(picture.image, largest));
  }
  if (pictures.empty()) return {};
  int width = 0, height = 0, columns = 1;
  for (const Image& p : pictures) {
    width = std::max(width, p.width());
    height = std::max(height, p.height());
  }
  const int count = static_cast<int>(pictures.size());
  while (columns * (width + gap) < (count + columns - 1) / columns * (height + gap)) ++columns;
  columns = std::min(columns, count);
  const int rows = (count + columns - 1) / columns;
  Image sheet(Format::rgba8, columns * (width + gap) - gap, rows * (height + gap) - gap);
  for (int y = 0; y < sheet.height(); ++y)
    for (int x = 0; x < sheet.width(); ++x) sheet.row_bytes(y)[4 * x + 3] = std::byte{255};
  for (int k = 0; k < count; ++k) {
    const Image& p = pictures[static_cast<std::size_t>(k)];
    const int x0 = k % columns * (width + gap), y0 = k / columns * (height + gap);
    for (int y = 0; y < p.height(); ++y) std::copy_n(p.row_bytes(y), 4 * p.width(), sheet.row_bytes(y0 + y) + 4 * x0);
  }
  return sheet;
}

}  // namespace rainref::sweep
