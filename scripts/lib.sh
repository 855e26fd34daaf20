# Shared by the scripts: what must be installed, and how to build. Sourced, not run.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=(cmake ninja-build g++ ccache pkg-config git
  libhwy-dev libtbb-dev libglm-dev libfmt-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libxxhash-dev zlib1g-dev
  libembree-dev libopenimageio-dev libpng-dev libopenexr-dev libjpeg62-turbo-dev libsqlite3-dev libcpp-httplib-dev
  libgtest-dev libgmock-dev libbenchmark-dev libmpfr-dev libvulkan-dev mesa-vulkan-drivers glslang-tools)
# Without these some tests would be skipped: the page in a browser and its script without one, JUnit against its schema, the format of the sources, the Python package and its types, the reference,
# films, what other programs read in pictures, C#, and Godot.
test_packages=(chromium nodejs libxml2-utils clang-format python3-numpy python3-pytest python3-pip python3-venv python3-setuptools python3-wheel
  mypy doxygen ffmpeg openimageio-tools mono-mcs godot3-server)

# The version that the one header states.
version=$(sed -n 's/^#define RAINREF_VERSION_\(MAJOR\|MINOR\|PATCH\) \([0-9]*\)$/\2/p' include/rainref/version.h | paste -sd .)

say() { printf '%s\n' "$*" >&2; }
die() { say "$*"; exit 1; }

# RAINREF_NO_BUILD=1 takes build/ as it is: for a machine that has a GPU and no compiler, where it was copied to.

# run_apt LOG ARGUMENT...: apt-get as root, quietly. While another program holds a lock of apt, this waits for up to ten minutes.
run_apt() {
  local log=$1 as_root=() result try
  shift
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  for try in {1..120}; do
    result=0
    "${as_root[@]}" env LC_ALL=C DEBIAN_FRONTEND=noninteractive apt-get -qq "$@" >"$log" 2>&1 || result=$?
    [ "$result" -ne 0 ] && grep -q 'Could not get lock' "$log" || return "$result"
    [ "$try" -ne 1 ] || say "Waiting for another program that holds the lock of apt"
    sleep 5
  done
  return "$result"
}
# Installs the named Debian packages that are not there yet. Quick when nothing is missing.
need() {
  [ -z "${RAINREF_NO_BUILD-}" ] || return 0
  local missing=() name
  for name in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null || true)" = installed ] || missing+=("$name")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  command -v apt-get >/dev/null || die "Missing: ${missing[*]} (this machine has no apt-get; install them and run again)"
  [ "$(id -u)" -eq 0 ] || command -v sudo >/dev/null || die "Missing: ${missing[*]} (install them as root and run again; there is no sudo)"
  say "Installing ${#missing[@]} packages: ${missing[*]}"
  local log
  log=$(mktemp)
  if ! { run_apt "$log" update && run_apt "$log" install -y --no-install-recommends "${missing[@]}"; }; then
    tail -n 5 "$log" >&2
    die "Could not install: ${missing[*]} (whole log: $log)"
  fi
  rm -f "$log"
}

# build PRESET [TARGET...]: configures when needed and builds with a progress line. With simd=machine a new folder gets kernels for this
# machine and the oldest one alone, which is half of the time; everything else wants all of them, and adds those that a folder lacks.
simd=all
build() {
  [ -z "${RAINREF_NO_BUILD-}" ] || return 0
  local preset=$1
  shift
  local folder="build/$preset"
  if [ ! -f "$folder/build.ninja" ] || { [ "$simd" = all ] && grep -q '^RAINREF_SIMD:STRING=machine' "$folder/CMakeCache.txt"; }; then
    say "Configuring $folder"
    cmake --preset "$preset" -DRAINREF_SIMD="$simd" "${configure_options[@]}" >"$folder.log" 2>&1 || { cat "$folder.log" >&2; die "Configuration of $folder failed"; }
  fi
  say "Building $folder"
  NINJA_STATUS="[%f/%t] " cmake --build "$folder" ${1:+--target "$@"} >&2 || die "Build of $folder failed"
}
# run_tests FOLDER: every test of a build. A suite is one entry of ctest, so the tests in them are counted from its log, and what was skipped is
# named. The last line is "N passed, N failed".
run_tests() {
  local result=0
  ctest --test-dir "$1" --output-on-failure --progress -j "$(nproc)" || result=$?
  awk '
    / Testing: / { known = failed; cases = 0 }
    / ms\)$/ && /^\[       OK \]/ { ++passed; ++cases }
    / ms\)$/ && /^\[  SKIPPED \]/ { print "skipped: " $4; ++cases }
    / ms\)$/ && /^\[  FAILED  \]/ { print "failed: " $4; ++failed; ++cases }
    /^Test Passed\.$/ && !cases { ++passed }
    /^Test Failed\.$/ && failed == known { ++failed }  # a program of another kind, or one that ended early
    END { printf "%d passed, %d failed\n", passed, failed }' "$1/Testing/Temporary/LastTest.log"
  return "$result"
}
# port_device DEVICE: sets `at`, the options that give a runner of ports its device: cpu (the software device), gpu (the first GPU), or
# a number of port_runner --list; and `blend`, port_runner's own beside them.
port_device() {
  at=() blend=()
  [ "$1" = gpu ] || at=(--device "$1")
  # The software device filters 8-bit storage in 8 bits, so there the shader blends texels itself.
  [ "$1" != cpu ] || blend=(--spec 3=1)
}
configure_options=()
mkdir -p build
