#include "windshield/motion_info.h"

#include "drops/records.h"
#include "windshield/motion.h"
#include "windshield/uniforms.h"

namespace rainref::windshield {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;

constexpr const char *published = "as-published", *correct = "corrected";

}  // namespace

PassInfo windshield_frame_info() {
  using U = WindshieldFrameUniforms;
  const UniformBlock block = uniform_block<U>(
      "WindshieldFrameUniforms",
      {member<&U::heading>("heading", "1", component, "Cosine and sine of the car's heading, positive to the left."),
       member<&U::yaw_rate>("yaw_rate", "rad/s", {-1e3, 1e3}, "Turn rate of the car, positive to the left."),
       member<&U::yaw_acceleration>("yaw_acceleration", "rad/s^2", {-1e6, 1e6}, "Derivative of yaw_rate."),
       member<&U::world_wind>("world_wind", "m/s", {-100, 100}, "Velocity of the wind, world axes."),
       member<&U::gravity>("gravity", "m/s^2", {-100, 100}, "Acceleration of gravity."),
       member<&U::vehicle_velocity>("vehicle_velocity", "m/s", {-1e3, 1e3}, "Velocity of the car, world axes."),
       member<&U::acceleration>("acceleration", "m/s^2", {-1e6, 1e6}, "Acceleration of the car's origin, car axes."),
       member<&U::e_u>("e_u", "m", {-1e3, 1e3}, "Edge of the glass along u, car axes."),
       member<&U::e_v>("e_v", "m", {-1e3, 1e3}, "Edge of the glass along v, car axes."),
       member<&U::origin>("origin", "m", {-100, 100}, "corrected: corner (0, 0) of the glass, car axes."),
       member<&U::inverse_metric>("inverse_metric", "1/m^2", {-1e12, 1e12},
                                  "as-published: 1 / |e_u|^2, 0, 1 / |e_v|^2; corrected: uu, uv and vv of the metric's inverse.")});
  return {"windshield_frame",
          "Gravity, apparent wind and inertia in glass coordinates.",
          {{published, 1, Judge::keyed, "WindshieldFrameUniforms"}, {correct, 1, Judge::keyed, "WindshieldFrameUniforms"}},
          {},
          {"glass_frame"},
          {block},
          "gather",
          {"dot"}};
}

PassInfo wipe_drops_info(const char* from) {
  using U = WipeDropsUniforms;
  const UniformBlock block = uniform_block<U>(
      "WipeDropsUniforms",
      {member<&U::frame>("frame", "m", {-1e4, 1e4}, "x = f0 u + f1 v, y = f2 v: plane coordinates of glass coordinates."),
       member<&U::follow>("follow", "1", share, "as-published: share of the way to the leading edge that a captured drop makes."),
       member<&U::inverse_frame>("inverse_frame", "1/m", {-1e9, 1e9}, "u = i0 x + i1 y, v = i2 y."),
       member<&U::inherit>("inherit", "1", share, "as-published: share of the blade's velocity that a captured drop takes over."),
       member<&U::gain>("gain", "1", {0, 100}, "as-published: mass that a captured drop gains."),
       member<&U::radius_scale>("radius_scale", "m", share, "corrected: base radius of a drop of one mass unit."),
       member<&U::wiper_count>("wiper_count", "1", {0, 65536}, "Records in the list of wipers."),
       member<&U::bin_count>("bin_count", "1", {0, 4096}, "corrected: radial bins that share out the film."),
       member<&U::texel>("texel", "1", share, "corrected: 1 over the film's columns and rows."),
       member<&U::columns>("columns", "texel", {0, 65536}, "corrected: columns of the film."),
       member<&U::rows>("rows", "texel", {0, 65536}, "corrected: rows of the film.")});
  return {"wipe_drops",
          "Drops in the swept area ride on the blade; corrected: with the film that it sweeps.",
          {{published, 1, Judge::keyed, "WipeDropsUniforms"}, {correct, 1, Judge::keyed, "WipeDropsUniforms"}},
          {{"drops", from}, {"wipers"}, per_texel({"film", "merge", true, correct})},
          {"drops", "film"},
          {block},
          "gather",
          {"length"}};
}

std::vector<BufferInfo> wiper_buffers() {
  return {{"wipers",
           "records",
           "A record for each blade; corrected: for each of its moves in one direction.",
           "1",
           {-1, 1},
           "none",
           "none",
           "none",
           "",
           "Wiper"}};
}

std::vector<UniformBlock> wiper_records() {
  return {record<Wiper>(
      "Wiper", {member<&Wiper::previous_inner>("previous_inner", "1", "Inner end before the step, glass coordinates."),
                member<&Wiper::previous_outer>("previous_outer", "1", "Outer end before the step."),
                member<&Wiper::inner>("inner", "1", "Inner end after it."), member<&Wiper::outer>("outer", "1", "Outer end after it."),
                member<&Wiper::pivot>("pivot", "m", "Plane coordinates."),
                member<&Wiper::inner_radius>("inner_radius", "m", "Of the inner end, from the pivot."),
                member<&Wiper::outer_radius>("outer_radius", "m", "Of the outer end."),
                member<&Wiper::previous_axis>("previous_axis", "1", "Cosine and sine of the blade's angle before the step."),
                member<&Wiper::axis>("axis", "1", "The same after it."),
                member<&Wiper::half_width>("half_width", "m", "Half the width that the blade wipes."),
                member<&Wiper::rate>("rate", "rad/s", "Turned angle over the time that the record stands for."),
                member<&Wiper::direction>("direction", "1", "Sign of rate; 0 at rest.")})};
}

}  // namespace rainref::windshield
