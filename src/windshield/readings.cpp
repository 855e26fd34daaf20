#include "windshield/readings.h"

#include "drops/readings.h"
#include "pass/display.h"
#include "pass/model.h"
#include "windshield/every_reading.h"
#include "windshield/surface_every_reading.h"

namespace rainref::windshield {

const std::vector<capture::PassReadings>& readings() {
  static const std::vector<capture::PassReadings> all{{"windshield_frame", bind_windshield_frame},
                                                      {"spawn", nullptr, drops::recompute_spawn},
                                                      {"integrate", drops::bind_integrate},
                                                      {"wipe_drops", bind_wipe_drops},
                                                      {"merge", drops::bind_merge},
                                                      {"splat", drops::bind_splat},
                                                      {"wipe_texture", pass::bind<WipeTexturePass, every::WipeTexturePassText>},
                                                      {"normals", pass::bind<NormalsPass, every::NormalsPassText>},
                                                      {"blur_pyramid", bind_blur_pyramid},
                                                      {"composite", pass::bind<CompositePass, every::CompositePassText>},
                                                      {"display", pass::bind_display}};
  return all;
}

}  // namespace rainref::windshield
