// What happens to a finished image: added for all of a case's images, and for each of them alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "faults/fault.h"

namespace rainref::faults {

/// The outputs of a case that are images judged by envelope.
inline std::vector<std::size_t> enveloped_images(const capture::PassCase& c) {
  std::vector<std::size_t> out;
  for (std::size_t o = 0; o < c.outputs.size(); ++o)
    if (c.outputs[o].judge == capture::Judge::envelope && !c.outputs[o].array.is_records) out.push_back(o);
  return out;
}

/// alter(image, port's image): false where it does not apply. `sentence`: for the first image that it is said of. The port's images must
/// outlive the fault.
inline void add_to_images(std::vector<Fault>& out, const capture::PassCase& c, const std::vector<capture::Array>& port,
                          const std::string& name, const std::function<std::string(const capture::Array&)>& sentence,
                          const std::function<bool(capture::Array&, const capture::Array&)>& alter) {
  const std::vector<std::size_t> images = enveloped_images(c);
  const auto add = [&](std::string words, std::vector<std::size_t> of) {
    Fault d;
    d.name = std::move(words);
    d.sentence = sentence(c.outputs[of.front()].array);
    d.alter_outputs = [of, alter, &port](const capture::PassCase&, std::vector<capture::Array>& arrays) {
      bool applies = false;
      for (const std::size_t o : of) applies |= alter(arrays[o], port[o]);
      return applies;
    };
    d.for_diagnosis = true;
    out.push_back(std::move(d));
  };
  if (!images.empty()) add(name, images);
  for (std::size_t k = 0; images.size() > 1 && k < images.size(); ++k)
    add(fmt::format("{}: {} alone", name, c.outputs[images[k]].name), {images[k]});
}

}  // namespace rainref::faults
