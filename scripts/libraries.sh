# Debian's sources of the libraries that rainref stands on, and these libraries built from them for any system: static and position
# independent, so that an archive with rainref needs nothing of the machine that runs it. Not run, but sourced behind lib.sh,
# from the folder in which that leaves a script: . scripts/libraries.sh

# The newest sources in a release of Debian. Their folders begin with these names.
library_sources=(highway fmtlib xxhash zlib libpng1.6 imath openexr libjpeg-turbo sqlite3 cpp-httplib googletest)
# Headers alone, taken from this machine. And what builds the others: dpkg-dev unpacks sources, SQLite makes its one file with Tcl.
library_headers=(libglm-dev nlohmann-json3-dev libcli11-dev libtomlplusplus-dev)
library_packages=(dpkg-dev debian-archive-keyring cmake ninja-build gcc make tcl pkg-config "${library_headers[@]}")

# fetch_sources FOLDER RELEASE: unpacks the sources into FOLDER, each in a folder of its own. Needs no root, and leaves the machine's apt as it is.
# Does nothing if they are there.
fetch_sources() {
  local folder
  need "${library_packages[@]}"
  mkdir -p "$1"
  folder=$(realpath "$1")
  [ "$(cat "$folder/complete" 2>/dev/null)" != "$2 ${library_sources[*]}" ] || return 0
  say "Fetching sources of ${#library_sources[@]} libraries from Debian's $2"
  rm -rf "${folder:?}"/*
  in_own_shell "$folder.log" unpack_sources "$folder" "$2" "${library_sources[@]}" || die "Could not fetch the sources (log: $folder.log)"
  echo "$2 ${library_sources[*]}" >"$folder/complete"
}

# build_libraries SOURCES PREFIX TOOLCHAIN_FILE: builds what fetch_sources put into SOURCES with CMake's TOOLCHAIN_FILE and installs it into
# PREFIX, which is emptied first. CMake finds it by CMAKE_PREFIX_PATH or CMAKE_FIND_ROOT_PATH, and pkg-config by
# PKG_CONFIG_LIBDIR=PREFIX/lib/pkgconfig. Does nothing if PREFIX was built by this text from these sources with this toolchain file.
build_libraries() {
  local sources prefix toolchain stamp
  need "${library_packages[@]}"
  mkdir -p "$2"
  sources=$(realpath "$1") prefix=$(realpath "$2") toolchain=$(realpath "$3")
  stamp=$({ cat "${BASH_SOURCE[0]}" "$toolchain" "$sources"/*.dsc && dpkg-query -W "${library_headers[@]}"; } | sha256sum)
  [ "$(cat "$prefix/complete" 2>/dev/null)" != "$stamp" ] || return 0
  say "Building ${#library_sources[@]} libraries with $(basename "$toolchain")"
  rm -rf "${prefix:?}"/* "$prefix.build"
  in_own_shell "$prefix.log" install_libraries "$sources" "$prefix" "$toolchain" || die "Could not build the libraries (log: $prefix.log)"
  rm -rf "$prefix.build"
  echo "$stamp" >"$prefix/complete"
}

# in_own_shell LOG FUNCTION ARGUMENT...: ends at the first error; `set -e` has no effect within a condition of this shell.
in_own_shell() {
  local log=$1
  shift
  bash -euo pipefail -c "$(declare -f)"$'\n"$@"' bash "$@" >"$log" 2>&1
}

unpack_sources() {  # FOLDER RELEASE PACKAGE...
  local folder=$1 release=$2 package version
  shift 2
  cd "$folder"
  mkdir -p apt/lists/partial apt/cache/archives/partial
  printf 'deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian %s main\n' "$release" bookworm >apt/sources.list
  # The machine's own configuration is read, too, for example a proxy.
  cat >apt/apt.conf <<CONFIGURATION
Dir::Etc::SourceList "$folder/apt/sources.list";
Dir::Etc::SourceParts "/dev/null";
Dir::State::Lists "$folder/apt/lists";
Dir::Cache "$folder/apt/cache";
APT::Sandbox::User "$(id -un)";
CONFIGURATION
  export APT_CONFIG=$folder/apt/apt.conf LC_ALL=C
  apt-get update -qq
  # While a mirror takes in a point release it lists newer sources than it has: then an older one does.
  for package in "$@"; do
    for version in $(apt-cache showsrc --only-source "$package" | sed -n "s/^Version: //p" | sort -urV); do
      ! apt-get source -qq "$package=$version" || break
      rm -rf "$package"-*/
    done
    compgen -G "$package-*/debian" >/dev/null || return 1
  done
}

# library NAME FOLDER OPTION...: one of them, by its own CMake files. `prefix` and `toolchain` are the caller's. No products are fused with
# sums, so that lossy EXRs give the same texels on processors that could.
library() {
  local name=$1 folder=$2 flags="-O2 -ffp-contract=off -DNDEBUG"
  shift 2
  cmake -G Ninja -S "$folder" -B "$prefix.build/$name" --toolchain "$toolchain" -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR:PATH=lib \
    -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE="$flags" -DCMAKE_CXX_FLAGS_RELEASE="$flags" \
    -DCMAKE_C_COMPILER_LAUNCHER="$(command -v ccache)" -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache)" -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF "$@"
  cmake --build "$prefix.build/$name" --target install
}

