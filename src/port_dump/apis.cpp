#include "port_dump/apis.h"

#include <array>
#include <cctype>
#include <string>

namespace rainref::port_dump {
namespace {

constexpr std::array<Api, 10> all{{{"Vulkan", "vulkan"},
                                   {"WebGPU", "webgpu"},
                                   {"Direct3D", "d3d"},
                                   {"CUDA", "cuda"},
                                   {"Metal", "metal"},
                                   {"OpenGL", "opengl"},
                                   {"OpenGL ES", "gles"},
                                   {"WebGL", "webgl"},
                                   {"OpenCL", "opencl"},
                                   {"CPU", ""}}};

struct OtherName {
  std::string_view text, profile;
};
constexpr std::array<OtherName, 6> other_names{
    {{"d3d", "d3d"}, {"directx", "d3d"}, {"dx", "d3d"}, {"opengles", "gles"}, {"gles", "gles"}, {"gl", "opengl"}}};

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}
/// Whether the text begins with this word as a whole.
bool begins(std::string_view text, std::string_view word) {
  return text.starts_with(word) && (text.size() == word.size() || !std::isalpha(static_cast<unsigned char>(text[word.size()])));
}

}  // namespace

std::span<const Api> apis() { return all; }

const Api* api_of(std::string_view text) {
  const std::string plain = lower(text);
  const Api* found = nullptr;
  std::size_t length = 0;  // of the name that fits: "OpenGL ES" begins with "OpenGL"
  const auto take = [&](std::string_view name, const Api& api) {
    if (name.size() <= length || !begins(plain, name)) return;
    found = &api;
    length = name.size();
  };
  for (const Api& api : all) {
    take(lower(api.name), api);
    for (const OtherName& other : other_names)
      if (other.profile == api.profile) take(other.text, api);
  }
  return found;
}

}  // namespace rainref::port_dump
