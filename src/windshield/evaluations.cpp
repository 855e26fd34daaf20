#include "windshield/evaluations.h"

#include "blur_pyramid/blur_pyramid.h"
#include "drops/evaluations.h"
#include "pass/display.h"
#include "pass/model.h"
#include "windshield/scalar.h"
#include "windshield/surface_scalar.h"

namespace rainref::windshield {

const std::vector<capture::PassEvaluations>& evaluations() {
  static const std::vector<capture::PassEvaluations> all{{"windshield_frame", bind_windshield_frame},
                                                         {"spawn", nullptr, drops::recompute_spawn},
                                                         {"integrate", drops::bind_integrate},
                                                         {"wipe_drops", bind_wipe_drops},
                                                         {"merge", drops::bind_merge},
                                                         {"splat", drops::bind_splat},
                                                         {"wipe_texture", pass::bind<WipeTexturePass, scalar::WipeTexturePassText>},
                                                         {"normals", pass::bind<NormalsPass, scalar::NormalsPassText>},
                                                         {"blur_pyramid", blur_pyramid::bind_blur},
                                                         {"composite", pass::bind<CompositePass, scalar::CompositePassText>},
                                                         {"display", pass::bind_display}};
  return all;
}

}  // namespace rainref::windshield
