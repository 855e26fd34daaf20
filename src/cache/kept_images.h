// Images that take long to generate and are the same in every run, kept in a folder of the user. The folder is never required. An image is
// silently generated again if its file is missing, damaged, owned by another user or of an unexpected shape. A failure to write is ignored.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/rows.h"
#include "cache/recipe.h"
#include "rainref/image.h"

namespace rainref::cache {

/// The shape of an image, known to its maker before it is made.
struct Shape {
  Format format;
  int width, height;  ///< 0: any
};

/// Sets the folder in which images are kept; it is made with the first image. An empty path, the initial value: images are not kept. Keeps
/// at most `most_bytes`, the most recently used. Call it from the thread that starts the others.
void keep_in(std::filesystem::path folder, std::uintmax_t most_bytes = std::uintmax_t{2} << 30);
/// $XDG_CACHE_HOME/rainref, or ~/.cache/rainref; empty if neither variable holds an absolute path.
std::filesystem::path folder_of_user();

/// Returns the images of make(), which have these shapes, shared (Image::share). They come from this process's memory (cache/prepared.h) if
/// possible. Else they are read from a file if this same program (by the bytes of its file) kept them for this recipe, the file belongs to
/// this user and nobody else may write it, its hash is right, and the shapes match. rows: runs the preparation of the memory that they are
/// read into.
std::vector<Image> images(const Recipe& recipe, const std::vector<Shape>& shapes, const std::function<std::vector<Image>()>& make,
                          const Rows& rows = rows_here);

/// The same as prepared(): the images of make(by, reads...).
template <class By, class... Reads>
std::vector<Image> kept(std::string_view what, const std::vector<Shape>& shapes, const Rows& rows, const By& by,
                        std::vector<Image> (*make)(const By&, const Reads&...), const std::type_identity_t<Reads>&... reads) {
  Recipe recipe(what);
  (recipe.add_read(reads), ...);
  return images(
      recipe, shapes, [&] { return make(by, reads...); }, rows);
}
/// One image.
template <class By, class... Reads>
Image kept(std::string_view what, const Shape& shape, const Rows& rows, const By& by, Image (*make)(const By&, const Reads&...),
           const std::type_identity_t<Reads>&... reads) {
  Recipe recipe(what);
  (recipe.add_read(reads), ...);
  const auto one = [&] {
    std::vector<Image> all;
    all.push_back(make(by, reads...));
    return all;
  };
  return std::move(images(recipe, {shape}, one, rows)[0]);
}

}  // namespace rainref::cache
