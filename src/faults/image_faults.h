// What happens to a finished image: added for all of a case's images, and for each of them alone.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "faults/fault.h"

namespace rainref::faults {

/// The outputs of a case that are images judged by envelope.
inline std::vector<std::size_t> enveloped_images(const capture::PassCase& c) {
  std::vector<std::size_t> out;
  for (std::size_t o = 0; o < c.outputs.size(); ++o)
    if (c.outputs[o].judge == capture::Judge::envelope && !c.outputs[o].array.is_records) out.push_back(o);
  return out;
}

/// alter(image, port's image): false where it does not apply. what(image): of the first image that it is said of. The port's images must
/// outlive the fault.
inline void add_to_images(std::vector<Fault>& out, const capture::PassCase& c, const std::vector<capture::Array>& port,
                          const std::function<What(const capture::Array&)>& what,
                          const std::function<bool(capture::Array&, const capture::Array&)>& alter) {
  const std::vector<std::size_t> images = enveloped_images(c);
  const auto add = [&](std::vector<std::size_t> of) -> Fault& {
    Fault& d = out.emplace_back(what(c.outputs[of.front()].array));
    d.alter_outputs = [of, alter, &port](const capture::PassCase&, std::vector<capture::Array>& arrays) {
      bool applies = false;
      for (const std::size_t o : of) applies |= alter(arrays[o], port[o]);
      return applies;
    };
    return d;
  };
  if (!images.empty()) add(images);
  for (std::size_t k = 0; images.size() > 1 && k < images.size(); ++k) {
    Fault& d = add({images[k]});
    d.reach = Reach::image_alone;
    d.where = {c.outputs[images[k]].name};
  }
}
inline void add_to_images(std::vector<Fault>& out, const capture::PassCase& c, const std::vector<capture::Array>& port, Kind kind,
                          const std::function<bool(capture::Array&, const capture::Array&)>& alter) {
  add_to_images(
      out, c, port, [kind](const capture::Array&) { return What{kind}; }, alter);
}

}  // namespace rainref::faults
