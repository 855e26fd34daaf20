#include "puddle/instance.h"
#include "rainref/error.h"
#include "truth/puddle_truth.h"
#include "truth/tracing.h"

namespace rainref::truth {
namespace {

/// Null where rays see the passes' picture.
std::shared_ptr<const scene::Scenery> street(const scene::Config& config, const effect::Inputs& inputs) {
  if (config.text("compositor.surroundings") != "street") return nullptr;
  if (!config.text("environment.image").empty()) {
    throw Error(ExitCode::usage,
                "compositor.surroundings: expected \"picture\", for environment.image names one; \"street\" is the street made here");
  }
  return effect::street_of(inputs, {});
}

class PuddleTracing : public Tracing {
 public:
  PuddleTracing(const scene::Config& config, const puddle::Instance& puddle, const effect::Inputs& inputs, const parallel::Executor& on)
      : Tracing(choice_from(config), on),
        puddle_(puddle),
        scene_(puddle.settings(), puddle.surroundings(), {choice().tracer, street(config, inputs), choice().picture.samples}, on) {}

  Comparison compare() override {
    scene_.update(puddle_.running(), executor());
    PuddleTruth t = truth::compare(puddle_.running(), puddle_.settings(), scene_, choice().picture.shading, executor());
    return {{{"pixels", t.pixels},
             {"water_in_both", t.water_in_both},
             {"water_in_passes_only", t.water_in_passes_only},
             {"water_in_truth_only", t.water_in_truth_only}},
            std::move(t.differences)};
  }

 private:
  Picture picture() override {
    scene_.update(puddle_.running(), executor());
    return trace_picture(scene_.scene(), scene_.camera(), puddle_.settings().width, puddle_.settings().height, choice().picture,
                         executor());
  }
  Image display(const Image& radiance) const override { return truth::display(puddle_.settings(), radiance, executor()); }

  const puddle::Instance& puddle_;
  PuddleScene scene_;
};

}  // namespace

EffectTracing puddle_tracing() {
  return {"puddle",
          [] {
            std::vector<scene::Parameter> all = parameters();
            all.push_back(scene::choice("compositor.surroundings", {"picture", "street"}, "picture",
                                        "What a traced ray sees beyond the puddle: the passes' picture of the surroundings, or the street "
                                        "made here, ray by ray.")
                              .only("corrected"));
            return all;
          },
          [](const scene::Config& config, const effect::Instance& instance, const effect::Inputs& inputs,
             const parallel::Executor& executor) -> std::unique_ptr<Tracing> {
            const auto& puddle = static_cast<const puddle::Instance&>(instance);
            if (puddle.settings().variant != Variant::corrected) return nullptr;
            return std::make_unique<PuddleTracing>(config, puddle, inputs, executor);
          },
          hold_traced};
}

}  // namespace rainref::truth
