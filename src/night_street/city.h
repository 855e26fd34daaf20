// The objects of the street as plain data, drawn once from the seed and used by everything else.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <string_view>
#include <vector>

#include "night_street/compact_lights.h"
#include "night_street/hierarchy.h"
#include "night_street/light_map.h"
#include "night_street/night_street.h"
#include "night_street/noise.h"
#include "night_street/shapes.h"
#include "night_street/vec.h"

namespace rainref::night_street {

/// Fixed measures of the street, metres.
namespace plan {
inline constexpr double road_half_width = 4.5;
inline constexpr double kerb_height = 0.12;
inline constexpr double facade = 7.5;                             ///< |x| of the building line
inline constexpr double back = 22;                                ///< |x| where every building ends
inline constexpr double street_end = 290;                         ///< |z| of the last lot
inline constexpr double skyline = 330;                            ///< |z| of the silhouettes that close the view
inline constexpr double tallest = 40;                             ///< no building reaches this height
inline constexpr double ground_floor = 4.1;                       ///< height of the shop storey
inline constexpr std::array<double, 3> crossings{-22, 58, -118};  ///< z of the pedestrian crossings
inline constexpr double crossing_half_length = 1.9;
}  // namespace plan

struct Material {
  Vec albedo;
  Vec emission;
  double shine = 0;    ///< reflectance of the wet coat at normal incidence; 0 is matte
  bool glass = false;  ///< a car's cabin: dark glass in its windows
};

/// An illuminated text of tubes. Letters are 4 units wide with a pitch of 6, and 6 units tall.
struct Sign {
  std::string_view text;
  Vec colour;         ///< radiance of the tube's core
  bool upright;       ///< letters are stacked vertically
  double unit;        ///< size of one letter unit [m]
  Box board;          ///< metres; the text is on its two largest faces
  double brightness;  ///< share of the nominal brightness, [0, 1]
};

enum class Shop : std::uint8_t { glazed, cafe, shutter, entrance };

/// A building on one side of the street. Distances from the street's axis are |x|.
struct Lot {
  double z0, z1;  ///< extent along the street, z0 < z1
  double front;   ///< |x| of its facade
  double height;
  double storey;                       ///< height of one storey above the ground floor
  int bays;                            ///< window columns
  double window_width, window_height;  ///< share of the bay and of the storey
  double lit_share;                    ///< share of lit windows, [0, 1]
  int style;                           ///< 0 punched windows, 1 ribbon glazing, 2 tall sash pairs
  Shop shop;
  Vec wall;         ///< albedo
  Vec shop_light;   ///< radiance of the shop's interior
  int fascia = -1;  ///< index of the sign above the shop, or -1
  std::uint64_t id;
};

/// A light source for the light map and the haze: a small sphere, brighter along an axis.
struct Source {
  Vec position;
  Vec intensity;  ///< radiance x m^2 towards a viewer off the axis
  Vec axis;       ///< unit, or zero for none
  double gain;    ///< intensity on the axis / off the axis - 1
  int focus;      ///< the gain falls as cos^(2^focus) from the axis
  double radius;  ///< metres, for highlights
  bool compact;   ///< has its own highlight on wet asphalt and a halo in the haze
};

struct City {
  std::uint64_t seed;
  std::array<std::vector<Lot>, 2> lots;  ///< [0] x < 0, [1] x > 0; ascending z, gapless
  std::vector<Solid> solids;
  std::vector<Plane> planes;
  std::vector<Material> materials;
  std::vector<Sign> signs;
  std::vector<Source> sources;
  std::vector<Lamp> lamps;
  Hierarchy hierarchy;
  CompactLights lights;
  Noise clouds, clouds_large, puddles, asphalt, ripple, stain, skyline;

  City(std::uint64_t street_seed, bool clear_lane);
  /// Made on the first call, because a street with kept pictures (cache/kept_images.h) does not need it. Thread-safe.
  const LightMap& light() const;
  /// Makes it in advance, on all threads. light() does not use all threads, because a caller that waits there would run tiles of others,
  /// which might call it again.
  void light_up(const Rows& rows) const;
  double random(std::uint64_t object, Purpose purpose) const { return random01(seed, object, purpose); }
  int add_material(const Material& material);
  /// Adds a solid whose planes are already in `planes` from first_plane on, or that has no planes.
  void add(Solid solid, int material);
  void add_box(const Vec& low, const Vec& high, int material);
  void add_pole(const Vec& foot, double radius, double height, int material);
  void add_convex(const std::vector<Plane>& sides, const Box& bounds, int material);
  /// Adds an emissive sphere; it is listed as a lamp and as a compact source. gain and focus as in Source.
  void add_lamp(const Vec& centre, double radius, const Vec& radiance, const Vec& axis, double gain, int focus);

 private:
  mutable std::once_flag lit_once_;
  mutable std::atomic<bool> is_lit_ = false;
  mutable LightMap light_;
};

void build_lots(City& city);
void build_lamps(City& city);
void build_signals(City& city);
void build_cars(City& city, bool clear_lane);
void build_walkers(City& city);

}  // namespace rainref::night_street