# own_library NAME VERSION LIBRARY SOURCE_FOLDER "FILE..." "HEADER..." "DEFINITION...": one whose own files for CMake there are none, or build
# more than a static library. pkg-config knows it as NAME.
own_library() {
  local name=$1 version=$2 file=$3 folder=$4 own=$prefix.build/own-$1
  mkdir -p "$own" "$prefix/lib/pkgconfig"
  cat >"$own/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.25)
project($name C)
set(files $5)
list(TRANSFORM files PREPEND $folder/)
add_library($file STATIC \${files})
target_compile_definitions($file PRIVATE $7)
set(headers $6)
list(TRANSFORM headers PREPEND $folder/)
install(TARGETS $file)
install(FILES \${headers} DESTINATION include)
CMAKE
  library "$name" "$own"
  cat >"$prefix/lib/pkgconfig/$name.pc" <<PC
prefix=$prefix
Name: $name
Description: $name
Version: $version
Libs: -L\${prefix}/lib -l$file
Cflags: -I\${prefix}/include
PC
}

install_libraries() {  # SOURCES PREFIX TOOLCHAIN_FILE
  local sources=$1 prefix=$2 toolchain=$3 zlib at
  library highway "$sources"/highway-* -DHWY_ENABLE_CONTRIB=OFF -DHWY_ENABLE_EXAMPLES=OFF
  library fmt "$sources"/fmtlib-* -DFMT_TEST=OFF -DFMT_DOC=OFF
  library xxhash "$sources"/xxhash-*/cmake_unofficial -DXXHASH_BUILD_XXHSUM=OFF
  library googletest "$sources"/googletest-*
  # zlib's own CMake files build a shared library, too. unistd.h is there on every system of these compilers.
  zlib=$(echo "$sources"/zlib-*)
  own_library zlib "$(sed -n 's/^#define ZLIB_VERSION "\([0-9.]*\).*/\1/p' "$zlib/zlib.h")" z "$zlib" \
    "adler32.c compress.c crc32.c deflate.c gzclose.c gzlib.c gzread.c gzwrite.c infback.c inffast.c inflate.c inftrees.c trees.c uncompr.c zutil.c" \
    "zlib.h zconf.h" "HAVE_UNISTD_H _LARGEFILE64_SOURCE=1"
  # Told to CMake, because a toolchain file may keep it from looking anywhere but in its own folders.
  at=(-DZLIB_LIBRARY="$prefix/lib/libz.a" -DZLIB_INCLUDE_DIR="$prefix/include")
  library png "$sources"/libpng1.6-* "${at[@]}" -DPNG_SHARED=OFF -DPNG_TESTS=OFF -DPNG_EXECUTABLES=OFF
  library imath "$sources"/imath-* -DIMATH_INSTALL_PKG_CONFIG=ON  # for Windows, too
  library openexr "$sources"/openexr-* "${at[@]}" -DImath_DIR="$prefix/lib/cmake/Imath" -DOPENEXR_BUILD_TOOLS=OFF \
    -DOPENEXR_INSTALL_TOOLS=OFF -DOPENEXR_INSTALL_EXAMPLES=OFF -DOPENEXR_INSTALL_PKG_CONFIG=ON
  # Without assembly, which needs NASM: the archives shall not depend on what this machine has. No texel changes.
  library jpeg "$sources"/libjpeg-turbo-* -DENABLE_SHARED=OFF -DWITH_TURBOJPEG=OFF -DWITH_SIMD=OFF
  # SQLite as one file, which its makefile joins.
  mkdir -p "$prefix.build/sqlite3-file"
  (cd "$prefix.build/sqlite3-file" && "$sources"/sqlite3-*/configure && make sqlite3.c)
  own_library sqlite3 "$(cat "$sources"/sqlite3-*/VERSION)" sqlite3 "$prefix.build/sqlite3-file" sqlite3.c sqlite3.h SQLITE_OMIT_LOAD_EXTENSION

  # The server of `rainref view`, a header alone, without TLS and compression: it serves this machine.
  cp "$sources"/cpp-httplib-*/httplib.h "$prefix/include/"
  cat >"$prefix/lib/pkgconfig/cpp-httplib.pc" <<PC
prefix=$prefix
Name: cpp-httplib
Description: HTTP server
Version: $(sed -n 's/^#define CPPHTTPLIB_VERSION "\(.*\)"$/\1/p' "$sources"/cpp-httplib-*/httplib.h)
Libs: -pthread
Cflags: -I\${prefix}/include
PC

  # xxHash's and Imath's write where they lie as Debian has it.
  sed -i "s,^prefix=.*,prefix=$prefix," "$prefix"/lib/pkgconfig/*.pc
  # These are headers alone; /usr/include itself would bring the headers of this machine's C library.
  cp -r /usr/include/{glm,nlohmann,CLI,toml++} "$prefix/include/"
  mkdir -p "$prefix/share/cmake/tomlplusplus"
  cp -r /usr/share/cmake/{glm,nlohmann_json,CLI11} "$prefix/share/cmake/"
  cat >"$prefix/share/cmake/tomlplusplus/tomlplusplusConfig.cmake" <<'TOML'
add_library(tomlplusplus::tomlplusplus INTERFACE IMPORTED)
target_compile_definitions(tomlplusplus::tomlplusplus INTERFACE TOML_HEADER_ONLY=1)
get_filename_component(_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
target_include_directories(tomlplusplus::tomlplusplus INTERFACE "${_prefix}/include")
TOML
}
