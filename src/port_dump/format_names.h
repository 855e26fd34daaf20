// Names of storage formats in graphics APIs and engines.
#pragma once

#include <string>
#include <string_view>

namespace rainref::port_dump {

/// "; did you mean 'rg16f'?" for the name of a format in Direct3D (DXGI_FORMAT_R16G16_FLOAT), Vulkan (VK_FORMAT_R16G16_SFLOAT), OpenGL
/// (GL_RG16F), Metal (MTLPixelFormatRG16Float), WebGPU (rg16float), Unity (RGHalf) or Godot (FORMAT_RGH); "" for other names, and for a
/// format that no buffer has.
std::string hint_of_other_name(std::string_view name);

}  // namespace rainref::port_dump
