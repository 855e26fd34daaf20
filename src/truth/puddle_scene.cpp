#include "truth/puddle_scene.h"

#include <array>
#include <cmath>

#include "compositor/environments.h"
#include "compositor/heightfield.h"
#include "compositor/plates.h"
#include "truth/puddle_ground.h"
#include "math/constants.h"
#include "puddle/scenery.h"
#include "puddle/ground.h"
#include "puddle/host.h"
#include "rainref/error.h"

namespace rainref::truth {
namespace {

constexpr double everywhere = 1000;  // half a side of the level ground around the rectangle [m]
constexpr double in_street = 6;      // the same if the street's own road continues

/// Height of the ground where the passes have this depth of water. For the passes dry ground is level; here it keeps its slope at the shore
/// and is flattened toward 6 mm.
float ground_height(float depth) {
  constexpr double flattest = 0.006;
  const double height = -static_cast<double>(depth);
  return static_cast<float>(height <= 0 ? height : height * flattest / (flattest + height));
}

/// A level plane with a hole: four rectangles with their outside up.
std::shared_ptr<Plates> surround(double half_x, double half_z, double height, double outer) {
  const auto piece = [height](double x0, double x1, double z0, double z1) {
    return Plate{Plate::parallelogram, {x0, height, z0}, {0, 0, z1 - z0}, {x1 - x0, 0, 0}};
  };
  return std::make_shared<Plates>(std::vector<Plate>{piece(-outer, outer, -outer, -half_z), piece(-outer, outer, half_z, outer),
                                                     piece(-outer, -half_x, -half_z, half_z), piece(half_x, outer, -half_z, half_z)});
}

/// A heightfield with vertices at the centres of texels, and a ring of vertices at `border` around them.
struct Ringed {
  std::shared_ptr<Heightfield> sheet;
  std::vector<float> heights;
  int width, height;
  double half_x, half_z;  // of the sheet

  Ringed(double extent_x, double extent_z, int w, int h, float border)
      : heights(static_cast<std::size_t>(w + 2) * (h + 2), border),
        width(w),
        height(h),
        half_x(0.5 * extent_x / w * (w + 1)),
        half_z(0.5 * extent_z / h * (h + 1)) {
    sheet = std::make_shared<Heightfield>(HeightfieldFrame{{-half_x, 0, -half_z}, {2 * half_x, 0, 0}, {0, 0, 2 * half_z}, {0, 1, 0}}, w + 1,
                                          h + 1);
  }
  std::size_t stride() const { return static_cast<std::size_t>(width + 2); }
  float* row(int y) { return heights.data() + static_cast<std::size_t>(y + 1) * (width + 2) + 1; }
};

/// Slopes of a heightfield at its vertices by central differences, for normals between them.
class Slopes {
 public:
  void take(const Ringed& sheet, double cell, const parallel::Executor& executor) {
    const int w = sheet.width + 2, h = sheet.height + 2;
    width_ = w;
    slopes_.resize(2 * sheet.heights.size());
    const float gain = static_cast<float>(0.5 / cell);
    executor.for_tiles(w, h, w, 32, [&](const parallel::Tile& tile) {
      for (int y = tile.y0; y < tile.y1; ++y) {
        const float* row = sheet.heights.data() + static_cast<std::size_t>(y) * w;
        const float *south = y > 0 ? row - w : row, *north = y + 1 < h ? row + w : row;
        float* out = slopes_.data() + 2 * static_cast<std::size_t>(y) * w;
        for (int x = 0; x < w; ++x) {
          out[2 * x] = (row[x > 0 ? x - 1 : x] - row[x + 1 < w ? x + 1 : x]) * gain;
          out[2 * x + 1] = (south[x] - north[x]) * gain;
        }
      }
    });
  }
  /// Normals at hits: slopes interpolated, as in surface_hit.
  void normals(const Places& places, const VecArraysOut& out) const {
    normals_of_interpolated_slopes({slopes_.data(), width_ - 1}, places.size(), places.hits, out);
  }

 private:
  int width_ = 0;
  std::vector<float> slopes_;
};

}  // namespace

struct PuddleScene::State {
  puddle::Settings settings;
  puddle::Encoding encoding;
  TextureData environment, ground, relief;
  std::shared_ptr<const scene::Scenery> street;
  scene::Camera camera;
  Ringed water;
  Slopes slopes;
  std::shared_ptr<Heightfield> bed;  // null: level
  Scene scene;

