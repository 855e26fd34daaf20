// Images that are kept between runs (cache/kept_images.h), for programs of others.
#pragma once

namespace rainref::simulation {

/// Called before a Simulation is opened: from the first on images are kept where rainref::keep_images said, or else where the command line
/// keeps them. Any thread may call.
void begin_to_keep();

}  // namespace rainref::simulation
