#include "compositor/scene.h"

#include <algorithm>

#include "rainref/error.h"

namespace rainref::compositor {
namespace {

class OpaqueFunction : public Opaque {
 public:
  explicit OpaqueFunction(std::function<Finish(const Place&)> finish) : finish_(std::move(finish)) {}
  void finish(const Places& places, const Finishes& finishes) const override {
    for (std::size_t i = 0; i < places.size(); ++i) finishes.put(i, finish_(places[i]));
  }

 private:
  std::function<Finish(const Place&)> finish_;
};

class EnvironmentFunction : public Environment {
 public:
  explicit EnvironmentFunction(std::function<Vec(const EscapedRay&)> radiance) : radiance_(std::move(radiance)) {}
  void radiance(const EscapedRays& escaped_rays, std::span<Vec> out) const override {
    for (std::size_t i = 0; i < escaped_rays.size(); ++i) out[i] = radiance_(escaped_rays[i]);
  }

 private:
  std::function<Vec(const EscapedRay&)> radiance_;
};

}  // namespace

NormalsOf normals_of(std::function<Vec(const Place&)> normal) {
  return [of = std::move(normal)](const Places& places, const VecArraysOut& normals) {
    for (std::size_t i = 0; i < places.size(); ++i) normals.put(i, of(places[i]));
  };
}

Vec smooth_normal(const Material& material, const Place& place) {
  Columns<13> room;
  room.make_room(1);
  Hit hits[most_lanes];
  std::fill(hits, hits + most_lanes, place.hit);
  room.vectors(0).put(0, place.point);
  room.vectors(3).put(0, place.direction);
  room.vectors(6).put(0, place.normal);
  room[9][0] = place.distance;
  const VecArraysOut normals = room.vectors(10);
  material.smooth_normals({1, room.vectors(0), room.vectors(3), room.vectors(6), room[9], hits}, normals);
  return normals[0];
}

std::shared_ptr<const Opaque> opaque_of(std::function<Finish(const Place&)> finish) {
  return std::make_shared<OpaqueFunction>(std::move(finish));
}
std::shared_ptr<const Opaque> emitter(const Vec& radiance) {
  return opaque_of([radiance](const Place&) {
    Finish f;
    f.radiance = radiance;
    return f;
  });
}

std::shared_ptr<const Environment> environment_of(std::function<Vec(const EscapedRay&)> radiance) {
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
