// A pass bound to one case, evaluated with every number type. It is all that judging knows of an effect.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "capture/keyed_model.h"
#include "capture/pass_case.h"
#include "math/perturbed.h"
#include "math/enclosure.h"
#include "math/rearranged.h"
#include "math/scalar.h"

namespace rainref::capture {

/// The invocations of a pass on a case: width() x height() of them, each with values() numbers, the channels of the outputs at its texel,
/// output after output. The case must outlive the model. Evaluation is thread-safe.
class PassModel {
 public:
  PassModel(int width, int height, int values) : width_(width), height_(height), values_(values) {}
  virtual ~PassModel() = default;
  int width() const { return width_; }
  int height() const { return height_; }
  int values() const { return values_; }

  virtual void evaluate(int x, int y, scalar::Scalar<float>* out) const = 0;
  virtual void evaluate(int x, int y, scalar::Scalar<double>* out) const = 0;
  virtual void evaluate(int x, int y, perturbed::Perturbed* out) const = 0;
  /// Evaluates under the active profile and enumeration. `port` holds the port's stored values of this invocation. A pass whose result is
  /// judged by a condition (a march by the gap at its end) may use them; others do not.
  virtual void enclose(int x, int y, const float* port, enclosed::Enclosure* out) const = 0;
  /// Number of parts of enclose() that are faster to evaluate, the fastest first.
  virtual int parts() const { return 0; }
  /// Evaluates one part: values inside it are inside one alternative of enclose(). False if this invocation has no such part.
  virtual bool enclose_part(int /*part*/, int, int, const float*, enclosed::Enclosure*) const { return false; }
  /// Like enclose(), for every rearrangement that the active profile allows. False if the pass has no such evaluation: it is then judged as
  /// written.
  virtual bool rearrange(int, int, const float*, enclosed::Enclosure*) const { return false; }
  /// True if enclose() depends on `port`, and only on values that do not depend on the rounding of halves, such as floats and flags.
  virtual bool needs_port() const { return false; }
  /// True if the pass itself rounds to binary16 between its operations, like its outputs' stores.
  virtual bool rounds_inside() const { return false; }
  /// True if an invocation evaluates only records that may contribute near its texel.
  virtual bool chooses_records() const { return false; }
  /// The minimum and maximum of a value that is declared as not reproducible (a step count); nothing else about it is checked. Nothing for
  /// other values.
  virtual std::optional<std::array<double, 2>> free_range(int) const { return std::nullopt; }
  bool is_free(int value) const { return free_range(value).has_value(); }
  /// The extent of a value whose range depends on the case (a position among texels); nothing for others, whose output declares it.
  virtual std::optional<double> extent(int) const { return std::nullopt; }
  /// The model of an output of Judge::keyed; null: its records are judged by bits.
  virtual const KeyedModel* keyed(std::string_view) const { return nullptr; }
  /// The input with these decoded texels; "" if unknown.
  virtual std::string_view input_of(const float*) const { return ""; }

 private:
  int width_, height_, values_;
};

/// The model of a pass that is one template over its number type: Pass has width, height, values and
///   template <class N> void operator()(int x, int y, N* out) const.
template <class Pass>
class ModelOf : public PassModel {
 public:
  explicit ModelOf(Pass pass) : PassModel(pass.width, pass.height, pass.values), pass_(std::move(pass)) {}
  void evaluate(int x, int y, scalar::Scalar<float>* out) const override { pass_(x, y, out); }
  void evaluate(int x, int y, scalar::Scalar<double>* out) const override { pass_(x, y, out); }
  void evaluate(int x, int y, perturbed::Perturbed* out) const override { pass_(x, y, out); }
  void enclose(int x, int y, const float*, enclosed::Enclosure* out) const override { pass_(x, y, out); }
  bool rearrange(int x, int y, const float*, enclosed::Enclosure* out) const override {
    std::vector<enclosed::Rearranged> all(static_cast<std::size_t>(values()));
    pass_(x, y, all.data());
    for (const enclosed::Rearranged& r : all) *out++ = r.settled();
    return true;
  }
  std::string_view input_of(const float* texel) const override {
    if constexpr (requires { pass_.input_of(texel); }) return pass_.input_of(texel);
    return "";
  }

 protected:
  const Pass& pass() const { return pass_; }

 private:
  Pass pass_;
};
template <class Pass>
std::unique_ptr<PassModel> model_of(Pass pass) {
  return std::make_unique<ModelOf<Pass>>(std::move(pass));
}

/// A pass with one keyed list as output and no image.
class ListPass : public PassModel {
 public:
  ListPass(std::string output, std::unique_ptr<KeyedModel> list) : PassModel(0, 0, 0), output_(std::move(output)), list_(std::move(list)) {}
  void evaluate(int, int, scalar::Scalar<float>*) const override {}
  void evaluate(int, int, scalar::Scalar<double>*) const override {}
  void evaluate(int, int, perturbed::Perturbed*) const override {}
  void enclose(int, int, const float*, enclosed::Enclosure*) const override {}
  const KeyedModel* keyed(std::string_view output) const override { return output == output_ ? list_.get() : nullptr; }

 private:
  std::string output_;
  std::unique_ptr<KeyedModel> list_;
};

/// Another formula for a pass's result, equal in real arithmetic. Engineers use it; if a port does, the report says so.
struct AlternativeFormula {
  std::string name;                                     ///< "asin for the height of a direction"
  std::string sentence;                                 ///< what the port contains, and what the pass contains
  std::unique_ptr<PassModel> (*bind)(const PassCase&);  ///< as PassEvaluations::bind; null if it does not apply to the case
};

/// An effect's evaluations of a pass for judging.
struct PassEvaluations {
  std::string pass;
  /// Null if no output is judged by envelope. Throws Error(port_files) if the case lacks an input or has one of another shape.
  std::unique_ptr<PassModel> (*bind)(const PassCase&);
  /// Returns the reference's outputs, in the order of c.outputs, if they are judged by bits; keyed records without a model are in any
  /// order. Else null. Throws like bind.
  std::vector<Array> (*recompute)(const PassCase&) = nullptr;
  /// Explains why an input that the host derived from other inputs cannot belong to them, or returns ""; null if nothing is derived.
  std::string (*doubt)(const PassCase&) = nullptr;
  std::vector<AlternativeFormula> alternatives = {};
  /// Uniforms and host inputs that depend on the run's own state: a port has its own values, and no scene determines them.
  std::vector<std::string> of_state = {};
};

}  // namespace rainref::capture
