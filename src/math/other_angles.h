// Angles by other formulas than atan2. If a point is known to lie on the unit circle, asin or acos of a coordinate may be used instead.
// They are equal in real arithmetic, but near the ends of their domain both lose half of the digits in float.
#pragma once

namespace rainref::enclosed {

/// During its lifetime the calling thread's enclosures of atan2(y, x) are the hull of these formulas, with r = sqrt(x x + y y):
///   atan2(y, x);   acos(x / r) with the sign of y;   asin(y / r) if x >= 0;
///   asin(y) and pi/2 - acos(y) if x >= 0 and r is 1 except for rounding.
/// It is used to describe a failure, never to accept a result.
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
