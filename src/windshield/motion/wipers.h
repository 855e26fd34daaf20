// Wipers: positions of the blades, and the areas that they sweep in a step.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "math/constants.h"
#include "windshield/motion/glass.h"
#include "windshield/uniforms.h"

namespace rainref::windshield {

/// Number of cycles, forth and back, since time 0; at a whole number the blades are in their initial position. Key frames
///   "time off; time intermittent PERIOD; time slow; time fast"                                           [s]
/// hold until the next one; the first holds from time 0 on. slow and fast continue from the current position. When the blades stop, they
/// complete the current stroke at the same speed. intermittent begins a cycle at its own time and every PERIOD seconds from then; a period
/// shorter than a stroke is slow.
class WiperMotion {
 public:
  /// slow, fast: cycles per minute. Throws Error(usage) with the key ("wipers.key_frames" for the table "wipers") and the row: no rows,
  /// another word, a period that is not above 0 and at most 3600 s, times below 0 or that do not ascend.
  WiperMotion(std::string_view key_frames, double slow, double fast, std::string_view table = "wipers");

  double cycles(double t) const;
  /// The times in (from, to) at which they begin, stop or change speed, ascending.
  std::vector<double> changes(double from, double to) const;

 private:
  struct Part {
    double from, cycles, rate;  ///< rate in cycles per second
    double period;              ///< 0: continuous; else one cycle at each of from + k period
  };
  std::size_t part_at(double t) const;
  std::vector<Part> parts_;
};

/// One blade. Its angle is measured from the plane's x axis toward y. It rests at start_angle and sweeps to start_angle + sweep and back:
///   angle(t) = start_angle + sweep / 2 (1 - cos(2 pi (cycles(t) + phase))),  cycles(t) = t cycles_per_minute / 60 without key frames.
struct Blade {
  Real2 pivot;                        ///< plane coordinates [m]
  double inner_radius, outer_radius;  ///< of the blade's ends [m]
  double start_angle, sweep;          ///< [rad]; a negative sweep turns clockwise
  double phase;                       ///< phase of its cycle at time 0
};

constexpr int most_wipers = 2;
/// Designed for a glass of 1.4 m x 0.8 m.
constexpr std::array<Blade, most_wipers> tandem_blades{
    {{{0.12, -0.06}, 0.18, 0.8, 4 * degree, 91 * degree, 0}, {{0.71, -0.06}, 0.14, 0.68, 4 * degree, 104 * degree, 0}}};

struct WiperSettings {
  std::vector<Blade> blades;
  double cycles_per_minute = 45;
  double half_width = 0.008;         ///< of a blade [m]
  std::optional<WiperMotion> keyed;  ///< used instead of the constant cycles_per_minute
};

/// The first `count` blades of an arrangement, "tandem" or "opposed", the driver's (left) one first. Both are designed for a glass of 1.4 m
/// x 0.8 m, on which two blades clear more than the 98 % of vision area A and 80 % of area B that EU 1008/2010 requires. On another glass
/// the pivots move with its sides and the radii are scaled by the smaller ratio.
std::vector<Blade> arranged_blades(std::string_view arrangement, int count, const Glass& glass);

/// Throws Error(usage) with the key ("wipers.sweep_0" for the first blade of the table "wipers"), expected and found: a sweep of 0 or
/// beyond 170 degrees, a blade without length or longer than the glass, an inner end closer to the pivot than two half widths and 10 mm for
/// a drop.
void check(const WiperSettings& settings, const Glass& glass, std::string_view table = "wipers");

double wiper_angle(const Blade& blade, double cycles_per_minute, double t);

/// The sweeps of the blades from time `from` to time `to`, blade by blade, in order of time. corrected: a record for each part between
/// reversals and changes of speed, so that together they contain every angle passed. as published: one record from the first angle to the
/// last, ignoring angles between. The axes of a record begin with exactly the bits of the end of the previous record. A blade at rest has
/// direction 0.
std::vector<Wiper> wipers_between(const WiperSettings& settings, const PlaneFrame& plane, double from, double to, bool corrected);

/// The blades at rest at time t, previous = current: the step before the first frame.
std::vector<Wiper> wipers_at(const WiperSettings& settings, const PlaneFrame& plane, double t);

}  // namespace rainref::windshield
