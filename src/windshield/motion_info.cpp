#include "windshield/motion_info.h"

#include <cstddef>

#include "drops/records.h"
#include "windshield/motion.h"
#include "windshield/uniforms.h"

namespace rainref::windshield {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;
using drops::GlassFrame;

constexpr const char *published = "as-published", *correct = "corrected";

// A row of a 2 x 2 matrix: four floats in one would have to begin at a multiple of 16 bytes.
Member row(std::size_t matrix, std::size_t index, const char* name, const char* unit, const char* sentence) {
  return {name, Scalar::float32, 2, matrix + 8 * index, unit, sentence};
}

}  // namespace

PassInfo windshield_frame_info() {
  using U = WindshieldFrameUniforms;
  const UniformBlock block = uniform_block<U>(
      "WindshieldFrameUniforms",
      {member<&U::heading>("heading", "1", "Cosine and sine of the car's heading, positive to the left."),
       member<&U::yaw_rate>("yaw_rate", "rad/s", "Turn rate of the car, positive to the left."),
       member<&U::yaw_acceleration>("yaw_acceleration", "rad/s^2", "Derivative of yaw_rate."),
       member<&U::world_wind>("world_wind", "m/s", "Velocity of the wind, world axes."),
       member<&U::gravity>("gravity", "m/s^2", "Acceleration of gravity."),
       member<&U::vehicle_velocity>("vehicle_velocity", "m/s", "Velocity of the car, world axes."),
       member<&U::acceleration>("acceleration", "m/s^2", "Acceleration of the car's origin, car axes."),
       member<&U::e_u>("e_u", "m", "Edge of the glass along u, car axes."),
       member<&U::e_v>("e_v", "m", "Edge of the glass along v, car axes."),
       member<&U::origin>("origin", "m", "corrected: corner (0, 0) of the glass, car axes."),
       member<&U::inverse_metric>("inverse_metric", "1/m^2", "as-published: 1 / |e_u|^2, 0, 1 / |e_v|^2; corrected: uu, uv and vv of the metric's inverse.")});
  return {"windshield_frame", "Gravity, apparent wind and inertia in glass coordinates.",
          {{published, 1, Judge::envelope, "WindshieldFrameUniforms"}, {correct, 1, Judge::envelope, "WindshieldFrameUniforms"}},
          {}, {"glass_frame"}, {block}, "gather", {"dot"}};
}

PassInfo wipe_drops_info(const char* from) {
  using U = WipeDropsUniforms;
  const UniformBlock block = uniform_block<U>(
      "WipeDropsUniforms",
      {member<&U::frame>("frame", "m", "x = f0 u + f1 v, y = f2 v: plane coordinates of glass coordinates."),
       member<&U::follow>("follow", "1", "as-published: share of the way to the leading edge that a captured drop makes."),
       member<&U::inverse_frame>("inverse_frame", "1/m", "u = i0 x + i1 y, v = i2 y."),
       member<&U::inherit>("inherit", "1", "as-published: share of the blade's velocity that a captured drop takes over."),
       member<&U::gain>("gain", "1", "as-published: mass that a captured drop gains."),
       member<&U::radius_scale>("radius_scale", "m", "corrected: base radius of a drop of one quantum."),
       member<&U::wiper_count>("wiper_count", "1", "Records in the list of wipers."),
       member<&U::bin_count>("bin_count", "1", "corrected: radial bins that share out the film."),
       member<&U::texel>("texel", "1", "corrected: 1 over the film's columns and rows."),
       member<&U::columns>("columns", "texel", "corrected: columns of the film."),
       member<&U::rows>("rows", "texel", "corrected: rows of the film.")});
  // The published pass decides by signs and moves: an envelope. The corrected one hands whole quanta from texels to drops: keyed.
  return {"wipe_drops", "Drops in the swept area ride on the blade; corrected: with the film that it sweeps.",
          {{published, 1, Judge::envelope, "WipeDropsUniforms"}, {correct, 1, Judge::keyed, "WipeDropsUniforms"}},
          {{"drops", from}, {"wipers"}, {"film", "", true, correct}}, {"drops"}, {block}, "gather", {"length"}};
}

std::vector<BufferInfo> motion_buffers() {
  return {{"wipers", "records", "A record for each blade; corrected: for each of its moves in one direction.", "1", {-1, 1}, "none", "none", "none", "", "Wiper"},
          {"glass_frame", "records", "What moves drops on the glass: one record.", "1", {-100, 100}, "none", "none", "none", "", "GlassFrame"}};
}

std::vector<UniformBlock> motion_records() {
  return {record<Wiper>("Wiper", {member<&Wiper::previous_inner>("previous_inner", "1", "Inner end before the step, glass coordinates."),
                                  member<&Wiper::previous_outer>("previous_outer", "1", "Outer end before the step."),
                                  member<&Wiper::inner>("inner", "1", "Inner end after it."),
                                  member<&Wiper::outer>("outer", "1", "Outer end after it."),
                                  member<&Wiper::pivot>("pivot", "m", "Plane coordinates."),
                                  member<&Wiper::inner_radius>("inner_radius", "m", "Of the inner end, from the pivot."),
                                  member<&Wiper::outer_radius>("outer_radius", "m", "Of the outer end."),
                                  member<&Wiper::previous_axis>("previous_axis", "1", "Cosine and sine of the blade's angle before the step."),
                                  member<&Wiper::axis>("axis", "1", "The same after it."),
                                  member<&Wiper::half_width>("half_width", "m", "Half the width that the blade wipes."),
                                  member<&Wiper::rate>("rate", "rad/s", "Turned angle over the time that the record stands for."),
                                  member<&Wiper::direction>("direction", "1", "Sign of rate; 0 at rest.")}),
          record<GlassFrame>("GlassFrame", {member<&GlassFrame::gravity>("gravity", "1/s^2", "as-published: gravity; corrected: specific force at (0, 0)."),
                                            member<&GlassFrame::wind>("wind", "1/s", "Apparent wind."),
                                            member<&GlassFrame::acceleration>("acceleration", "1/s^2", "as-published: acceleration of the car; corrected: 0."),
                                            row(offsetof(GlassFrame, spin), 0, "spin_u", "1/s^2", "corrected: u of the specific force, by u and v of the place."),
                                            row(offsetof(GlassFrame, spin), 1, "spin_v", "1/s^2", "corrected: v of it."),
                                            row(offsetof(GlassFrame, coriolis), 0, "coriolis_u", "1/s", "corrected: u of the specific force, by u and v of the velocity."),
                                            row(offsetof(GlassFrame, coriolis), 1, "coriolis_v", "1/s", "corrected: v of it."),
                                            member<&GlassFrame::id>("id", "1", "0.")})};
}

}  // namespace rainref::windshield
