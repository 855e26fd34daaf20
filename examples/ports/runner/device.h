// A Vulkan device with one compute queue, and memory on it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "ports/runner/npy.h"

namespace port_runner {

/// Throws Error unless the call succeeded.
void check(VkResult result, const char* call);

/// Runs what undoes each creation, last first.
class Cleanup {
 public:
  Cleanup() = default;
  Cleanup(const Cleanup&) = delete;
  Cleanup& operator=(const Cleanup&) = delete;
  ~Cleanup() {
    for (auto undo = undo_.rbegin(); undo != undo_.rend(); ++undo) (*undo)();
  }
  void add(std::function<void()> undo) { undo_.push_back(std::move(undo)); }

 private:
  std::vector<std::function<void()>> undo_;
};

/// Host-visible memory under a buffer, mapped as long as it lives.
struct HostBuffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  std::uint8_t* bytes = nullptr;
  std::size_t size = 0;
};
struct DeviceImage {
  VkImage image = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
};

class Device {
 public:
  /// choice: a number of list(), "cpu" for the first software device, or empty for the first GPU, else the software
  /// device. Throws Error.
  explicit Device(const std::string& choice);

  /// One line for each device that can compute.
  static std::vector<std::string> list();

  VkDevice handle() const { return device_; }
  VkQueue queue() const { return queue_; }
  std::uint32_t queue_family() const { return family_; }
  bool custom_border_colours() const { return custom_border_; }
  const std::string& name() const { return name_; }
  const std::string& driver() const { return driver_; }
  /// Throws Error when an image of this format and size cannot be used so, naming what.
  void require(VkFormat format, VkFormatFeatureFlags features, std::uint32_t width, std::uint32_t height, const std::string& what) const;

  /// Live as long as `owner`.
  HostBuffer host_buffer(std::size_t size, VkBufferUsageFlags usage, Cleanup& owner) const;
  DeviceImage image(VkFormat format, std::uint32_t width, std::uint32_t height, std::uint32_t levels, VkImageUsageFlags usage,
                    Cleanup& owner) const;

 private:
  std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags wanted) const;

  Cleanup cleanup_;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::uint32_t family_ = 0, largest_side_ = 0;
  bool custom_border_ = false;
  std::string name_, driver_;
};

}  // namespace port_runner
