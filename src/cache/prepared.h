// Values that a process has made once from parameters and images, so that the next scene, or another value of a key, need not make them
// again. They do not affect results: a maker reads only what its recipe names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "cache/recipe.h"

namespace rainref::cache {

/// Sets the number of bytes of all prepared values that this process keeps; 0, the initial value: none. The least recently used are dropped
/// first; users of a value keep it alive.
void remember(std::size_t most_bytes);
bool remembers();
/// Drops all values that are not in use.
void forget();

/// Number of calls of each maker, by its name.
std::map<std::string, std::int64_t> times_made();

inline std::size_t bytes_of(const Image& image) {
  return image.empty() ? 0 : static_cast<std::size_t>(Image::memory_bytes(image.format(), image.width(), image.height()));
}
inline std::size_t bytes_of(const std::vector<Image>& images) {
  std::size_t bytes = 0;
  for (const Image& image : images) bytes += bytes_of(image);
  return bytes;
}
template <class T>
requires std::is_trivially_copyable_v<T> std::size_t bytes_of(const std::vector<T>& list) { return list.size() * sizeof(T); }
template <class T>
requires requires(const T& x) { x.bytes(); }
std::size_t bytes_of(const T& x) { return x.bytes(); }

/// Null if there is none. Thread-safe.
std::shared_ptr<const void> find_prepared(const Recipe& recipe);
/// Returns the value made now, or the one that another thread made meanwhile.
std::shared_ptr<const void> keep_prepared(const Recipe& recipe, std::shared_ptr<const void> value, std::size_t bytes);

/// Returns make(by, reads...), or its earlier result for the same reads. `what` is the unique name of the maker, and belongs to one T. `by`
/// runs the work and must not affect the result. The maker is a function without state: it reads only `reads`. An image is shared
/// (Image::share).
template <class T, class By, class... Reads>
std::shared_ptr<const T> prepared(std::string_view what, const By& by, T (*make)(const By&, const Reads&...),
                                  const std::type_identity_t<Reads>&... reads) {
  const auto anew = [&] {
    auto made = std::make_shared<T>(make(by, reads...));
    if constexpr (std::is_same_v<T, Image>) made->share();
    return made;
  };
  if (!remembers()) return anew();  // without a recipe, because hashing pictures takes time
  Recipe recipe(what);
  (recipe.add_read(reads), ...);
  if (auto known = find_prepared(recipe)) return std::static_pointer_cast<const T>(std::move(known));
  auto made = anew();
  const std::size_t bytes = bytes_of(std::as_const(*made));
  return std::static_pointer_cast<const T>(keep_prepared(recipe, std::move(made), bytes));
}

}  // namespace rainref::cache
