// The inputs of a made value, as bytes.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <ranges>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "rainref/image.h"

namespace rainref::cache {

/// Everything that a value depends on: its maker, and what that reads.
class Recipe {
 public:
  /// what: the unique name of the maker.
  explicit Recipe(std::string_view what) : text_(what) { text_.push_back('\0'); }
  Recipe& add(std::initializer_list<double> numbers);
  Recipe& add(std::uint64_t number);
  /// Adds an image by the hash of its texels.
  Recipe& add(const Image& image);
  /// Adds a number, an enumerator, a text or list with its length, a struct that has add_to(recipe), or another struct by its bytes, which
  /// must not hold a pointer. At worst, padding between members makes two equal structs differ.
  template <class T>
  Recipe& add_read(const T& x) {
    if constexpr (std::is_same_v<T, Image>)
      return add(x);
    else if constexpr (requires { x.add_to(*this); })
      return x.add_to(*this), *this;
    else if constexpr (std::is_enum_v<T>)
      return add(static_cast<std::uint64_t>(x));
    else if constexpr (std::floating_point<T>)
      return add({static_cast<double>(x)});
    else if constexpr (std::integral<T>)
      return add(static_cast<std::uint64_t>(x));
    else if constexpr (std::convertible_to<const T&, std::string_view>) {
      const std::string_view text = x;
      add(static_cast<std::uint64_t>(text.size()));
      text_.append(text);
      return *this;
    } else if constexpr (requires { T::length(), x[0]; }) {  // a GLM vector
      for (int k = 0; k < T::length(); ++k) add_read(x[k]);
      return *this;
    } else if constexpr (std::ranges::sized_range<T>) {
      add(static_cast<std::uint64_t>(std::ranges::size(x)));
      for (const auto& each : x) add_read(each);
      return *this;
    } else {
      static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
      text_.append(reinterpret_cast<const char*>(&x), sizeof x);
      return *this;
    }
  }
  const std::string& text() const { return text_; }
  std::string what() const { return text_.substr(0, text_.find('\0')); }

 private:
  std::string text_;
};

template <class T>
struct MemberOf;
template <class Struct, class Value>
struct MemberOf<Value Struct::*> {
  using Owner = Struct;
};

/// A copy of a struct with only these members; the others have their defaults. A maker that depends on `members` alone receives this, so
/// that it cannot read others.
template <auto first, auto... members>
struct Only {
  using Struct = typename MemberOf<decltype(first)>::Owner;

  Only(const Struct& all) {
    of.*first = all.*first;
    ((of.*members = all.*members), ...);
  }
  void add_to(Recipe& recipe) const {
    recipe.add_read(of.*first);
    (recipe.add_read(of.*members), ...);
  }
  Struct of{};
};

}  // namespace rainref::cache
