// Meshes from files.
#pragma once

#include <filesystem>

#include "compositor/triangle_mesh.h"

namespace rainref::compositor {

/// All triangles of an OBJ, glTF or GLB file, in the file's own axes and units, its nodes' transforms applied; polygons are
/// cut into triangles, points and lines left out. Normals are the file's, if every one of its meshes has them. Files hold
/// floats, and Assimp decodes them: the same file gives the same mesh for one version of that library.
/// Throws Error(io) when the file cannot be read, Error(usage) when it cannot be decoded, is of another kind, has no
/// triangle or a coordinate that is not finite.
MeshData read_mesh(const std::filesystem::path& file);

}  // namespace rainref::compositor
