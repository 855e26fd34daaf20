#include "windshield/info.h"

#include "blur_pyramid/blur_pyramid.h"
#include "drops/info.h"
#include "pass/display.h"
#include "pass/model.h"
#include "windshield/scalar.h"

namespace rainref::windshield {

const std::vector<capture::PassEvaluations>& evaluations() {
  static const std::vector<capture::PassEvaluations> all{
      {"windshield_frame", bind_windshield_frame},
      drops::spawn_evaluations(),
      {"integrate", drops::bind_integrate},
      {"wipe_drops", bind_wipe_drops},
      {"necks", drops::bind_necks},
      {"merge", drops::bind_merge},
      {"splat", drops::bind_splat},
      {"persist", pass::bind<PersistPass, scalar::PersistPassText>},
      {"wipe_texture",
       pass::bind<WipeTexturePass, scalar::WipeTexturePassText>,
       nullptr,
       nullptr,
       {{"the blades' ends from the other members of their records",
         "a record has the ends of its blade as places on the glass and as pivot, axis and "
         "radii, rounded each; the pass takes the others than the port",
         bind_wipe_from_ends}}},
      {"smear", pass::bind<SmearPass, scalar::SmearPassText>},
      {"condense", pass::bind<CondensePass, scalar::CondensePassText>},
      {"normals", pass::bind<NormalsPass, scalar::NormalsPassText>},
      {"blur_pyramid", blur_pyramid::bind_blur},
      {"falling_rain", pass::bind<FallingRainPass, scalar::FallingRainPassText>},
      {"composite", pass::bind<CompositePass, scalar::CompositePassText>},
      {"soften", pass::bind<SoftenPass, scalar::SoftenPassText>},
      {"mist", pass::bind<MistPass, scalar::MistPassText>},
      {"join_panes", pass::bind<JoinPanesPass, scalar::JoinPanesPassText>},
      {"interior", pass::bind<InteriorPass, scalar::InteriorPassText>},
      {"display", pass::bind_display}};
  return all;
}

}  // namespace rainref::windshield
