// Meshes from files.
#include "compositor/mesh_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/temporary_folder.h"
#include "rainref/error.h"

namespace rainref::compositor {
namespace {

std::filesystem::path write(const TemporaryFolder& folder, const char* name, const std::string& text) {
  const std::filesystem::path file = folder.path() / name;
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

TEST(MeshFile, AnObjSquareIsTwoTriangles) {
  const TemporaryFolder folder;
  const MeshData mesh = read_mesh(write(folder, "square.obj", "v 0 0 0\nv 1 0 0\nv 1 0.5 -1\nv 0 0.5 -1\nf 1 2 3 4\n"));
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_TRUE(mesh.normals.empty());
  const TriangleMesh surface(mesh);
  Hit first;
  for (std::uint32_t i = 0; i < 2; ++i) surface.meet(0, i, {{0.25, 2, -0.5}, {0, -1, 0}}, first);
  EXPECT_EQ(first.t, 1.75);
}

// A triangle whose node turns x into z, mirrors y, and moves by (1, 2, 3); its data are in the file itself.
TEST(MeshFile, AGltfNodesTransformIsApplied) {
  const TemporaryFolder folder;
  const MeshData mesh = read_mesh(write(folder, "triangle.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "matrix": [0,0,1,0, 0,-1,0,0, -1,0,0,0, 1,2,3,1]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0,0,0], "max": [1,1,0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})"));
  ASSERT_EQ(mesh.triangles.size(), 1u);
  // A mirror turns the triangle over, so its second and third vertices change places.
  const auto& [a, b, c] = mesh.triangles[0];
  EXPECT_EQ(mesh.positions[a], Vec(1, 2, 3));
  EXPECT_EQ(mesh.positions[b], Vec(1, 1, 3));
  EXPECT_EQ(mesh.positions[c], Vec(1, 2, 4));
}

TEST(MeshFile, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const auto code = [&](const std::filesystem::path& file) {
    try {
      read_mesh(file);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(file.filename().string()), std::string::npos) << error.what();
      return error.code();
    }
    return ExitCode::pass;
  };
  EXPECT_EQ(code(folder.path() / "missing.obj"), ExitCode::io);
  EXPECT_EQ(code(write(folder, "mesh.stl", "solid")), ExitCode::usage);
  EXPECT_EQ(code(write(folder, "broken.gltf", "{")), ExitCode::usage);
  EXPECT_EQ(code(write(folder, "points.obj", "v 0 0 0\nv 1 0 0\np 1 2\n")), ExitCode::usage);
}

}  // namespace
}  // namespace rainref::compositor
