# The platforms that archives are made for, and their compilers. Sourced behind lib.sh.
#
# Linux: Debian's GCC, the headers and libraries of an old glibc, and the C++ runtime inside each file. So it runs wherever glibc is 2.27 or
# later. An older Debian as a whole would have an older GCC, which does not know C++20. A static glibc would run anywhere too, but a library
# for Python must share the glibc of its process.
platforms=(linux-x86_64 linux-aarch64 windows-x86_64)

# Ubuntu 18.04's glibc. Its own packages for cross compilers stand in the same archive. name, SHA-256
ubuntu=http://archive.ubuntu.com/ubuntu/pool/main
glibc_x86_64=(
  g/glibc/libc6_2.27-3ubuntu1_amd64.deb 1e1eb86fd646aa68f7144ec692b837b6b352d215880c6a2d0c92c19d36938427
  g/glibc/libc6-dev_2.27-3ubuntu1_amd64.deb e426c70a940a7d0c5c95823a5fd01f26bd8bcb08d109df2f8c96c439da8dc440
  l/linux/linux-libc-dev_4.15.0-20.21_amd64.deb 4a73fc5ea2d0284e9c9c84cba68cbe5880505afbae0a3201c65c336daf8f8239
)
glibc_aarch64=(
  c/cross-toolchain-base/libc6-arm64-cross_2.27-3ubuntu1cross1_all.deb 3b7ac882761276bf76653dcf0bb31c1741aa56ec173092db4d7d4af5487962d3
  c/cross-toolchain-base/libc6-dev-arm64-cross_2.27-3ubuntu1cross1_all.deb 8990471116770194523ac485eb1b65fabc9bb2b130d47bc61cc262f04bf33931
  c/cross-toolchain-base/linux-libc-dev-arm64-cross_4.15.0-18.19cross1_all.deb fa7188a15ff3460ca5330206382442ebca72b7ba28c72b5742260e48310c0565
)

# old_glibc PROCESSOR ROOT: its files as a system has them.
old_glibc() {
  local processor=$1 root=$2 name hash link target
  local -n packages_of="glibc_$processor"
  rm -rf "$root"
  mkdir -p "$root/packages"
  set -- "${packages_of[@]}"
  while [ $# -gt 0 ]; do
    name=$root/packages/$(basename "$1") hash=$2
    curl -fsS --retry 3 -o "$name" "$ubuntu/$1" || die "Could not fetch $ubuntu/$1"
    echo "$hash  $name" | sha256sum --check --status || die "$ubuntu/$1 has another SHA-256 than $hash"
    dpkg-deb -x "$name" "$root"
    shift 2
  done
  # A cross compiler's packages have a folder of their own.
  if [ -d "$root/usr/aarch64-linux-gnu" ]; then
    rm -rf "$root/lib" "$root/usr/lib" "$root/usr/include"
    mv "$root/usr/aarch64-linux-gnu/lib" "$root/lib"
    mv "$root/usr/aarch64-linux-gnu/include" "$root/usr/include"
    ln -s ../lib "$root/usr/lib"
    sed -i 's,/usr/aarch64-linux-gnu/lib/,/lib/,g' $(grep -lI '^GROUP' "$root"/lib/lib*.so)
  fi
  find "$root" -type l -lname '/*' | while read -r link; do
    target=$(readlink "$link")
    ln -sfn "$(realpath -m --relative-to="$(dirname "$link")" "$root$target")" "$link"
  done
}

# linux_toolchain PROCESSOR ROOT: a compiler's options, so that it sees that glibc alone. ROOT/toolchain.cmake is for CMake.
linux_toolchain() {
  local processor=$1 root=$2 triplet=$1-linux-gnu
  local headers own include configuration libraries part
  own=$(dirname "$("$triplet-g++" -print-libgcc-file-name)")
  headers() { "$triplet-g++" -x c++ -M -E - <<<"#include <$1>" | tr ' ' '\n' | grep "/$1\$" | head -n 1; }
  include=$(dirname "$(headers cstdlib)")
  configuration=$(headers bits/c++config.h)
  # What the C++ headers must not take from glibc.
  mkdir -p "$root/c++/bits"
  sed -E 's/^#define (_GLIBCXX_USE_PTHREAD_(COND_CLOCKWAIT|MUTEX_CLOCKLOCK|RWLOCK_CLOCKLOCK)|_GLIBCXX_HAVE_(ARC4RANDOM|GETENTROPY)) .*$//' \
    "$configuration" >"$root/c++/bits/c++config.h"
  local c="-nostdinc -isystem $own/include -isystem $root/usr/include/$triplet -isystem $root/usr/include"
  local cxx="-nostdinc -isystem $root/c++ -isystem $include -isystem $(dirname "$(dirname "$configuration")") -isystem $include/backward ${c#-nostdinc }"
  libraries=
  for part in usr/lib/$triplet lib/$triplet usr/lib lib; do
    [ ! -d "$root/$part" ] || libraries+=" -B$root/$part/ -L$root/$part"
  done
  "$triplet-gcc" --sysroot="$root" $c -O2 -fPIC -Wall -Wextra -c scripts/package/newer_glibc.c -o "$root/newer_glibc.o" || die "scripts/package/newer_glibc.c does not compile"
  cat >"$root/toolchain.cmake" <<CMAKE
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR $processor)
set(CMAKE_C_COMPILER $triplet-gcc)
set(CMAKE_CXX_COMPILER $triplet-g++)
set(CMAKE_SYSROOT $root)
set(CMAKE_C_FLAGS_INIT "$c")
set(CMAKE_CXX_FLAGS_INIT "$cxx")
foreach(kind EXE SHARED MODULE)
  set(CMAKE_\${kind}_LINKER_FLAGS_INIT "$libraries -static-libstdc++ -static-libgcc")
endforeach()
set(CMAKE_C_STANDARD_LIBRARIES $root/newer_glibc.o)
set(CMAKE_CXX_STANDARD_LIBRARIES $root/newer_glibc.o)
CMAKE
}

