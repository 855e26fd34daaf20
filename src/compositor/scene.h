// A scene for rays: surfaces with materials, and the surroundings.
//
// The radiance of a ray is basic radiance, L / n^2, which does not change when light passes from one medium to another.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "compositor/surface.h"
#include "compositor/tracer.h"
#include "math/constants.h"

namespace rainref::compositor {

/// The medium between surfaces. After s metres light L has become t L + (1 - t) glow, t = exp(-extinction s).
struct Medium {
  double ior = 1;           ///< index of refraction, at least 1
  Vec extinction{0, 0, 0};  ///< for red, green and blue [1/m]
  Vec glow{0, 0, 0};        ///< radiance of an infinite path: light that turbid water or fog scatters toward the eye
  bool is_film = false;     ///< its paths count in `film`
};
inline Medium air() { return {}; }
inline Medium water(double ior = water_refractive_index) { return {ior, {0, 0, 0}, {0, 0, 0}, true}; }
inline Medium glass(double ior = 1.52) { return {ior, {0, 0, 0}, {0, 0, 0}, false}; }

/// A hit of a ray on a surface.
struct Place {
  Vec point;        ///< [m]
  Vec direction;    ///< of the ray, unit
  Vec normal;       ///< unit, geometric, on the outside of the surface
  double distance;  ///< [m] along the ray and the previous rays, from the eye
  Hit hit;
};

/// Places component by component. Arrays are padded to whole lanes; the last hit is repeated.
struct Places {
  std::size_t count;
  VecArrays point, direction, normal;
  const double* distance;
  const Hit* hits;
  std::size_t size() const { return count; }
  Place operator[](std::size_t i) const { return {point[i], direction[i], normal[i], distance[i], hits[i]}; }
};
/// Unit normals of the places; as for a Surface, whole lanes may be written.
using NormalsOf = std::function<void(const Places& places, const VecArraysOut& normals)>;
/// From a function of one place.
NormalsOf normals_of(std::function<Vec(const Place&)> normal);

/// Light from an opaque surface toward the ray: its own, and the reflection of one more ray.
struct Finish {
  Vec radiance{0, 0, 0};       ///< emitted, or scattered by a diffuse surface
  Vec mirror{0, 0, 0};         ///< share of the reflected ray's radiance; 0: no reflected ray
  Vec mirror_normal{0, 0, 0};  ///< unit normal of the reflection
  double blur = 0;             ///< mip level of the lookup of the reflected surroundings
};
/// Finishes component by component; whole lanes may be written.
struct Finishes {
  VecArraysOut radiance, mirror, mirror_normal;
  double* blur;
  void put(std::size_t i, const Finish& f) const {
    radiance.put(i, f.radiance);
    mirror.put(i, f.mirror);
    mirror_normal.put(i, f.mirror_normal);
    blur[i] = f.blur;
  }
};
class Opaque {
 public:
  virtual ~Opaque() = default;
  /// Sets the i-th of `finishes` to that of places[i]. Thread-safe; a pure function of each place.
  virtual void finish(const Places& places, const Finishes& finishes) const = 0;
};

/// How a surface treats light. Without `opaque` it is a smooth interface between two media; only this struct says which medium is on which
/// side.
struct Material {
  std::shared_ptr<const Opaque> opaque;
  Medium outside, inside;  ///< on the side of the geometric normal, and on the other side
  /// The unit smooth normals of an interface that is made of facets, near Place::normal; null: the geometric normals. If a smooth normal
  /// would send a ray through the wrong side of the facet, the geometric one is used.
  NormalsOf smooth_normals;
  bool is_masked = false;  ///< the channel `mask` is 1 where the eye sees this surface, or looks through it

  static Material interface_of(const Medium& outside, const Medium& inside) {
    Material m;
    m.outside = outside;
    m.inside = inside;
    return m;
  }
  static Material of(std::shared_ptr<const Opaque> opaque) {
    Material m;
    m.opaque = std::move(opaque);
    return m;
  }
};

/// The smooth normal at one place of a material that has them.
Vec smooth_normal(const Material& material, const Place& place);

/// An opaque finish from a function of one place.
std::shared_ptr<const Opaque> opaque_of(std::function<Finish(const Place&)> finish);
/// Emits equally from both sides in every direction; reflects nothing.
std::shared_ptr<const Opaque> emitter(const Vec& radiance);

/// A ray that left the scene.
struct EscapedRay {
  Vec origin, direction;  ///< direction unit
  double blur = 0;        ///< mip level: 0 sharp; each level is twice as blurred
};
/// Escaped rays component by component. Arrays are padded to whole lanes by repeating the last one.
struct EscapedRays {
  std::size_t count;
  VecArrays origin, direction;
  const double* blur;
  std::size_t size() const { return count; }
  EscapedRay operator[](std::size_t i) const { return {origin[i], direction[i], blur[i]}; }
};
class Environment {
 public:
  virtual ~Environment() = default;
  /// Sets radiance[i] to the light that arrives along ray i. Thread-safe; a pure function of each ray.
  virtual void radiance(const EscapedRays& escaped_rays, std::span<Vec> radiance) const = 0;
};
/// Surroundings from a function of one escaped ray.
std::shared_ptr<const Environment> environment_of(std::function<Vec(const EscapedRay&)> radiance);

/// Surfaces with their materials, within surroundings.
class Scene {
 public:
  explicit Scene(const TracerOptions& options = {}) : tracer_(options) {}

  /// Returns the surface's number.
  std::uint32_t add(std::shared_ptr<const Surface> surface, Material material);
  void set_environment(std::shared_ptr<const Environment> environment) { environment_ = std::move(environment); }
  /// The medium at the eye.
  void set_eye(const Medium& medium) { eye_ = medium; }
  /// Call before the first ray, and after surfaces were added or changed.
  void commit() { tracer_.commit(); }

  const Tracer& tracer() const { return tracer_; }
  std::uint32_t surfaces() const { return static_cast<std::uint32_t>(materials_.size()); }
  const Material& material(std::uint32_t surface) const { return materials_[surface]; }
  /// Throws Error(internal) if none was set.
  const Environment& environment() const;
  const Medium& eye() const { return eye_; }

 private:
  Tracer tracer_;
  std::vector<Material> materials_;
  std::shared_ptr<const Environment> environment_;
  Medium eye_;
};

}  // namespace rainref::compositor
