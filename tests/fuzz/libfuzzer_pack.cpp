// The whole way from a pack and a port to a verdict under libFuzzer; scripts/full/fuzz builds and runs it.
#include "fuzz/pack_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rainref::fuzz::judge_pack(std::as_bytes(std::span(data, size)));
  return 0;
}
