#include "windshield/readings.h"

#include "capture/display.h"
#include "drops/readings.h"

namespace rainref::windshield {

const std::vector<capture::PassReadings>& readings() {
  static const std::vector<capture::PassReadings> all{{"windshield_frame", bind_windshield_frame},
                                                      {"spawn", nullptr, drops::recompute_spawn},
                                                      {"integrate", drops::bind_integrate},
                                                      {"wipe_drops", bind_wipe_drops},
                                                      {"merge", drops::bind_merge},
                                                      {"splat", drops::bind_splat},
                                                      {"wipe_texture", bind_wipe_texture},
                                                      {"normals", bind_normals},
                                                      {"blur_pyramid", bind_blur_pyramid},
                                                      {"composite", bind_composite},
                                                      {"display", capture::bind_display}};
  return all;
}

}  // namespace rainref::windshield
