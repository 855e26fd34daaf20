// A pass bound to one case, read with every number: what conformance judges by, and all it knows of an effect.
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

/// The invocations of a pass on a case: width() x height() of them, each giving values() numbers, which are the channels
/// of the outputs at its texel, output after output. The case must outlive the model. Evaluation is thread-safe.
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
  /// Under the profile and the enumeration in force. `port` holds the values that the port stored for this invocation: a pass
  /// whose result is judged by what it must satisfy (a march by the gap at its end) may take them, others do not.
  virtual void enclose(int x, int y, const float* port, enclosed::Enclosure* out) const = 0;
  /// How many parts of what enclose() gives are found sooner, the quickest first.
  virtual int parts() const { return 0; }
  /// One of them: what lies in it lies in one alternative of enclose(). False where there is none for this invocation.
  virtual bool enclose_part(int /*part*/, int, int, const float*, enclosed::Enclosure*) const { return false; }
  /// As enclose(), of every rearrangement that the profile in force allows. False where the pass has no such evaluation: it is
  /// judged as it is written.
  virtual bool rearrange(int, int, const float*, enclosed::Enclosure*) const { return false; }
  /// Whether enclose() depends on `port`: on values alone that are the same however halves are rounded, as floats and flags.
  virtual bool needs_port() const { return false; }
  /// Whether the pass itself rounds to binary16 on its way, as its outputs are stored.
  virtual bool rounds_inside() const { return false; }
  /// Whether an invocation meets those records alone that may count near its texel.
  virtual bool chooses_records() const { return false; }
  /// Of a value that is declared as not reproducible (a count of steps) the least and the most that it may be: it is held
  /// to them, no more. Nothing for others.
  virtual std::optional<std::array<double, 2>> free_range(int) const { return std::nullopt; }
  bool is_free(int value) const { return free_range(value).has_value(); }
  /// Of a value that has another range in each case (a place among so many texels) the extent of that; nothing for others, whose
  /// output declares it.
  virtual std::optional<double> extent(int) const { return std::nullopt; }
  /// Of an output of Judge::keyed; null: its records are judged by bits.
  virtual const KeyedModel* keyed(std::string_view) const { return nullptr; }
  /// The input whose decoded texels these are; "" where the pass does not know.
  virtual std::string_view input_of(const float*) const { return ""; }

 private:
  int width_, height_, values_;
};

/// The model of a pass that is one template over its number: Pass has width, height, values and
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

/// A pass that gives one keyed list and no image.
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

/// Another formula of what a pass computes, equal in real arithmetic: engineers write it, and a port of it is told so.
struct AlternativeFormula {
  std::string name;                                     ///< "asin for the height of a direction"
  std::string sentence;                                 ///< what stands in the port, and what the pass has
  std::unique_ptr<PassModel> (*bind)(const PassCase&);  ///< as PassEvaluations::bind; null where the case has no use for it
};

/// How an effect offers its passes to be judged.
struct PassEvaluations {
  std::string pass;
  /// Null where no output is judged by envelope.
  /// Throws Error(port_files) when the case lacks an input or has one of another shape.
  std::unique_ptr<PassModel> (*bind)(const PassCase&);
  /// The reference's outputs, in the order of c.outputs, where they are judged by bits, keyed records without a model in
  /// any order; else null. Throws like bind.
  std::vector<Array> (*recompute)(const PassCase&) = nullptr;
  /// Why what the host derived from the other inputs cannot belong to them, or ""; null where nothing is derived.
  std::string (*doubt)(const PassCase&) = nullptr;
  std::vector<AlternativeFormula> alternatives = {};
  /// Uniforms and inputs of the host that it makes of the run's own state: a port's are its own, and no scene says them.
  std::vector<std::string> of_state = {};
};

}  // namespace rainref::capture
