// The environment that shade looks up: latitude/longitude and cube, orientation, poles, seam, rotation.
#include <algorithm>

#include "puddle/scenery.h"
#include "puddle/scene_support.h"
#include "random/counter.h"

namespace rainref::puddle::test {
namespace {

using Direction = std::array<double, 3>;

Vec3<Double> vec(const Direction& d) { return Vec3<Double>(Double(d[0]), Double(d[1]), Double(d[2])); }
Direction unit(double x, double y, double z) {
  const double l = std::sqrt(x * x + y * y + z * z);
  return {x / l, y / l, z / l};
}

// A smooth radiance: its gradient on the sphere is at most 1.1, its second derivative at most 1.6.
double radiance(const Direction& d) { return 2 + 0.5 * d[0] + 0.7 * d[1] - 0.3 * d[2] + 0.2 * d[0] * d[1]; }
constexpr double gradient = 1.1, curvature = 1.6;

Direction latlong_direction(double u, double v) {
  const double azimuth = (u - 0.5) * 2 * pi, elevation = (v - 0.5) * pi;
  return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation), std::cos(elevation) * std::sin(azimuth)};
}
// The table of the OpenGL specification (cube map texture selection): (s, t) in [-1, 1] of a face to a direction.
Direction cube_direction(int face, double s, double t) {
  switch (face) {
    case 0:
      return {1, -t, -s};
    case 1:
      return {-1, -t, s};
    case 2:
      return {s, 1, t};
    case 3:
      return {s, -1, -t};
    case 4:
      return {s, -t, 1};
    default:
      return {-s, -t, -1};
  }
}

TextureData paint(int width, int height, bool is_cube) {
  Surroundings s;
  s.environment = Image(Format::rgba32f, width, height);
  s.environment_is_cube = is_cube;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Direction d;
      if (is_cube) {
        const Direction c = cube_direction(y / width, 2 * (x + 0.5) / width - 1, 2 * (y % width + 0.5) / width - 1);
        d = unit(c[0], c[1], c[2]);
      } else {
        d = latlong_direction((x + 0.5) / width, (y + 0.5) / height);
      }
      float* texel = s.environment.row<float>(y) + 4 * x;
      for (int k = 0; k < 3; ++k) texel[k] = static_cast<float>((k + 1) * radiance(d));
    }
  }
  return prepare_environment(s, Variant::corrected);
}
double look(const TextureData& t, bool is_cube, const Direction& d, int channel = 0) {
  const Vec3<Double> c = scalar::sample_environment(t.view(), is_cube, vec(d), Double(0.0f));
  return channel == 0 ? c.x.v : channel == 1 ? c.y.v : c.z.v;
}
Direction random_direction(std::uint32_t i) {
  const auto b = random::block(3, random::Purpose::puddle_drop, i, 0);
  const double z = 2 * random::uniform(b[0]) - 1, a = 2 * pi * random::uniform(b[1]), r = std::sqrt(1 - z * z);
  return {r * std::cos(a), z, r * std::sin(a)};
}

TEST(PuddleEnvironment, LatitudeLongitudeGivesTheRadianceOfItsDirection) {
  const int height = 128;
  const TextureData t = paint(2 * height, height, false);
  // Bilinear: an eighth of texel^2 times the second derivative in each of the two axes. Beyond the last row's centre the
  // clamp holds for half a texel: half a texel times the gradient. Painted floats below 8 add 2.4e-7.
  const double texel = pi / height, smooth = 2 * texel * texel / 8 * curvature + 3e-7, pole = texel / 2 * gradient + smooth;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const Direction d = random_direction(i);
    const bool near_pole = std::asin(std::abs(d[1])) > pi / 2 - texel / 2;
    ASSERT_NEAR(look(t, false, d), radiance(d), near_pole ? pole : smooth) << d[0] << " " << d[1] << " " << d[2];
  }
  EXPECT_NEAR(look(t, false, {0, 1, 0}), radiance({0, 1, 0}), pole);
  EXPECT_NEAR(look(t, false, {0, -1, 0}), radiance({0, -1, 0}), pole);
  EXPECT_NEAR(look(t, false, {0, 1, 0}, 2), 3 * radiance({0, 1, 0}), 3 * pole) << "channels keep their places";
}

TEST(PuddleEnvironment, LatitudeLongitudeHasNoSeam) {
  // u = 0 and 1 meet at -x; across it the lookup is continuous and symmetric.
  const TextureData t = paint(64, 32, false);
  for (double y = -0.9; y < 0.95; y += 0.1) {
    const double r = std::sqrt(1 - y * y), texel = pi / 32;
    const double behind = look(t, false, {-r, y, 1e-9}), before = look(t, false, {-r, y, -1e-9});
    EXPECT_NEAR(behind, before, 1e-7) << y;
    EXPECT_NEAR(behind, radiance({-r, y, 0}), 2 * texel * texel / 8 * curvature + 1e-6) << y;
  }
}

