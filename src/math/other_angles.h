// Angles by other formulas than atan2. An engineer who knows that a point lies on the unit circle writes asin or acos of a coordinate;
// real arithmetic makes no difference, floats do: near the ends of their domain both lose half of their digits.
#pragma once

namespace rainref::enclosed {

/// While it lives, the calling thread's enclosures take atan2(y, x) by any of
///   atan2(y, x),   acos(x / r) with the sign of y,   asin(y / r) where x >= 0,   r = sqrt(x x + y y),
///   asin(y) and pi/2 - acos(y) where x >= 0 and r is 1 but for rounding:
/// the hull. It words a failure; nothing is accepted by it.
class OtherAngles {
 public:
  OtherAngles();
  ~OtherAngles();
  OtherAngles(const OtherAngles&) = delete;
  OtherAngles& operator=(const OtherAngles&) = delete;

 private:
  bool before_;
};

}  // namespace rainref::enclosed
