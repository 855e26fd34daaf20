// Random words that are the same everywhere, for tests.
#pragma once

#include <cstdint>

namespace rainref::test {

/// splitmix64 (Steele, Lea, Flood 2014).
class Words {
 public:
  explicit Words(std::uint64_t seed) : state_(seed) {}
  std::uint64_t operator()() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
  }
  bool coin() { return (*this)() >> 63; }

 private:
  std::uint64_t state_;
};

}  // namespace rainref::test
