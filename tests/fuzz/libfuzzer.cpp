// One of the targets under libFuzzer; scripts/full/fuzz builds and runs them all.
#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const rainref::fuzz::Target target = [] {
    for (const auto& t : rainref::fuzz::targets) {
      if (std::strcmp(t.name, RAINREF_FUZZ_TARGET) == 0) return t;
    }
    std::abort();
  }();
  target.accepts(std::as_bytes(std::span(data, size)));
  return 0;
}
