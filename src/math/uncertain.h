// Values in memory that are known only as intervals.
#pragma once

#include <memory>
#include <vector>

namespace rainref::enclosed {

/// The interval of each value of an array, in the order of the values. Both ends infinite: nothing is known of it.
struct Uncertain {
  std::vector<float> low, high;
};

/// While it lives, Enclosure::load() of a value of an array gives that value's interval, in every thread. Other numbers read the value
/// itself.
class UncertainValues {
 public:
  /// `first`: the array, with as many values as `of`. It must outlive this.
  UncertainValues(const float* first, std::shared_ptr<const Uncertain> of);
  ~UncertainValues();
  UncertainValues(const UncertainValues&) = delete;
  UncertainValues& operator=(const UncertainValues&) = delete;

 private:
  const float* first_;
};

}  // namespace rainref::enclosed
