// What a port says about itself: port.json beside its dumps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "port_dump/encoding.h"
#include "rainref/storage.h"

namespace rainref::port_dump {

/// The row that is first in a file. top_left: the first stored row is row 0, v = 0 of the pass. bottom_left: the last stored row is row 0,
/// because the exporter flipped the picture.
enum class Origin : std::uint8_t { top_left, bottom_left };

struct PortInfo {
  std::string api;                      ///< begins with the name of one of apis() (apis.h); "" if it is not said
  std::string device, driver;           ///< for reports
  std::optional<Rounding> half_store;   ///< how a store to binary16 rounds; nothing if unknown
  std::optional<bool> flush_denormals;  ///< subnormal results become zero; nothing if unknown
  Origin origin = Origin::top_left;     ///< for every image of the dump unless its sidecar overrides it
  Encodings encodings;                  ///< of buffers that the port keeps in its own way
  bool precise = false;                 ///< the port states that it requested no contraction and no reassociation
  std::string notes;
};

/// The keys api, device, driver, half_store ("rne", "rtz", "unknown"), flush_denormals, origin ("top-left", "bottom-left"), encodings
/// (sources or members by buffer), precise and notes, each optional; `file` is quoted and starts every message. Throws Error(port_files)
/// with the key, expected, found, and the nearest known key or API.
PortInfo parse_port_info(std::string_view text, const std::string& file);

/// port.json of the folder; the defaults above if there is none. Throws Error(io) if it cannot be read.
PortInfo read_port_info(const std::filesystem::path& folder);

}  // namespace rainref::port_dump