# The toolchain file of PLATFORM, made anew if this file or the compiler is another one; the folder is build/platforms/PLATFORM.
toolchain() {
  local platform=$1 processor=${1#*-} folder=$PWD/build/platforms/$1 compiler
  case $platform in
    linux-x86_64) need g++ curl; compiler=x86_64-linux-gnu-g++ ;;
    linux-aarch64) need g++-aarch64-linux-gnu qemu-user-static curl; compiler=aarch64-linux-gnu-g++ ;;
    windows-x86_64) need g++-mingw-w64-x86-64-posix llvm; compiler=x86_64-w64-mingw32-g++-posix ;;
    *) die "unknown platform '$platform'; known are ${platforms[*]}" ;;
  esac
  local state
  state=$(cat scripts/platforms.sh scripts/package/newer_glibc.c <("$compiler" -v 2>&1) | sha256sum)
  if [ ! -f "$folder/state" ] || [ "$(cat "$folder/state")" != "$state" ]; then
    say "Making the toolchain for $platform"
    rm -rf "$folder"
    mkdir -p "$folder"
    case $platform in
      linux-*)
        old_glibc "$processor" "$folder/glibc"
        linux_toolchain "$processor" "$folder/glibc"
        mv "$folder/glibc/toolchain.cmake" "$folder/toolchain.cmake"
        ;;
      windows-*)
        cat >"$folder/toolchain.cmake" <<'CMAKE'
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
# CMakeLists.txt says why. The libraries need it, too.
set(CMAKE_C_FLAGS_INIT "-fno-ipa-ra")
set(CMAKE_CXX_FLAGS_INIT "-fno-ipa-ra")
foreach(kind EXE SHARED MODULE)
  set(CMAKE_${kind}_LINKER_FLAGS_INIT "-static")
endforeach()
CMAKE
        ;;
    esac
    cat >>"$folder/toolchain.cmake" <<CMAKE
set(CMAKE_FIND_ROOT_PATH $folder/libraries)
foreach(kind LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_\${kind} ONLY)
endforeach()
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(ENV{PKG_CONFIG_LIBDIR} $folder/libraries/lib/pkgconfig)
CMAKE
    echo "$state" >"$folder/state"
  fi
}
