#include "ports/runner/device.h"

#include <algorithm>
#include <cstring>

namespace port_runner {
namespace {

VkInstance make_instance() {
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "port_runner";
  application.apiVersion = VK_API_VERSION_1_2;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  VkInstance instance = VK_NULL_HANDLE;
  check(vkCreateInstance(&info, nullptr, &instance), "vkCreateInstance (is a Vulkan driver installed? Debian: mesa-vulkan-drivers)");
  return instance;
}

std::optional<std::uint32_t> compute_family(VkPhysicalDevice device) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  for (std::uint32_t i = 0; i < count; ++i) {
    if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) return i;
  }
  return std::nullopt;
}
VkPhysicalDeviceProperties properties_of(VkPhysicalDevice device) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(device, &properties);
  return properties;
}
bool is_software(VkPhysicalDevice device) { return properties_of(device).deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU; }

std::vector<VkPhysicalDevice> devices_of(VkInstance instance) {
  std::uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> all(count);
  check(vkEnumeratePhysicalDevices(instance, &count, all.data()), "vkEnumeratePhysicalDevices");
  std::erase_if(all, [](VkPhysicalDevice d) { return !compute_family(d) || properties_of(d).apiVersion < VK_API_VERSION_1_2; });
  return all;
}

VkPhysicalDevice choose(const std::vector<VkPhysicalDevice>& all, const std::string& choice) {
  if (all.empty()) throw Error("no Vulkan 1.2 device (Debian: mesa-vulkan-drivers has a software device)");
  if (choice.empty() || choice == "cpu") {
    const auto found = std::find_if(all.begin(), all.end(), [&](VkPhysicalDevice d) { return is_software(d) == (choice == "cpu"); });
    if (found != all.end()) return *found;
    if (choice.empty()) return all.front();
    throw UsageError("--device cpu: no software device (Debian: mesa-vulkan-drivers)");
  }
  const bool is_number = choice.find_first_not_of("0123456789") == std::string::npos && choice.size() < 5;
  if (!is_number || std::stoul(choice) >= all.size()) {
    throw UsageError("--device " + choice + ": expected cpu or a number below " + std::to_string(all.size()) + " (--list prints them)");
  }
  return all[std::stoul(choice)];
}

}  // namespace

void check(VkResult result, const char* call) {
  if (result != VK_SUCCESS) throw Error(std::string(call) + ": VkResult " + std::to_string(result));
}

std::vector<std::string> Device::list() {
  const VkInstance instance = make_instance();
  Cleanup cleanup;
  cleanup.add([=] { vkDestroyInstance(instance, nullptr); });
  std::vector<std::string> lines;
  for (const VkPhysicalDevice device : devices_of(instance)) {
    lines.push_back(std::to_string(lines.size()) + "  " + properties_of(device).deviceName + (is_software(device) ? "  (software)" : ""));
  }
  return lines;
}