TEST(PuddleEnvironment, RowZeroLooksDownAndColumnsTurnFromMinusXByMinusZ) {
  // One bright texel each: where it is seen is the orientation.
  const auto seen_from = [](int x, int y, const Direction& d) {
    std::vector<float> texels(8 * 4 * 4, 0.0f);
    texels[static_cast<std::size_t>(y * 8 + x) * 4] = 1;
    return look(TextureData(std::move(texels), 4, 8, 4, Address::repeat, Address::clamp), false, d);
  };
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      // 1e-6: the float constants 1 / pi and 1 / 2 pi put the lookup that far off the texel's centre, times 8 columns.
      EXPECT_NEAR(seen_from(x, y, latlong_direction((x + 0.5) / 8, (y + 0.5) / 4)), 1, 1e-6) << x << " " << y;
    }
  }
  EXPECT_GT(seen_from(0, 0, unit(-1, -3, -0.1)), 0.1) << "row 0 is below, column 0 begins at -x and turns to -z";
  EXPECT_GT(seen_from(4, 2, unit(1, 0.4, 0.4)), 0.9) << "column 4 of 8 begins at +x and turns to +z";
}

TEST(PuddleEnvironment, CubeGivesTheRadianceOfItsDirection) {
  const int side = 64;
  const TextureData t = paint(side, 6 * side, true);
  // A texel is at most 2 / side wide. Inside a face bilinear as above (the map from face to sphere bends too: factor 3);
  // the outermost half texel of a face is held: half a texel times the gradient, in two axes.
  const double texel = 2.0 / side, smooth = 3 * 2 * texel * texel / 8 * curvature + 1e-6, edge = smooth + texel * gradient;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const Direction d = random_direction(i);
    double a[3] = {std::abs(d[0]), std::abs(d[1]), std::abs(d[2])};
    std::sort(a, a + 3);
    ASSERT_NEAR(look(t, true, d), radiance(d), a[1] / a[2] > 1 - 1.0 / side ? edge : smooth) << d[0] << " " << d[1] << " " << d[2];
  }
}

TEST(PuddleEnvironment, CubeAndLatitudeLongitudeAgree) {
  const TextureData cube = paint(64, 384, true), sphere = paint(256, 128, false);
  for (std::uint32_t i = 0; i < 5000; ++i) {
    const Direction d = random_direction(i);
    // Half a texel of the cube's edge is the coarsest: 2 / 64 by the gradient, plus both interpolation errors.
    ASSERT_NEAR(look(cube, true, d), look(sphere, false, d), 2.0 / 64 * gradient + 4e-3) << d[0] << " " << d[1] << " " << d[2];
  }
}

TEST(PuddleEnvironment, EachCubeFaceIsOrientedAsGraphicsApisDo) {
  constexpr int side = 4;
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        std::vector<float> texels(side * side * 6 * 4, 0.0f);
        texels[static_cast<std::size_t>((face * side + y) * side + x) * 4] = 1;
        const TextureData t(std::move(texels), 4, side, 6 * side, Address::clamp, Address::clamp);
        // At the centre of a texel bilinear weights are 1 and 0: only the float constants of the lookup are off.
        EXPECT_NEAR(look(t, true, cube_direction(face, 2 * (x + 0.5) / side - 1, 2 * (y + 0.5) / side - 1)), 1, 1e-6)
            << "face " << face << ", column " << x << ", row " << y;
      }
    }
  }
}

TEST(PuddleEnvironment, CubeLookupsDoNotLeakIntoTheNextFaceOfTheColumn) {
  constexpr int side = 4;
  for (int bright = 0; bright < 6; ++bright) {
    std::vector<float> texels(side * side * 6 * 4, 0.0f);
    for (int i = 0; i < side * side; ++i) texels[static_cast<std::size_t>(bright * side * side + i) * 4] = 1;
    const TextureData t(std::move(texels), 4, side, 6 * side, Address::clamp, Address::clamp);
    for (int face = 0; face < 6; ++face) {
      for (const double s : {-0.99, 0.0, 0.99}) {
        for (const double r : {-0.99, 0.0, 0.99}) {
          EXPECT_NEAR(look(t, true, cube_direction(face, s, r)), face == bright, 1e-6) << face << " " << s << " " << r;
        }
      }
    }
  }
}

