// Wipers: where the blades are, and what they sweep in a step.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "math/constants.h"
#include "windshield/motion/glass.h"
#include "windshield/uniforms.h"

namespace rainref::windshield {

/// Cycles, forth and back, since time 0; at a whole number the blades are where they were then. Of key frames
///   "time off; time intermittent PERIOD; time slow; time fast"                                           [s]
/// each holds until the next, and what the first says from time 0 on. slow and fast run on from wherever the blades are. Where they are to
/// stop they complete the stroke that they are in, as fast as they were; intermittent begins one at its own time and every PERIOD
/// seconds from there, and a period shorter than a stroke is slow.
class WiperMotion {
 public:
  /// slow, fast: cycles in a minute. Throws Error(usage) naming the key ("wipers.key_frames" of the table "wipers") and the row: none,
  /// another word, a period that is not above 0 and at most 3600 s, times below 0 or that do not ascend.
  WiperMotion(std::string_view key_frames, double slow, double fast, std::string_view table = "wipers");

  double cycles(double t) const;
  /// The times in (from, to) at which they begin, stop or run at another rate, ascending.
  std::vector<double> changes(double from, double to) const;

 private:
  struct Part {
    double from, cycles, rate;  ///< rate in cycles a second
    double period;              ///< 0: on and on; else one cycle at each of from + k period
  };
  std::size_t part_at(double t) const;
  std::vector<Part> parts_;
};

/// One blade. Its angle counts from the plane's x axis toward y; it rests at start_angle and sweeps to start_angle +
/// sweep and back:
///   angle(t) = start_angle + sweep / 2 (1 - cos(2 pi (cycles(t) + phase))),  cycles(t) = t cycles_per_minute / 60 without key frames.
struct Blade {
  Real2 pivot;                        ///< plane coordinates [m]
  double inner_radius, outer_radius;  ///< of the blade's ends [m]
  double start_angle, sweep;          ///< [rad]; a negative sweep turns clockwise
  double phase;                       ///< of its cycle, at time 0
};

constexpr int most_wipers = 2;
/// Made for a glass of 1.4 m x 0.8 m.
constexpr std::array<Blade, most_wipers> tandem_blades{
    {{{0.12, -0.06}, 0.18, 0.8, 4 * degree, 91 * degree, 0}, {{0.71, -0.06}, 0.14, 0.68, 4 * degree, 104 * degree, 0}}};

struct WiperSettings {
  std::vector<Blade> blades;
  double cycles_per_minute = 45;
  double half_width = 0.008;         ///< of a blade [m]
  std::optional<WiperMotion> keyed;  ///< instead of cycles_per_minute all the time
};

/// The first `count` blades of an arrangement, "tandem" or "opposed", the driver's (left) one first. Both are made for
/// a glass of 1.4 m x 0.8 m, on which two of them clear more than EU 1008/2010 asks: 98 % of vision area A, 80 % of
/// area B. On another glass the pivots move with its sides and the radii follow the smaller ratio.
std::vector<Blade> arranged_blades(std::string_view arrangement, int count, const Glass& glass);

/// Throws Error(usage) naming the key ("wipers.sweep_0" for the first blade of the table "wipers"), what is expected and what was found: a
/// sweep of 0 or beyond 170 degrees, a blade without length or longer than the glass, an inner end nearer to the pivot
/// than two half widths and 10 mm of drop.
void check(const WiperSettings& settings, const Glass& glass, std::string_view table = "wipers");

double wiper_angle(const Blade& blade, double cycles_per_minute, double t);

/// What the blades sweep from time `from` to time `to`, one after the other, in order of time. corrected: a record for
/// each part between reversals and changes of rate, so that together they hold every angle that was passed; as published: one record from
/// the first angle to the last, whatever lies between. The axes of a record begin with the bits in which those of the
/// record before ended. A blade at rest has direction 0.
std::vector<Wiper> wipers_between(const WiperSettings& settings, const PlaneFrame& plane, double from, double to, bool corrected);

/// The blades at time t at rest, previous = current: the step before the first frame.
std::vector<Wiper> wipers_at(const WiperSettings& settings, const PlaneFrame& plane, double t);

}  // namespace rainref::windshield
