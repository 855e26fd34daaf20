// A pass that computes angles by asin or acos: an AlternativeFormula for lookups by direction.
#pragma once

#include <utility>

#include "capture/pass_model.h"
#include "math/other_angles.h"

namespace rainref::capture {

/// A model whose enclosures hold every formula for an angle (OtherAngles). Its other evaluations are the pass's own.
class ByOtherAngles : public PassModel {
 public:
  explicit ByOtherAngles(std::unique_ptr<PassModel> of) : PassModel(of->width(), of->height(), of->values()), of_(std::move(of)) {}
  void evaluate(int x, int y, scalar::Scalar<float>* out) const override { of_->evaluate(x, y, out); }
  void evaluate(int x, int y, scalar::Scalar<double>* out) const override { of_->evaluate(x, y, out); }
  void evaluate(int x, int y, perturbed::Perturbed* out) const override { of_->evaluate(x, y, out); }
  void enclose(int x, int y, const float* port, enclosed::Enclosure* out) const override {
    const enclosed::OtherAngles any;
    of_->enclose(x, y, port, out);
  }
  bool needs_port() const override { return of_->needs_port(); }
  bool rounds_inside() const override { return of_->rounds_inside(); }
  std::optional<std::array<double, 2>> free_range(int value) const override { return of_->free_range(value); }
  std::optional<double> extent(int value) const override { return of_->extent(value); }

 private:
  std::unique_ptr<PassModel> of_;
};

/// `bind` is the pass's own.
template <std::unique_ptr<PassModel> (*bind)(const PassCase&)>
AlternativeFormula by_other_angles() {
  return {"asin or acos for atan2",
          "an angle of a direction is the asin or acos of a component, which loses digits near its ends; the pass has atan2, and the "
          "profile bounds that",
          [](const PassCase& c) -> std::unique_ptr<PassModel> { return std::make_unique<ByOtherAngles>(bind(c)); }};
}

}  // namespace rainref::capture
