// The picture's passes and parameters described to others.
#pragma once

#include <vector>

#include "capture/pass_info.h"
#include "scene/config.h"
#include "scene/parameter.h"
#include "windshield/picture.h"

namespace rainref::windshield {

std::vector<capture::PassInfo> picture_passes();
std::vector<capture::BufferInfo> picture_buffers();
std::vector<scene::UniformBlock> picture_records();

std::vector<scene::Parameter> picture_parameters();
/// Size aside: a scene gives it to all effects alike.
PictureSettings picture_settings(const scene::Config& config);

}  // namespace rainref::windshield
