// Random words that are the same everywhere, for tests.
#pragma once

#include <cstdint>

#include "base/scramble.h"

namespace rainref::test {

/// splitmix64.
class Words {
 public:
  explicit Words(std::uint64_t seed) : state_(seed) {}
  std::uint64_t operator()() { return scramble(state_ += scramble_step); }
  bool coin() { return (*this)() >> 63; }

 private:
  std::uint64_t state_;
};

}  // namespace rainref::test
