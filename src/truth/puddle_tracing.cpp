#include "puddle/instance.h"
#include "rainref/error.h"
#include "truth/puddle_scene.h"
#include "truth/tracing.h"

namespace rainref::truth {
namespace {

bool is_street(const scene::Config& config) {
  if (config.text("compositor.surroundings") != "street") return false;
  if (!config.text("environment.image").empty()) {
    throw Error(ExitCode::usage,
                "compositor.surroundings: expected \"picture\", for environment.image names one; \"street\" is the street made here");
  }
  return true;
}

class PuddleTracing : public Tracing {
 public:
  PuddleTracing(const scene::Config& config, const puddle::Instance& puddle, const parallel::Executor& on)
      : Tracing(choice_from(config), on),
        puddle_(puddle),
        scene_(puddle.settings(), puddle.surroundings(), {choice().tracer, is_street(config), choice().picture.samples}, on) {}

  Comparison compare() override {
    scene_.update(puddle_.running(), executor());
    return truth::compare(puddle_.running(), puddle_.settings(), scene_, choice().picture.shading, executor());
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
  return {
      "puddle",
      [] {
        std::vector<scene::Parameter> all = parameters();
        all.push_back(scene::choice("compositor.surroundings", {"picture", "street"}, "picture",
                                    "What a traced ray sees beyond the puddle: the passes' picture of the surroundings, or the street "
                                    "made here, ray by ray.")
                          .only("corrected"));
        return all;
      },
      [](const scene::Config& config, const effect::Instance& instance, const parallel::Executor& executor) -> std::unique_ptr<Tracing> {
        const auto& puddle = static_cast<const puddle::Instance&>(instance);
        if (puddle.settings().variant != Variant::corrected) return nullptr;
        return std::make_unique<PuddleTracing>(config, puddle, executor);
      },
      hold_traced};
}

}  // namespace rainref::truth
