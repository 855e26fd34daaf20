// The sampler of a conforming GPU by lot (math/random_gpu.h).
#pragma once

#include "image/texture.h"
#include "math/random_gpu.h"

namespace rainref::random_gpu {

/// A sampler's coordinate: up to a step of its subtexel grid beside the computed one.
inline RandomGpu texel_coordinate(Address address, RandomGpu u, RandomGpu size) {
  RandomGpu a = u;
  if (address == Address::repeat) a = fract(u);
  if (address == Address::mirror) a = RandomGpu(1.0f) - abs(RandomGpu(2.0f) * fract(u * RandomGpu(0.5f)) - RandomGpu(1.0f));
  RandomGpu x = a * size - RandomGpu(0.5f);
  if (const int bits = rules().subtexel_bits; bits > 0)
    x = RandomGpu::exactly(static_cast<float>(x.v + uniform(-1, 1) * std::ldexp(0.999, -bits)));
  if (address == Address::repeat) return x;
  return address == Address::border ? scalar::clamp(x, RandomGpu(-1.0f), size) : scalar::clamp(x, RandomGpu(0.0f), size - RandomGpu(1.0f));
}

}  // namespace rainref::random_gpu