Device::Device(const std::string& choice) {
  const VkInstance instance = make_instance();
  cleanup_.add([=] { vkDestroyInstance(instance, nullptr); });
  physical_ = choose(devices_of(instance), choice);
  family_ = *compute_family(physical_);

  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  vkGetPhysicalDeviceProperties2(physical_, &properties);
  name_ = properties.properties.deviceName;
  driver_ = std::string(driver.driverName) + " " + driver.driverInfo;
  largest_side_ = properties.properties.limits.maxImageDimension2D;

  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(physical_, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(physical_, nullptr, &count, extensions.data());
  const bool border_extension = std::any_of(extensions.begin(), extensions.end(), [](const VkExtensionProperties& e) {
    return std::strcmp(e.extensionName, VK_EXT_CUSTOM_BORDER_COLOR_EXTENSION_NAME) == 0;
  });
  VkPhysicalDeviceCustomBorderColorFeaturesEXT border{};
  border.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_CUSTOM_BORDER_COLOR_FEATURES_EXT;
  VkPhysicalDeviceFeatures2 has{};
  has.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  if (border_extension) has.pNext = &border;
  vkGetPhysicalDeviceFeatures2(physical_, &has);
  custom_border_ = border.customBorderColors && border.customBorderColorWithoutFormat;

  // Shaders write images without naming the format, so that one shader serves every storage of a buffer.
  if (!has.features.shaderStorageImageExtendedFormats || !has.features.shaderStorageImageWriteWithoutFormat) {
    throw Error(name_ + ": storage images of two channels, or without a format in the shader, are not supported");
  }
  VkPhysicalDeviceFeatures2 wanted{};
  wanted.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  wanted.features.shaderStorageImageExtendedFormats = VK_TRUE;
  wanted.features.shaderStorageImageWriteWithoutFormat = VK_TRUE;
  if (custom_border_) wanted.pNext = &border;
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  const char* const extension = VK_EXT_CUSTOM_BORDER_COLOR_EXTENSION_NAME;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &wanted;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = custom_border_ ? 1 : 0;
  info.ppEnabledExtensionNames = &extension;
  check(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
  cleanup_.add([this] { vkDestroyDevice(device_, nullptr); });
  vkGetDeviceQueue(device_, family_, 0, &queue_);
}

void Device::require(VkFormat format, VkFormatFeatureFlags features, std::uint32_t width, std::uint32_t height,
                     const std::string& what) const {
  if (width == 0 || height == 0 || width > largest_side_ || height > largest_side_) {
    throw Error(what + ": " + std::to_string(width) + " x " + std::to_string(height) + " texels; " + name_ + " takes 1 to " +
                std::to_string(largest_side_));
  }
  VkFormatProperties properties;
  vkGetPhysicalDeviceFormatProperties(physical_, format, &properties);
  if ((properties.optimalTilingFeatures & features) != features) {
    const bool filter = (features & ~properties.optimalTilingFeatures) == VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    throw Error(what + ": " + name_ + " does not support this format as " +
                (filter ? "a linearly filtered texture; fetch texels and blend them in the shader" : "this kind of image"));
  }
}

std::uint32_t Device::memory_type(std::uint32_t allowed, VkMemoryPropertyFlags wanted) const {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(physical_, &memory);
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    if ((allowed >> i & 1) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  }
  throw Error(name_ + ": no memory of the kind needed");
}

HostBuffer Device::host_buffer(std::size_t size, VkBufferUsageFlags usage, Cleanup& owner) const {
  HostBuffer made;
  made.size = size;
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size;
  info.usage = usage;
  check(vkCreateBuffer(device_, &info, nullptr, &made.buffer), "vkCreateBuffer");
  owner.add([device = device_, buffer = made.buffer] { vkDestroyBuffer(device, buffer, nullptr); });
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device_, made.buffer, &needs);
  VkMemoryAllocateInfo allocation{};
  allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocation.allocationSize = needs.size;
  allocation.memoryTypeIndex =
      memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(device_, &allocation, nullptr, &memory), "vkAllocateMemory");
  owner.add([device = device_, memory] { vkFreeMemory(device, memory, nullptr); });
  check(vkBindBufferMemory(device_, made.buffer, memory, 0), "vkBindBufferMemory");
  void* mapped = nullptr;
  check(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
  made.bytes = static_cast<std::uint8_t*>(mapped);
  return made;
}

DeviceImage Device::image(VkFormat format, std::uint32_t width, std::uint32_t height, std::uint32_t levels, VkImageUsageFlags usage,
                          Cleanup& owner) const {
  DeviceImage made;
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {width, height, 1};
  info.mipLevels = levels;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = usage;
  check(vkCreateImage(device_, &info, nullptr, &made.image), "vkCreateImage");
  owner.add([device = device_, image = made.image] { vkDestroyImage(device, image, nullptr); });
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device_, made.image, &needs);
  VkMemoryAllocateInfo allocation{};
  allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocation.allocationSize = needs.size;
  allocation.memoryTypeIndex = memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(device_, &allocation, nullptr, &memory), "vkAllocateMemory");
  owner.add([device = device_, memory] { vkFreeMemory(device, memory, nullptr); });
  check(vkBindImageMemory(device_, made.image, memory, 0), "vkBindImageMemory");
  VkImageViewCreateInfo view{};
  view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  view.image = made.image;
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, levels, 0, 1};
  check(vkCreateImageView(device_, &view, nullptr, &made.view), "vkCreateImageView");
  owner.add([device = device_, v = made.view] { vkDestroyImageView(device, v, nullptr); });
  return made;
}

}  // namespace port_runner
