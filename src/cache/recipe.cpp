#include "cache/recipe.h"

#include "base/hash.h"

namespace rainref::cache {

Recipe& Recipe::add(std::initializer_list<double> numbers) {
  for (const double x : numbers) add(std::bit_cast<std::uint64_t>(x));
  return *this;
}
Recipe& Recipe::add(std::uint64_t number) {
  text_.append(reinterpret_cast<const char*>(&number), sizeof number);
  return *this;
}
Recipe& Recipe::add(const Image& image) {
  const Hash128 hash = image.content_hash();
  return add(hash.high).add(hash.low);
}

}  // namespace rainref::cache
