#include "compositor/scene.h"

#include "rainref/error.h"

namespace rainref::compositor {
namespace {

class OpaqueFunction : public Opaque {
 public:
  explicit OpaqueFunction(std::function<Finish(const Place&)> finish) : finish_(std::move(finish)) {}
  void finish(std::span<const Place> places, std::span<Finish> finishes) const override {
    for (std::size_t i = 0; i < places.size(); ++i) finishes[i] = finish_(places[i]);
  }

 private:
  std::function<Finish(const Place&)> finish_;
};

class EnvironmentFunction : public Environment {
 public:
  explicit EnvironmentFunction(std::function<Vec(const Sight&)> radiance) : radiance_(std::move(radiance)) {}
  void radiance(std::span<const Sight> sights, std::span<Vec> out) const override {
    for (std::size_t i = 0; i < sights.size(); ++i) out[i] = radiance_(sights[i]);
  }

 private:
  std::function<Vec(const Sight&)> radiance_;
};

}  // namespace

std::shared_ptr<const Opaque> opaque_of(std::function<Finish(const Place&)> finish) {
  return std::make_shared<OpaqueFunction>(std::move(finish));
}
std::shared_ptr<const Opaque> diffuse(const Vec& albedo, const Vec& light) { return emitter(albedo * light); }
std::shared_ptr<const Opaque> emitter(const Vec& radiance) {
  return opaque_of([radiance](const Place&) {
    Finish f;
    f.radiance = radiance;
    return f;
  });
}

std::shared_ptr<const Environment> environment_of(std::function<Vec(const Sight&)> radiance) {
  return std::make_shared<EnvironmentFunction>(std::move(radiance));
}

std::uint32_t Scene::add(std::shared_ptr<const Surface> surface, Material material) {
  const std::uint32_t number = tracer_.add(std::move(surface));
  materials_.resize(number + 1);
  materials_[number] = std::move(material);
  return number;
}

const Environment& Scene::environment() const {
  if (!environment_) throw Error(ExitCode::internal, "a scene without surroundings was shaded");
  return *environment_;
}

}  // namespace rainref::compositor
