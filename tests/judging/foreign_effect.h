// An effect that tests make up: its shaders, its description and its run. "grow" reads what it gave before and a list; "show" filters.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "capture/npy_write.h"
#include "spirv/compiled.h"

namespace rainref::judging {

namespace fs = std::filesystem;

inline const std::string grow_shader = R"(
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Growth { vec2 wind; float rate; float dt; int count; float rim; };
struct Drop { vec2 centre; float radius; float weight; };
layout(binding = 1) uniform sampler2D level_before;
layout(std430, binding = 2) readonly buffer Drops { Drop drops[]; };
layout(binding = 3, r32f) uniform writeonly image2D level;
void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(level)))) return;
  float value = min(texelFetch(level_before, at, 0).r + rate * dt, 1.0);
  for (int i = 0; i < count; ++i) {
    vec2 away = vec2(at) + 0.5 - drops[i].centre - wind * dt;
    float inside = length(away) / drops[i].radius;
    value *= 1.0 - drops[i].weight * (1.0 - smoothstep(1.0 - rim, 1.0, inside));
  }
  imageStore(level, at, vec4(value));
}
)";
inline const std::string show_shader = R"(
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Look { vec3 tint; float gain; };
layout(binding = 1) uniform sampler2D level;
layout(binding = 2) uniform sampler2D ground;
layout(binding = 3, rgba16f) uniform writeonly image2D colour;
void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(colour);
  if (at.x >= size.x || at.y >= size.y) return;
  float l = texelFetch(level, at, 0).r;
  vec2 uv = (vec2(at) + 0.5) / vec2(size);
  vec3 below = textureLod(ground, uv + 0.1 * vec2(l, 1.0 - l), 0.0).rgb;
  vec3 seen = mix(below, tint, sqrt(l)) * exp(-gain * l);
  imageStore(colour, at, vec4(seen, 1.0));
}
)";

/// What a port takes for a case has these numbers.
struct Growth {
  float wind[2] = {3.0f, -1.5f}, rate = 0.75f, dt = 0.0625f;
  std::int32_t count = 2;
  float rim = 0.375f, padding[2] = {};
};
struct Look {
  float tint[3] = {0.25f, 0.5f, 0.75f}, gain = 0.3125f;
};
struct Drop {
  float centre[2], radius, weight;
};

class ForeignEffect {
 public:
  static constexpr int width = 19, height = 11, frames = 3;

