// Embree's instruction sets, where the same bits are proven on each.
#pragma once

#include <string>
#include <vector>

namespace rainref::test {

/// Every instruction set that this machine's Embree can use, the oldest first; "" stands for its own choice.
inline std::vector<std::string> embree_isas() {
#if defined(__x86_64__)
  std::vector<std::string> isas{"sse2", "sse4.2"};
  if (__builtin_cpu_supports("avx")) isas.push_back("avx");
  if (__builtin_cpu_supports("avx2")) isas.push_back("avx2");
  if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
    isas.push_back("avx512");
  return isas;
#else
  return {""};
#endif
}
/// What asks for one of them.
inline std::string embree_config(const std::string& isa) { return isa.empty() ? "" : "isa=" + isa; }

}  // namespace rainref::test
