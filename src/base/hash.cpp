#include "base/hash.h"

#include <new>

#include <fmt/format.h>
#include <xxhash.h>

#include "rainref/version.h"

namespace rainref {

std::string Hash128::text() const { return fmt::format("{:016x}{:016x}", high, low); }

struct Hasher::State {
  XXH3_state_t* xxh = XXH3_createState();
  ~State() { XXH3_freeState(xxh); }
};

Hasher::Hasher() : Hasher(golden_generation) {}
Hasher::Hasher(std::uint64_t seed) : state_(std::make_unique<State>()) {
  if (!state_->xxh) throw std::bad_alloc();
  XXH3_128bits_reset_withSeed(state_->xxh, seed);
}

Hasher::~Hasher() = default;

void Hasher::add(std::span<const std::byte> bytes) { XXH3_128bits_update(state_->xxh, bytes.data(), bytes.size()); }

Hash128 Hasher::finish() const {
  const XXH128_hash_t h = XXH3_128bits_digest(state_->xxh);
  return {h.high64, h.low64};
}

Hash128 file_hash(std::span<const std::byte> bytes) {
  Hasher hasher(0);
  hasher.add(bytes);
  return hasher.finish();
}

}  // namespace rainref
