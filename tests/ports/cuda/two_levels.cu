// How a GPU weighs the eight texels of a lookup between two levels of detail, against a model of how an H100 does.
//
//   nvcc -O2 -std=c++17 tests/ports/cuda/two_levels.cu -o two_levels && ./two_levels
//
// One-hot texels give each weight by itself, which must be the model's to the bit. A blend of random texels may be off by a rounding of
// each of its eight products for floats, by a step between halves for halves. Exit code 0 if all agree; 1 if one does not, or there is no
// device.
#include <cuda_fp16.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr int textures = 4, places = 8000, side = 16;  // side of the finer level: a power of two, so that the coordinate u W is exact
using Texel = std::array<float, 4>;
using Levels = std::array<std::vector<Texel>, 2>;

void check(cudaError_t result, const char* call) {
  if (result != cudaSuccess) throw std::runtime_error(std::string(call) + ": " + cudaGetErrorString(result));
}
__global__ void look_up(cudaTextureObject_t texture, const float3* at, float4* out) {
  const int i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < places) out[i] = tex2DLod<float4>(texture, at[i].x, at[i].y, at[i].z);
}
/// What the texture unit gives at each place (u, v, level of detail), from texels of T. What it allocates lasts as long as the program.
template <class T>
std::vector<float4> looked_up(const Levels& levels, const std::vector<float3>& at) {
  const cudaChannelFormatDesc format =
      cudaCreateChannelDesc(8 * sizeof(T), 8 * sizeof(T), 8 * sizeof(T), 8 * sizeof(T), cudaChannelFormatKindFloat);
  cudaResourceDesc resource{cudaResourceTypeMipmappedArray, {}};
  check(cudaMallocMipmappedArray(&resource.res.mipmap.mipmap, &format, make_cudaExtent(side, side, 0), 2), "cudaMallocMipmappedArray");
  for (int l = 0; l < 2; ++l) {
    std::vector<T> stored;
    for (const Texel& t : levels[l]) stored.insert(stored.end(), t.begin(), t.end());
    const std::size_t row = 4 * sizeof(T) * (side >> l);
    cudaArray_t array;
    check(cudaGetMipmappedArrayLevel(&array, resource.res.mipmap.mipmap, l), "cudaGetMipmappedArrayLevel");
    check(cudaMemcpy2DToArray(array, 0, 0, stored.data(), row, row, side >> l, cudaMemcpyHostToDevice), "cudaMemcpy2DToArray");
  }
  cudaTextureDesc sampler{{cudaAddressModeClamp, cudaAddressModeClamp}, cudaFilterModeLinear};
  sampler.mipmapFilterMode = cudaFilterModeLinear;
  sampler.normalizedCoords = 1;
  sampler.maxMipmapLevelClamp = 1;
  cudaTextureObject_t texture;
  check(cudaCreateTextureObject(&texture, &resource, &sampler, nullptr), "cudaCreateTextureObject");
  float3* there;
  float4* results;
  check(cudaMalloc(&there, places * sizeof(float3)), "cudaMalloc");
  check(cudaMalloc(&results, places * sizeof(float4)), "cudaMalloc");
  check(cudaMemcpy(there, at.data(), places * sizeof(float3), cudaMemcpyHostToDevice), "cudaMemcpy");
  look_up<<<(places + 127) / 128, 128>>>(texture, there, results);
  check(cudaGetLastError(), "look_up");
  std::vector<float4> out(places);
  check(cudaMemcpy(out.data(), results, places * sizeof(float4), cudaMemcpyDeviceToHost), "cudaMemcpy");
  return out;
}

/// Texels that T holds exactly. Textures 0 and 1 are one-hot: in level 0 or 1 channel i % 2 + 2 (j % 2) of texel (i, j) is 1, so that a
/// lookup gives its four weights. The others are random, in [-1, 1].
template <class T>
Levels levels_of(int texture, std::mt19937& words) {
  const int steps = sizeof(T) == 2 ? 1 << 11 : 1 << 24;
  Levels out;
  for (int l = 0; l < 2; ++l) {
    for (int n = 0; n < (side >> l) * (side >> l); ++n) {
      Texel t{};
      if (texture == l) t[n % 2 + 2 * (n / (side >> l) % 2)] = 1;
      if (texture > 1)
        std::generate(t.begin(), t.end(),
                      [&] { return (static_cast<int>(words() % (2 * steps + 1)) - steps) / static_cast<float>(steps); });
      out[l].push_back(t);
    }
  }
  return out;
}

