// Images that take long to make and are the same in every run, kept in a folder of the user's. Never needed: what is not there, is
// damaged, another user's or of another shape than its maker expects, or cannot be written is made anew, silently.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "base/rows.h"
#include "rainref/image.h"

namespace rainref::cache {

/// What images are made of, in bytes: all numbers that they depend on.
class Recipe {
 public:
  /// what: names the maker, and no other one.
  explicit Recipe(std::string_view what) : text_(what) { text_.push_back('\0'); }
  Recipe& add(std::initializer_list<double> numbers);
  Recipe& add(std::uint64_t number);
  /// An image, by the hash of its texels.
  Recipe& add(const Image& image);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// What an image is, as its maker knows it before it is made.
struct Shape {
  Format format;
  int width, height;  ///< 0: any
};

/// From here on images are kept in this folder, which is made when the first is; an empty path: nowhere, as at the start. At most
/// `most_bytes` of them, those used last. From the thread that starts the others.
void keep_in(std::filesystem::path folder, std::uintmax_t most_bytes = std::uintmax_t{2} << 30);
/// $XDG_CACHE_HOME/rainref, or ~/.cache/rainref; empty where neither variable says an absolute path.
std::filesystem::path folder_of_user();

/// The images of make(), which have these shapes. Read instead where they were kept by this very program (its file's bytes count) for this
/// recipe, in a file that belongs to this user and that nobody else may write, their hash says that they are whole, and they have the
/// shapes; or a copy of what this process remembers (cache/remembered.h). rows: who makes the memory that they are read into ready.
std::vector<Image> images(const Recipe& recipe, const std::vector<Shape>& shapes, const std::function<std::vector<Image>()>& make,
                          const Rows& rows = rows_here);
/// The same of one image.
Image image(const Recipe& recipe, const Shape& shape, const std::function<Image()>& make, const Rows& rows = rows_here);

}  // namespace rainref::cache
