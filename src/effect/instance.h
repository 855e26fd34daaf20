// A running effect, whichever it is.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "effect/drops_layer.h"
#include "image_io/write.h"
#include "rainref/image.h"
#include "rainref/recorder.h"
#include "state/items.h"

namespace rainref::effect {

/// What the effect's pass display makes of which picture, for a picture that is developed in another way.
struct Display {
  enum class Code : std::uint8_t { srgb, power };  ///< IEC 61966-2-1, or the published power 0.4545

  const Image* radiance = nullptr;  ///< linear, four channels of 16 or 32 bits, row 0 = bottom: what display reads
  double exposure = 0;              ///< EV
  double vignette = 0;              ///< loss of light at a distance of the picture's width, or height, from its centre
  Code code = Code::srgb;
};

/// A picture of an effect that is no frame of it: a map that it baked.
struct Map {
  const char* name;
  const Image* image;  ///< row 0 = bottom
};

class Instance {
 public:
  virtual ~Instance() = default;
  /// To the next frame: 0, 1, 2 ...
  virtual void simulate(Recorder* recorder) = 0;
  /// The frame that was simulated last.
  virtual void render(Recorder* recorder) = 0;
  /// In place of render, where the picture is not wanted: what it leaves for later frames, whose pictures are the same.
  virtual void skip(Recorder* /*recorder*/) {}
  /// Lists what is held between frames. Loading it gives a simulation that goes on with the same bits; pictures come with the next render.
  virtual void list_state(state::Items& items) = 0;
  /// Frames simulated so far.
  virtual int frame() const = 0;
  /// The picture as display code, row 0 = bottom.
  virtual const Image& picture() const = 0;
  /// How that picture came about; none where it is not a linear one's.
  virtual std::optional<Display> display() const { return std::nullopt; }
  /// What the effect holds between frames, by the names of its EffectInfo: images with row 0 = bottom, and records. Valid until the next
  /// call of a member that is not const.
  virtual std::vector<PassOutput> buffers() = 0;
  /// What an EXR file of the frame holds, row 0 = bottom.
  virtual std::vector<image_io::Layer> layers() const = 0;
  /// Whether drops_layer() says something of this effect in this variant.
  virtual bool has_drops_layer() const { return false; }
  /// The drops of the frame that was rendered last, by themselves.
  virtual DropsLayer drops_layer(const parallel::Executor& /*executor*/) const { return {}; }
  /// What goes into files of its own beside the first EXR.
  virtual std::vector<Map> maps() const { return {}; }
};

/// T: a class of include/rainref; all of them have one shape.
template <class T>
class InstanceOf : public Instance {
 public:
  void simulate(Recorder* recorder) final { effect_.simulate(recorder); }
  void render(Recorder* recorder) final {
    show_pictures_of(std::max(0, effect_.frame() - 1));
    effect_.render(recorder);
  }
  void list_state(state::Items& items) override { effect_.list_state(items); }
  int frame() const final { return effect_.frame(); }
  const Image& picture() const final { return effect_.picture(); }
  const T& running() const { return effect_; }

 protected:
  template <class... Arguments>
  explicit InstanceOf(Arguments&&... arguments) : effect_(std::forward<Arguments>(arguments)...) {}
  /// Hands the effect the pictures of the frame that is rendered next, where they are not those that it has.
  virtual void show_pictures_of(int /*frame*/) {}
  T& changed() { return effect_; }

 private:
  T effect_;
};

}  // namespace rainref::effect
