// The corrected wave step in CUDA, on every case of it in a pack. Half storage; no shore (a basin).
//
//   cuda_wave_step PACK OUT
#include <cuda_fp16.h>

#include <cstdio>
#include <cstring>

#include <nlohmann/json.hpp>

#include "ports/runner/npy.h"

namespace {

using port_runner::Error;
using port_runner::fs::path;

struct WaveStepUniforms {
  float damping;      //   0  [1] as-published: factor of the new level; corrected: gamma of a step.
  float step;         //   4  [texel] as-published: offset of the neighbours.
  float courant_sq;   //   8  [1] corrected: Courant number squared, times (1 + gamma) / 2.
  int drop_count;     //  12  [1] Drops in the list.
  float rest;         //  16  [1] Stored value of level water.
  float rim_damping;  //  20  [1] corrected: share of the wave that the rim takes at the edge itself.
  float rim_inverse;  //  24  [1/texel] corrected: one over the width of the rim.
  float padding_0;    //  28  padding
  float2 size;        //  32  [texel] corrected: columns and rows of the wave.
  float padding_1;    //  40  padding
  float padding_2;    //  44  padding
};
static_assert(sizeof(WaveStepUniforms) == 48, "layout of WaveStepUniforms");
struct Drop {
  float x, y, amplitude, radius;
};
enum class Address { clamp, repeat, border };

/// The newest level at a texel; outside by the address rule.
__device__ float newest(const __half2* wave, int2 size, Address address, float rest, int x, int y) {
  if (address == Address::repeat) {
    x = (x + size.x) % size.x;
    y = (y + size.y) % size.y;
  } else if (address == Address::border && (x < 0 || y < 0 || x >= size.x || y >= size.y)) {
    return rest;
  }
  x = min(max(x, 0), size.x - 1);
  y = min(max(y, 0), size.y - 1);
  return __low2float(wave[y * size.x + x]);
}

__global__ void wave_step(WaveStepUniforms u, const __half2* wave, int2 size, Address address, const Drop* drops, __half2* next_wave) {
  const int x = blockIdx.x * blockDim.x + threadIdx.x, y = blockIdx.y * blockDim.y + threadIdx.y;
  if (x >= size.x || y >= size.y) return;
  const auto at = [&](int column, int row) { return newest(wave, size, address, u.rest, column, row); };
  const float here = at(x, y), cx = x + 0.5f, cy = y + 0.5f;
  float previous = __high2float(wave[y * size.x + x]), kept = 1;
  if (u.rim_damping > 0) {
    const float edge = fminf(fminf(cx, u.size.x - cx), fminf(cy, u.size.y - cy)), depth = fmaxf(1.0f - u.rim_inverse * edge, 0.0f);
    kept = 1.0f - u.rim_damping * (depth * depth);  // what a rim along the edges leaves of both levels
    previous = u.rest + kept * (previous - u.rest);
  }
  const float laplacian = at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1) - 4.0f * here;
  float craters = 0;
  for (int i = 0; i < u.drop_count; ++i) {
    const float inverse = 1.0f / drops[i].radius, dx = (cx - drops[i].x) * inverse, dy = (cy - drops[i].y) * inverse;
    const float q2 = dx * dx + dy * dy, rim = fmaxf(1.0f - q2, 0.0f);
    craters += drops[i].amplitude * (rim * rim * (1.0f - 4.0f * q2));
  }
  float next = here + u.damping * (here - previous) + u.courant_sq * laplacian + craters;
  if (u.rim_damping > 0) next = u.rest + kept * (next - u.rest);
  next_wave[y * size.x + x] = __floats2half2_rn(next, here + craters);
}

