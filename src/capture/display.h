// The pass display (scene/display.h) as effects declare it and conformance takes it.
#pragma once

#include "capture/pass_info.h"
#include "capture/pass_model.h"

namespace rainref::capture {

/// Of both variants; it reads the colour of the pass `from`.
PassInfo display_info(const std::string& from);
std::unique_ptr<PassModel> bind_display(const PassCase& c);

}  // namespace rainref::capture