  ForeignEffect() {
    static const std::vector<std::byte> grow = spirv::compiled(grow_shader, "-g"), show = spirv::compiled(show_shader, "-g");
    write("grow.spv", grow);
    write("show.spv", show);
    describe(description());
    write_run();
  }
  fs::path file() const { return folder_ / "effect.json"; }
  fs::path run() const { return folder_ / "run"; }
  fs::path operator/(const std::string& name) const { return folder_ / name; }
  void describe(const nlohmann::ordered_json& json) const { put(file(), json.dump(1)); }
  void write(const fs::path& name, const std::vector<std::byte>& bytes) const {
    fs::create_directories((folder_.path() / name).parent_path());
    put(folder_.path() / name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  static nlohmann::ordered_json description() {
    const std::string size = R"("width": 19, "height": 11)";
    return nlohmann::ordered_json::parse(R"({"format": "rainref.effect", "version": 1, "effect": "pond", "passes": [
      {"name": "grow", "sentence": "Grows and is wiped", "spirv": "grow.spv",
       "uniform_block": {"name": "Growth", "size": 32, "members": [
         {"name": "wind", "type": "float", "components": 2, "offset": 0}, {"name": "rate", "type": "float", "components": 1, "offset": 8},
         {"name": "dt", "type": "float", "components": 1, "offset": 12}, {"name": "count", "type": "int", "components": 1, "offset": 16},
         {"name": "rim", "type": "float", "components": 1, "offset": 20}]},
       "inputs": [
         {"name": "level", "from": "grow", "run": "previous", "format": "r32f", )" +
                                         size + R"(},
         {"name": "drops", "format": "records", "record": {"name": "Drop", "size": 16, "members": [
           {"name": "centre", "type": "float", "components": 2, "offset": 0}, {"name": "radius", "type": "float", "components": 1, "offset": 8},
           {"name": "weight", "type": "float", "components": 1, "offset": 12}]}}],
       "outputs": [{"name": "level", "format": "r32f", )" +
                                         size + R"(, "range": [0, 1]}]},
      {"name": "show", "spirv": "show.spv",
       "uniform_block": {"name": "Look", "size": 16, "members": [
         {"name": "tint", "type": "float", "components": 3, "offset": 0}, {"name": "gain", "type": "float", "components": 1, "offset": 12}]},
       "inputs": [
         {"name": "level", "from": "grow", "format": "r32f", )" +
                                         size + R"(},
         {"name": "ground", "format": "rgba8", "width": 5, "height": 7, "address_u": "repeat", "address_v": "mirror", "filter": "linear"}],
       "outputs": [{"name": "colour", "format": "rgba16f", )" +
                                         size + R"(, "range": [0, 1]}]}]})");
  }
  /// bindings.json for shaders in this folder, as a port has it.
  void write_bindings() const {
    put(folder_ / "bindings.json", R"({"programs": {
      "pond.grow.reference/1": {"spirv": "grow.spv", "inputs": ["level", "drops"], "outputs": ["level"]},
      "pond.show.reference/1": {"spirv": "show.spv", "inputs": ["level", "ground"], "outputs": ["colour"]}}})");
  }
  static std::vector<float> first_level() {
    std::vector<float> texels;
    for (int i = 0; i < width * height; ++i) texels.push_back(static_cast<float>(i * 37 % 64) / 64);
    return texels;
  }
  static std::vector<Drop> drops() { return {{{5.5f, 4.25f}, 3.0f, 0.875f}, {{13.0f, 6.0f}, 4.5f, 0.5f}}; }

 private:
  template <class T>
  static std::vector<std::byte> bytes_of(const std::vector<T>& values) {
    std::vector<std::byte> out(values.size() * sizeof(T));
    std::memcpy(out.data(), values.data(), out.size());
    return out;
  }
  static std::vector<std::byte> npy(Format format, int w, int h, std::vector<std::byte> texels) {
    capture::Array array;
    array.format = format;
    array.width = w;
    array.height = h;
    array.levels = {std::move(texels)};
    return capture::npy_bytes(array, 0);
  }
  void write_run() const {
    std::vector<std::uint8_t> ground;
    for (int i = 0; i < 4 * 5 * 7; ++i) ground.push_back(static_cast<std::uint8_t>(i * 89 % 256));
    capture::Array list;
    list.is_records = true;
    list.record = {"Drop",
                   16,
                   {{"centre", scene::Scalar::float32, 2, 0, "", ""},
                    {"radius", scene::Scalar::float32, 1, 8, "", ""},
                    {"weight", scene::Scalar::float32, 1, 12, "", ""}}};
    list.width = 2;
    list.height = 1;
    list.levels = {bytes_of(drops())};
    for (int frame = 0; frame < frames; ++frame) {
      const std::string grow = "run/pond.grow/000" + std::to_string(frame) + ".0/",
                        show = "run/pond.show/000" + std::to_string(frame) + ".0/";
      write(grow + "uniforms.bin", bytes_of(std::vector<Growth>(1)));
      write(grow + "in.drops.npy", capture::npy_bytes(list, 0));
      if (frame == 0) write(grow + "in.level.npy", npy(Format::r32f, width, height, bytes_of(first_level())));
      write(show + "uniforms.bin", bytes_of(std::vector<Look>(1)));
      write(show + "in.ground.npy", npy(Format::rgba8, 5, 7, bytes_of(ground)));
    }
  }

  TemporaryFolder folder_;
};

}  // namespace rainref::judging
