#include "compositor/mesh_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "base/read_file.h"
#include "rainref/error.h"

namespace rainref::compositor {

namespace {

/// Columns of the linear part, and the translation.
struct Transform {
  Vec x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{0, 0, 0};
  Vec linear(const Vec& v) const { return v.x * x + v.y * y + v.z * z; }
  Vec point(const Vec& p) const { return linear(p) + origin; }
  /// By the cofactors, which keep a normal perpendicular to its surface.
  Vec normal(const Vec& n) const { return n.x * cross(y, z) + n.y * cross(z, x) + n.z * cross(x, y); }
  Transform after(const aiMatrix4x4& m) const {
    return {linear({m.a1, m.b1, m.c1}), linear({m.a2, m.b2, m.c2}), linear({m.a3, m.b3, m.c3}), point({m.a4, m.b4, m.c4})};
  }
};

Vec from(const aiVector3D& v) { return {v.x, v.y, v.z}; }

void append(const aiMesh& mesh, const Transform& to_file, bool normals, MeshData& out) {
  const auto first = static_cast<std::uint32_t>(out.positions.size());
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    out.positions.push_back(to_file.point(from(mesh.mVertices[i])));
    if (!normals) continue;
    const Vec n = to_file.normal(from(mesh.mNormals[i]));
    const double length = glm::length(n);
    out.normals.push_back(length > 0 ? n / length : Vec(0, 0, 0));
  }
  // A mirroring transform turns the triangles over.
  const bool mirrored = dot(cross(to_file.x, to_file.y), to_file.z) < 0;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) continue;
    std::array<std::uint32_t, 3> triangle{first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]};
    if (mirrored) std::swap(triangle[1], triangle[2]);
    out.triangles.push_back(triangle);
  }
}

void append(const aiScene& scene, const aiNode& node, const Transform& parent, bool normals, MeshData& out) {
  const Transform to_file = parent.after(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) append(*scene.mMeshes[node.mMeshes[i]], to_file, normals, out);
  for (unsigned i = 0; i < node.mNumChildren; ++i) append(scene, *node.mChildren[i], to_file, normals, out);
}

}  // namespace

MeshData read_mesh(const std::filesystem::path& file) {
  const std::string kind = file.extension().string();
  if (kind != ".obj" && kind != ".gltf" && kind != ".glb") {
    throw Error(ExitCode::usage, fmt::format("{}: a mesh is an .obj, .gltf or .glb file, not \"{}\"", file.string(), kind));
  }
  read_file(file);  // says what is wrong with a file that cannot be read
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_SortByPType);
  if (!scene || !scene->mRootNode)
    throw Error(ExitCode::usage, fmt::format("{}: not a mesh that can be decoded ({})", file.string(), importer.GetErrorString()));
  const bool normals =
      std::all_of(scene->mMeshes, scene->mMeshes + scene->mNumMeshes, [](const aiMesh* mesh) { return mesh->HasNormals(); });
  MeshData out;
  append(*scene, *scene->mRootNode, {}, normals, out);
  if (out.triangles.empty()) throw Error(ExitCode::usage, fmt::format("{}: the mesh has no triangle", file.string()));
  for (const Vec& p : out.positions) {
    if (!(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)))
      throw Error(ExitCode::usage, fmt::format("{}: the mesh has a coordinate that is not finite", file.string()));
  }
  return out;
}

}  // namespace rainref::compositor
