// The picture's passes and parameters described to others.
#pragma once

#include <vector>

#include "capture/pass_info.h"
#include "scene/member_parameter.h"
#include "windshield/picture/picture.h"

namespace rainref::windshield {

std::vector<capture::PassInfo> picture_passes();
std::vector<capture::BufferInfo> picture_buffers();
std::vector<scene::UniformBlock> picture_records();

/// Size and margin aside, which scenes say elsewhere.
const std::vector<scene::MemberParameter<PictureSettings>>& picture_parameters();

}  // namespace rainref::windshield
