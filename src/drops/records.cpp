#include "drops/records.h"

#include "capture/keyed_model.h"
#include "scene/uniform_block.h"

namespace rainref::drops {

using scene::member;

scene::UniformBlock Drop::layout() {
  return scene::record<Drop>(
      {member<&Drop::position>("1", "Glass coordinates u, v."), member<&Drop::velocity>("1/s", "Change of the position."),
       member<&Drop::mass>("1", "as-published: 1 is an ordinary drop; corrected: whole mass units of 2e-11 kg, at most 2^24."),
       member<&Drop::life>("s", "What remains; not above 0: no drop."),
       member<&Drop::id>("1", "Its own for ever, ascending in the order of birth.")});
}
const std::vector<capture::FieldRange>& Drop::ranges(bool corrected) {
  // Position on the glass; crossing it in a second; twice the mass of a usual drop; its life.
  static const std::vector<capture::FieldRange> published{{"position", 0, 1}, {"velocity", -1, 1}, {"mass", 0, 2}, {"life", 0, 6}};
  // 2^16 mass units are 1.3 mg, a drop of 1.4 mm.
  static const std::vector<capture::FieldRange> correct{{"position", 0, 1}, {"velocity", -1, 1}, {"mass", 0, 0x1p16}, {"life", 0, 600}};
  return corrected ? correct : published;
}

scene::UniformBlock GlassFrame::layout() {
  return scene::record<GlassFrame>(
      {member<&GlassFrame::gravity>("1/s^2", "as-published: gravity; corrected: specific force at (0, 0), the car's motion included."),
       member<&GlassFrame::wind>("1/s", "Apparent wind."),
       member<&GlassFrame::acceleration>("1/s^2", "as-published: of the vehicle; corrected: 0."), member<&GlassFrame::id>("1", "0."),
       member<&GlassFrame::spin>("1/s^2", "corrected: specific force per glass coordinate, rows u and v."),
       member<&GlassFrame::coriolis>("1/s", "corrected: specific force per velocity, rows u and v.")});
}
const std::vector<capture::FieldRange>& GlassFrame::ranges(bool) {
  // For a glass of a metre: the acceleration of gravity, the wind at 72 km/h, a turn of one radian per second.
  static const std::vector<capture::FieldRange> all{
      {"gravity", -10, 10}, {"wind", -20, 20}, {"acceleration", -10, 10}, {"spin", -1, 1}, {"coriolis", -2, 2}};
  return all;
}

scene::UniformBlock Neck::layout() {
  return scene::record<Neck>(
      {member<&Neck::offset>("1", "From the larger drop's middle to the smaller one's, in plane axes, over the base radius of both."),
       member<&Neck::share>("1", "Of the smaller one in the mass of both."),
       member<&Neck::left>("1", "1 when they became one, falling; not above 0: none."),
       member<&Neck::id>("1", "Of the drop that they are.")});
}
const std::vector<capture::FieldRange>& Neck::ranges(bool) {
  // The distance of two touching drops is at most 2^(2/3).
  static const std::vector<capture::FieldRange> all{{"offset", -1.6, 1.6}, {"share", 0, 0.5}, {"left", 0, 1}};
  return all;
}

}  // namespace rainref::drops
