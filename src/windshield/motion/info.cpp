#include "windshield/motion/info.h"

#include "windshield/uniforms.h"

namespace rainref::windshield {

using namespace rainref::scene;
using namespace rainref::capture;

std::vector<BufferInfo> wiper_buffers() {
  return {{.name = "wipers",
           .format = "records",
           .sentence = "A record for each blade; corrected: for each of its moves in one direction.",
           .range = {-1, 1},
           .record = "Wiper"}};
}

std::vector<UniformBlock> wiper_records() {
  return {record<Wiper>(
      "Wiper",
      {member<&Wiper::previous_inner>("1", "Inner end before the step, glass coordinates."),
       member<&Wiper::previous_outer>("1", "Outer end before the step."), member<&Wiper::inner>("1", "Inner end after it."),
       member<&Wiper::outer>("1", "Outer end after it."), member<&Wiper::pivot>("m", "Plane coordinates."),
       member<&Wiper::inner_radius>("m", "Of the inner end, from the pivot."), member<&Wiper::outer_radius>("m", "Of the outer end."),
       member<&Wiper::previous_axis>("1", "Cosine and sine of the blade's angle before the step."),
       member<&Wiper::axis>("1", "The same after it."), member<&Wiper::half_width>("m", "Half the width that the blade wipes."),
       member<&Wiper::rate>("rad/s", "Turned angle over the time that the record stands for."),
       member<&Wiper::direction>("1", "Sign of rate; 0 at rest.")})};
}

}  // namespace rainref::windshield
