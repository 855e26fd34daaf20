#include "drops/ranges.h"

namespace rainref::drops {

const std::vector<capture::FieldRange>& drop_ranges(bool corrected) {
  // The glass; one that is crossed in a second; twice the mass of an ordinary drop; its life.
  static const std::vector<capture::FieldRange> published{{"position", 0, 1}, {"velocity", -1, 1}, {"mass", 0, 2}, {"life", 0, 6}};
  // 2^16 mass units are 1.3 mg, a drop of 1.4 mm.
  static const std::vector<capture::FieldRange> correct{{"position", 0, 1}, {"velocity", -1, 1}, {"mass", 0, 0x1p16}, {"life", 0, 600}};
  return corrected ? correct : published;
}

const std::vector<capture::FieldRange>& frame_ranges() {
  // On a glass of a metre: the acceleration of gravity, the wind of a drive at 72 km/h, a turn of one radian in a second.
  static const std::vector<capture::FieldRange> all{
      {"gravity", -10, 10}, {"wind", -20, 20}, {"acceleration", -10, 10}, {"spin", -1, 1}, {"coriolis", -2, 2}};
  return all;
}

}  // namespace rainref::drops
