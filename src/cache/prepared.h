// What a process has made once of parameters and images, so that neither the next scene nor another value of a key makes it again. No bit
// hangs on it: a maker sees what its recipe names, and nothing else.
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

/// Bytes of prepared things that this process holds from here on, of all kinds together; 0, as at the start: none. Those that were used
/// longest ago go first; who uses one holds it.
void remember(std::size_t most_bytes);
bool remembers();
/// Lets go of all that nobody uses.
void forget();

/// How often each maker has made something, by its name.
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

/// Null where there is none. Any thread may ask.
std::shared_ptr<const void> find_prepared(const Recipe& recipe);
/// The value, which was made now, or the one that another thread made meanwhile.
std::shared_ptr<const void> keep_prepared(const Recipe& recipe, std::shared_ptr<const void> value, std::size_t bytes);

/// What make(by, reads...) gives, or gave before for the same reads. `what` names the maker, and no other one, and goes with one T. `by`:
/// who does the work, of which no bit depends. The maker is a function, which holds nothing of its own: what it reads is in `reads`. An
/// image is shared (Image::share).
template <class T, class By, class... Reads>
std::shared_ptr<const T> prepared(std::string_view what, const By& by, T (*make)(const By&, const Reads&...),
                                  const std::type_identity_t<Reads>&... reads) {
  const auto anew = [&] {
    auto made = std::make_shared<T>(make(by, reads...));
    if constexpr (std::is_same_v<T, Image>) made->share();
    return made;
  };
  if (!remembers()) return anew();  // no recipe: to hash pictures costs
  Recipe recipe(what);
  (recipe.add_read(reads), ...);
  if (auto known = find_prepared(recipe)) return std::static_pointer_cast<const T>(std::move(known));
  auto made = anew();
  const std::size_t bytes = bytes_of(std::as_const(*made));
  return std::static_pointer_cast<const T>(keep_prepared(recipe, std::move(made), bytes));
}

}  // namespace rainref::cache