  State(const puddle::Settings& s, const puddle::Surroundings& around, const Options& options, const parallel::Executor& executor)
      : settings(s),
        encoding(puddle::encoding(s)),
        water(s.grid[0] * s.cell_size, s.grid[1] * s.cell_size, s.grid[0], s.grid[1], 0.0f),
        scene(options.tracer) {
    const auto vector = [](const std::array<double, 3>& a) { return Vec(a[0], a[1], a[2]); };
    camera.position = vector(s.camera_position);
    camera.target = vector(s.camera_target);
    camera.up = vector(s.camera_up);
    camera.vertical_fov_deg = s.vertical_fov_deg;

    environment = puddle::prepare_environment(around.environment, around.environment_is_cube, around.environment_is_encoded, s.variant);
    const bool own_ground = around.ground.empty();
    const Image made = own_ground ? puddle::make_asphalt(s.seed) : Image();
    ground = puddle::prepare_ground(own_ground ? made : around.ground, !own_ground && around.ground_is_encoded, s.variant);
    relief = puddle::make_relief(ground, own_ground);

    GroundLook look{puddle::shade_uniforms(s), &ground.view(), &relief.view(), water_refractive_index,
                    1 / std::sqrt(static_cast<double>(options.samples))};
    look.uniforms.ground_footprint = puddle::ground_footprint(s, ground.view().width[0]);
    const std::array<float, 3> ambient = puddle::ambient_radiance(environment.view(), around.environment_is_cube);
    for (int k = 0; k < 3; ++k) look.uniforms.ambient[k] = ambient[k];

    const Vec light(ambient[0], ambient[1], ambient[2]);
    Medium above = air(), below = compositor::water(water_refractive_index);
    above.extinction = Vec(1, 1, 1) * s.fog_depth;
    above.glow = light;
    below.extinction = Vec(1, 1, 1) * s.water_turbidity;
    below.glow = light * vector(s.tint);
    Material surface = Material::interface_of(above, below);
    surface.is_masked = true;
    Material rippled = surface;
    rippled.smooth_normals = [of_water = &slopes](const Places& places, const VecArraysOut& normals) {
      of_water->normals(places, normals);
    };
    scene.set_eye(above);
    scene.add(water.sheet, rippled);

    if (s.shape == puddle::Shape::basin) {
      scene.add(std::make_shared<Plates>(std::vector<Plate>{
                    {Plate::parallelogram, {-everywhere, -s.puddle_depth, -everywhere}, {0, 0, 2 * everywhere}, {2 * everywhere, 0, 0}}}),
                Material::of(std::make_shared<PuddleGround>(look, nullptr)));
      scene.add(surround(water.half_x, water.half_z, 0, everywhere), surface);
    } else {
      const TextureData depths = puddle::make_bed(s);
      const Texture& d = depths.view();
      Ringed sheet(s.grid[0] * s.cell_size, s.grid[1] * s.cell_size, d.width[0], d.height[0], ground_height(d.border[0]));
      for (int y = 0; y < sheet.height; ++y) {
        for (int x = 0; x < sheet.width; ++x) sheet.row(y)[x] = ground_height(d.texels[static_cast<std::size_t>(y) * sheet.width + x]);
      }
      sheet.sheet->assign(sheet.heights, executor);
      bed = sheet.sheet;
      scene.add(bed, Material::of(std::make_shared<PuddleGround>(look, bed.get())));
      scene.add(surround(sheet.half_x, sheet.half_z, ground_height(d.border[0]), options.street ? in_street : everywhere),
                Material::of(std::make_shared<PuddleGround>(look, nullptr)));
    }

    const Rotation rotation(s.env_rotation);
    if (options.street) {
      street = options.street;
      // The ground around the water is level with the road.
      scene.set_environment(std::make_shared<StreetEnvironment>(*street, Vec(0, -ground_height(static_cast<float>(-s.puddle_depth)), 0),
                                                                environment.view(), rotation));
    } else {
      scene.set_environment(std::make_shared<PictureEnvironment>(environment.view(), around.environment_is_cube, rotation));
    }
  }
};

PuddleScene::PuddleScene(const puddle::Settings& settings, const puddle::Surroundings& surroundings, const Options& options,
                         const parallel::Executor& executor) {
  if (settings.variant != Variant::corrected)
    throw Error(ExitCode::usage, "compositor: the as-published puddle has no water in metres to trace; use variant = \"corrected\"");
  state_ = std::make_unique<State>(settings, surroundings, options, executor);
}
PuddleScene::~PuddleScene() = default;
PuddleScene::PuddleScene(PuddleScene&&) noexcept = default;

void PuddleScene::update(const puddle::Puddle& puddle, const parallel::Executor& executor) {
  State& s = *state_;
  const TextureData stored(puddle.newest(), Address::clamp, Address::clamp);
  const float* from = stored.view().texels;
  for (int y = 0; y < s.water.height; ++y) {
    float* row = s.water.row(y);
    for (int x = 0; x < s.water.width; ++x)
      row[x] = static_cast<float>(s.encoding.scale * from[static_cast<std::size_t>(y) * s.water.width + x] + s.encoding.bias);
  }
  s.water.sheet->assign(s.water.heights, executor);
  s.slopes.take(s.water, s.settings.cell_size, executor);
  s.scene.commit();
}

const Scene& PuddleScene::scene() const { return state_->scene; }
const scene::Camera& PuddleScene::camera() const { return state_->camera; }

}  // namespace rainref::truth
