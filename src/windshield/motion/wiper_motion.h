// How far the wipers' motor has come: off, intermittent, slow and fast over time.
#pragma once

#include <string_view>
#include <vector>

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

}  // namespace rainref::windshield
