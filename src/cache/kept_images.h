// Images that take long to make and are the same in every run, kept in a folder of the user's. Never needed: what is not there, is
// damaged, another user's or of another shape than its maker expects, or cannot be written is made anew, silently.
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

/// The images of make(), which have these shapes, shared (Image::share). Taken instead from what this process remembers
/// (cache/prepared.h); or read, where they were kept by this very program (its file's bytes count) for this recipe, in a file that belongs
/// to this user and that nobody else may write, their hash says that they are whole, and they have the shapes. rows: who makes the memory
/// that they are read into ready.
std::vector<Image> images(const Recipe& recipe, const std::vector<Shape>& shapes, const std::function<std::vector<Image>()>& make,
                          const Rows& rows = rows_here);

/// The same as prepared(): the images that make(by, reads...) gives.
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