TEST(PuddleEnvironment, FacesInARowAreTheSameCube) {
  constexpr int side = 2;
  Surroundings column, row;
  column.environment_is_cube = row.environment_is_cube = true;
  column.environment = Image(Format::rgba32f, side, 6 * side);
  row.environment = Image(Format::rgba32f, 6 * side, side);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < side; ++y) {
      for (int i = 0; i < side * 4; ++i) {
        const float value = static_cast<float>(face * 100 + y * 10 + i);
        column.environment.row<float>(face * side + y)[i] = row.environment.row<float>(y)[face * side * 4 + i] = value;
      }
    }
  }
  TextureData a = prepare_environment(column, Variant::corrected), b = prepare_environment(row, Variant::corrected);
  ASSERT_EQ(b.view().width[0], side);
  ASSERT_EQ(b.view().height[0], 6 * side);
  EXPECT_EQ(std::vector<float>(a.texels(), a.texels() + 96), std::vector<float>(b.texels(), b.texels() + 96));
  Surroundings wrong;
  wrong.environment_is_cube = true;
  wrong.environment = Image(Format::rgba32f, 8, 4);
  EXPECT_EQ(error_of([&] { prepare_environment(wrong, Variant::corrected); }),
            "2 environment.image: a cube needs six square faces in a row or a column, found 8x4");
}

TEST(PuddleEnvironment, RotationTurnsTheLookupAboutTheVertical) {
  // By env_rotation a, the direction at azimuth phi is looked up at phi - a (azimuth from +x to +z).
  for (const double a : {0.0, pi / 2, 1.0, 5.5}) {
    Settings s = corrected(1, 1);
    s.env_rotation = a;
    const ShadeUniforms u = shade_uniforms(s);
    for (double azimuth = 0; azimuth < 6; azimuth += 0.7) {
      const Direction d{0.8 * std::cos(azimuth), 0.6, 0.8 * std::sin(azimuth)};
      const Vec3<Double> r = scalar::rotate_y(vec(d), u.rotation);
      EXPECT_NEAR(r.x.v, 0.8 * std::cos(azimuth - a), 1e-7);  // cosine and sine are floats
      EXPECT_EQ(r.y.v, d[1]);
      EXPECT_NEAR(r.z.v, 0.8 * std::sin(azimuth - a), 1e-7);
    }
  }
}

TEST(PuddleEnvironment, RotationIsSeenInThePicture) {
  // A sky that is bright toward +x only; a camera that looks up along an azimuth sees it when the rotation says so.
  Surroundings around = uniform_surroundings(0, 0);
  around.environment = uniform_image(8, 4, 0, 0, 0);
  for (int y = 0; y < 4; ++y) around.environment.row<float>(y)[4 * 4] = around.environment.row<float>(y)[4 * 3] = 1;
  for (const bool is_corrected : {false, true}) {
    for (const double rotation : {0.0, pi / 2, pi}) {
      for (int quarter = 0; quarter < 4; ++quarter) {
        Settings s = is_corrected ? corrected(1, 1) : as_published(1, 1);
        s.env_rotation = rotation;
        s.camera_position = {0, 50, 0};
        s.camera_target = {std::cos(quarter * pi / 2), 50.5, std::sin(quarter * pi / 2)};
        Puddle p(s, around, executor());
        p.render();
        const bool bright = std::lround(rotation / (pi / 2)) % 4 == quarter;
        EXPECT_NEAR(colour_of(p, 0, 0, 0), bright ? 1 : 0, 1e-3) << is_corrected << " " << rotation << " " << quarter;
      }
    }
  }
}

TEST(PuddleEnvironment, AmbientRadianceIsTheCosineMeanOfTheUpperHalf) {
  // L = a + b d_y has (1/pi) integral of L cos = a + 2 b / 3 over the upper half. Midpoint rule: error O(texel^2).
  const auto paint_linear = [](int width, int height, bool is_cube) {
    Surroundings s;
    s.environment = Image(Format::rgba32f, width, height);
    s.environment_is_cube = is_cube;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        Direction d = latlong_direction((x + 0.5) / width, (y + 0.5) / height);
        if (is_cube) {
          const Direction c = cube_direction(y / width, 2 * (x + 0.5) / width - 1, 2 * (y % width + 0.5) / width - 1);
          d = unit(c[0], c[1], c[2]);
        }
        s.environment.row<float>(y)[4 * x] = static_cast<float>(0.5 + 0.3 * d[1]);
      }
    }
    return prepare_environment(s, Variant::corrected);
  };
  EXPECT_NEAR(ambient_radiance(paint_linear(128, 64, false).view(), false)[0], 0.7, 5e-4);
  EXPECT_NEAR(ambient_radiance(paint_linear(64, 384, true).view(), true)[0], 0.7, 5e-4);
}

}  // namespace
}  // namespace rainref::puddle::test
