#include "windshield/readings.h"

namespace rainref::windshield {

const std::vector<capture::PassReadings>& readings() {
  static const std::vector<capture::PassReadings> all{{"splat", bind_splat},
                                                      {"wipe_texture", bind_wipe_texture},
                                                      {"normals", bind_normals},
                                                      {"blur_pyramid", bind_blur_pyramid},
                                                      {"composite", bind_composite},
                                                      {"display", bind_display}};
  return all;
}

}  // namespace rainref::windshield