/// A level's part of a lookup, all in 1/256; the four are left, right, upper left, upper right.
struct Part {
  int share, fx, fy;
  std::array<Texel, 4> texels;
  std::array<double, 4> together, alone;  ///< weights: all eight rounded together; this level's four rounded, then mixed
};
Part part_of(const Levels& levels, const float3& p, int l) {
  const int w = side >> l, coarser = static_cast<int>(std::floor(p.z * 256)), s = l == 0 ? 256 - coarser : coarser;
  const auto half_up = [](double n) { return std::floor(n / 256 + 0.5); };
  const auto snapped = [&](double u) { return static_cast<int>(half_up((u * w - 0.5) * 65536)); };
  const int x = snapped(p.x), y = snapped(p.y), fx = x % 256, fy = y % 256, at = y / 256 * w + x / 256;
  const double right = half_up(s * fx), left = s - right, upper_right = half_up(right * fy), upper_left = std::ceil(left * fy / 256 - 0.5);
  const double both = half_up(fx * fy), mixed = s / 256.0;
  const auto t = levels[l].begin() + at;
  return {s,
          fx,
          fy,
          {t[0], t[1], t[w], t[w + 1]},
          {left - upper_left, right - upper_right, upper_left, upper_right},
          {mixed * (256 - fx - fy + both), mixed * (fx - both), mixed * (fy - both), mixed * both}};
}

/// Looks up textures of T at every place; prints counts, and the first five results that differ. Whether none does.
template <class T>
bool agrees(const char* format, const std::vector<float3>& at, std::mt19937& words) {
  int results = 0, nearest = 0, rounded = 0, naive = 0;
  double farthest = 0;
  for (int texture = 0; texture < textures; ++texture) {
    const double allowed = texture < 2 ? 0 : sizeof(T) == 2 ? 0x1p-11 : 8 * 0x1p-24;
    const Levels levels = levels_of<T>(texture, words);
    const std::vector<float4> looked = looked_up<T>(levels, at);
    for (int i = 0; i < places; ++i) {
      const float got[] = {looked[i].x, looked[i].y, looked[i].z, looked[i].w};
      const Part parts[] = {part_of(levels, at[i], 0), part_of(levels, at[i], 1)};
      for (int k = 0; k < 4; ++k, ++results) {
        double together = 0, alone = 0;  // exact
        for (int m = 0; m < 8; ++m) {
          together += parts[m / 4].together[m % 4] * parts[m / 4].texels[m % 4][k] / 256;
          alone += parts[m / 4].alone[m % 4] * parts[m / 4].texels[m % 4][k] / 256;
        }
        const auto is = [&](double value) { return got[k] == static_cast<float>(static_cast<T>(static_cast<float>(value))); };
        const double off = std::abs(got[k] - together);
        nearest += is(together);
        rounded += !is(together) && off <= allowed;
        naive += is(alone) || std::abs(got[k] - alone) <= allowed;
        farthest = std::max(farthest, off);
        if (is(together) || off <= allowed || results - nearest - rounded >= 5) continue;
        std::printf("%s, texture %d, u %a v %a lod %a, channel %d: got %.9g, model %.9g, naive %.9g\n", format, texture, at[i].x, at[i].y,
                    at[i].z, k, got[k], together, alone);
        for (const Part& p : parts) {
          std::printf("  share %d fx %d fy %d; texel, weight, naive weight:", p.share, p.fx, p.fy);
          for (int m = 0; m < 4; ++m) std::printf(" (%.9g %g %g)%s", p.texels[m][k], p.together[m], p.alone[m], m == 3 ? "\n" : "");
        }
      }
    }
  }
  std::printf("%s: %d lookups, %d results; model %d (%d to nearest, %d but for roundings; at most %g off); naive model %d\n", format,
              textures * places, results, nearest + rounded, nearest, rounded, farthest, naive);
  return nearest + rounded == results;
}

}  // namespace

int main() try {
  cudaDeviceProp device;
  check(cudaGetDeviceProperties(&device, 0), "cudaGetDeviceProperties");
  std::mt19937 words{1};
  std::vector<float3> at(places);  // cells inside both levels; multiples of 2^-20, so that coordinates on a tie occur
  for (float3& p : at)
    p = {0.125f + words() % (3 << 18) * 0x1p-20f, 0.125f + words() % (3 << 18) * 0x1p-20f, words() % (1 << 20) * 0x1p-20f};
  std::printf("%s\n", device.name);
  const bool floats = agrees<float>("float4", at, words), halves = agrees<__half>("half4", at, words);
  return floats && halves ? 0 : 1;
} catch (const std::exception& e) {
  std::fprintf(stderr, "two_levels: %s\n", e.what());
  return 1;
}
