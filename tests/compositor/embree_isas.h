// Embree's instruction sets, where the same bits are proven on each.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "compositor/scene.h"

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

/// What rays meet in scene_of(config): what asking every surface finds, with the same bits on one thread and on every instruction set.
template <class SceneOf>
std::vector<compositor::Hit> hits_for_every_embree(const std::vector<compositor::Ray>& rays, const SceneOf& scene_of) {
  using compositor::Hit;
  const auto hits_in = [&](const compositor::Scene& scene) {
    std::vector<Hit> hits(rays.size());
    scene.tracer().first_hits(rays, hits);
    return hits;
  };
  const auto expect_each = [&](const std::string& name, const auto& is_same) {
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (!is_same(i)) {
        ADD_FAILURE() << name << ": ray " << i;
        return;
      }
  };
  const auto scene = scene_of("");
  const std::vector<Hit> expected = hits_in(*scene);
  std::vector<std::shared_ptr<const compositor::Surface>> all;
  for (std::uint32_t s = 0; s < scene->surfaces(); ++s) all.emplace_back(std::shared_ptr<void>(), &scene->tracer().surface(s));
  expect_each("oracle", [&](std::size_t i) {
    const Hit oracle = compositor::first_hit_of_all(all, rays[i]);
    return oracle.t == expected[i].t && oracle.surface == expected[i].surface && oracle.part == expected[i].part;
  });
  std::vector<std::string> configs{"threads=1"};
  for (const std::string& isa : embree_isas()) configs.push_back(embree_config(isa));
  for (const std::string& config : configs) {
    const std::vector<Hit> hits = hits_in(*scene_of(config));
    expect_each(config, [&](std::size_t i) {
      const Hit &a = hits[i], &b = expected[i];
      return a.t == b.t && a.surface == b.surface && a.part == b.part && a.u == b.u && a.v == b.v;
    });
  }
  return expected;
}

}  // namespace rainref::test