void check(cudaError_t result, const char* call) {
  if (result != cudaSuccess) throw Error(std::string(call) + ": " + cudaGetErrorString(result));
}
/// Bytes on the device, freed with the object.
class DeviceBytes {
 public:
  explicit DeviceBytes(const std::vector<std::uint8_t>& bytes) : DeviceBytes(bytes.size()) {
    check(cudaMemcpy(at_, bytes.data(), bytes.size(), cudaMemcpyHostToDevice), "cudaMemcpy");
  }
  explicit DeviceBytes(std::size_t size) { check(cudaMalloc(&at_, size == 0 ? 1 : size), "cudaMalloc"); }
  DeviceBytes(const DeviceBytes&) = delete;
  DeviceBytes& operator=(const DeviceBytes&) = delete;
  ~DeviceBytes() { cudaFree(at_); }
  template <class T>
  T* as() const {
    return static_cast<T*>(at_);
  }

 private:
  void* at_ = nullptr;
};

const nlohmann::json& named(const nlohmann::json& list, const std::string& name) {
  for (const nlohmann::json& one : list) {
    if (one.at("name") == name) return one;
  }
  throw Error("the case has no buffer " + name);
}

void run(const path& pack, const path& out, const nlohmann::json& c) {
  const nlohmann::json &wave = named(c.at("inputs"), "wave"), &drops = named(c.at("inputs"), "drops");
  if (wave.at("format") != "rg16f" || c.at("inputs").size() != 2)
    throw Error(c.at("id").get<std::string>() + ": expected a basin in rg16f");
  const std::string rule = wave.at("address_u");
  const Address address = rule == "repeat" ? Address::repeat : rule == "border" ? Address::border : Address::clamp;
  const int2 size = make_int2(wave.at("width"), wave.at("height"));
  const auto shape = std::vector<std::size_t>{static_cast<std::size_t>(size.y), static_cast<std::size_t>(size.x), 2};

  WaveStepUniforms u;
  const auto block = port_runner::read_file(pack / c.at("uniform_block").at("file").get<std::string>());
  if (block.size() != sizeof u) throw Error("uniforms.bin: expected 48 bytes");
  std::memcpy(&u, block.data(), sizeof u);
  const auto records = port_runner::read_npy(pack / drops.at("file").get<std::string>()).bytes;
  if (u.drop_count < 0 || records.size() != u.drop_count * sizeof(Drop)) throw Error("drop_count is not the number of the drops");
  const auto texels = port_runner::read_npy(pack / wave.at("file").get<std::string>(), "'<f2'", shape);

  const DeviceBytes wave_bytes(texels), drop_bytes(records), next(texels.size());
  const dim3 group(16, 16), groups((size.x + 15) / 16, (size.y + 15) / 16);
  wave_step<<<groups, group>>>(u, wave_bytes.as<__half2>(), size, address, drop_bytes.as<Drop>(), next.as<__half2>());
  check(cudaGetLastError(), "wave_step");
  port_runner::Array result{"'<f2'", shape, std::vector<std::uint8_t>(texels.size())};
  check(cudaMemcpy(result.bytes.data(), next.as<void>(), texels.size(), cudaMemcpyDeviceToHost), "cudaMemcpy");
  port_runner::write_npy(out / named(c.at("outputs"), "wave").at("file").get<std::string>(), result);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) throw Error("usage: cuda_wave_step PACK OUT");
  const path pack = argv[1], out = argv[2];
  const nlohmann::json manifest = nlohmann::json::parse(port_runner::read_file(pack / "manifest.json"));
  cudaDeviceProp device;
  check(cudaGetDeviceProperties(&device, 0), "cudaGetDeviceProperties");
  int cases = 0;
  for (const nlohmann::json& c : manifest.at("cases")) {
    if (c.at("pass") != "wave_step") continue;
    run(pack, out, c);
    ++cases;
  }
  const nlohmann::ordered_json info{
      {"api", "CUDA"}, {"device", device.name}, {"half_store", "rne"}, {"origin", "top-left"}, {"precise", false}};
  port_runner::write_file(out / "port.json", info.dump(2) + "\n");
  std::printf("%d cases on %s, in %s\n", cases, device.name, out.c_str());
  return cases > 0 ? 0 : 1;
} catch (const std::exception& e) {
  std::fprintf(stderr, "cuda_wave_step: %s\n", e.what());
  return 1;
}
