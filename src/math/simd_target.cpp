#include "math/simd_target.h"

#include "math/disabled_targets.h"

#include <cstdint>

#include <fmt/format.h>

#include "hwy/highway.h"
#include "hwy/targets.h"
#include "rainref/error.h"

namespace rainref {
namespace {

struct Named {
  const char* name;
  std::int64_t bit;
};
// EMU128 replaces SCALAR in Highway with clang: the same operations on arrays of four.
constexpr Named known[] = {{"avx3", HWY_AVX3},     {"avx2", HWY_AVX2},     {"sse4", HWY_SSE4}, {"ssse3", HWY_SSSE3},
                           {"scalar", HWY_SCALAR}, {"scalar", HWY_EMU128}, {"neon", HWY_NEON}, {"wasm", HWY_WASM}};

consteval bool has_name(std::int64_t bit) {
  for (const Named& target : known)
    if (target.bit == bit) return true;
  return false;
}
// Targets required by the compiler's own flags, including -march=native. HWY_DISABLED_TARGETS removes the others.
static_assert(has_name(HWY_STATIC_TARGET), "the narrowest target of this build has no name");

std::int64_t usable() {
  static const std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;
  return targets;
}

std::int64_t& selected() {
  static std::int64_t bit = 0;
  return bit;
}

}  // namespace

std::vector<std::string> simd_targets() {
  std::vector<std::string> names;
  for (const Named& target : known) {
    if (usable() & target.bit) names.emplace_back(target.name);
  }
  return names;
}

void select_simd_target(std::string_view name) {
  const std::int64_t all = usable();  // before a restriction is set
  std::int64_t bit = 0;
  for (const Named& target : known) {
    if ((all & target.bit) && (name.empty() || name == target.name)) {
      bit = target.bit;
      break;
    }
  }
  if (bit == 0) {
    const std::vector<std::string> here = simd_targets();
    // AVX-512 is the only target whose usual name differs much from the one here.
    const bool is_avx512 =
        name.starts_with("avx512") || name.starts_with("AVX512") || name.starts_with("avx-512") || name.starts_with("AVX-512");
    throw Error(ExitCode::usage, fmt::format("SIMD target '{}': this machine has {}{}", name, fmt::join(here, ", "),
                                             !is_avx512               ? did_you_mean(name, here)
                                             : here.front() == "avx3" ? "; did you mean 'avx3'?"
                                                                      : "; AVX-512 is called avx3, which is not among them"));
  }
  hwy::SetSupportedTargetsForTest(bit);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  selected() = bit;
}

std::string selected_simd_target() {
  if (selected() == 0) select_simd_target("");
  for (const Named& target : known) {
    if (selected() == target.bit) return target.name;
  }
  throw Error(ExitCode::internal, "a SIMD target without a name is selected");
}

}  // namespace rainref
