#include "ports/runner/dispatch.h"

#include <algorithm>
#include <chrono>
#include <cstring>

namespace port_runner {
namespace {

constexpr std::size_t count_bytes = 16;  // what stands before the records of an output

const Buffer* find(const std::vector<Buffer>& buffers, const std::string& name) {
  const auto found = std::find_if(buffers.begin(), buffers.end(), [&](const Buffer& b) { return b.name == name; });
  return found == buffers.end() ? nullptr : &*found;
}
std::vector<std::size_t> shape_of(const Buffer& b, const Level& level) {
  std::vector<std::size_t> shape{level.height, level.width};
  if (b.format.channels > 1) shape.push_back(b.format.channels);
  return shape;
}
std::vector<std::uint8_t> load(const Pack& pack, const Buffer& b, const Level& level) {
  std::vector<std::uint8_t> bytes = read_npy(pack.folder / level.file, b.format.type, shape_of(b, level));
  if (bytes.size() != std::size_t{level.width} * level.height * b.format.bytes_per_texel) {
    throw FileError((pack.folder / level.file).string() + ": " + std::to_string(bytes.size()) + " bytes of texels do not fill the shape");
  }
  return bytes;
}

VkSamplerAddressMode address_mode(const std::string& address, const std::string& buffer) {
  const std::map<std::string, VkSamplerAddressMode> modes{{"clamp", VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE},
                                                          {"repeat", VK_SAMPLER_ADDRESS_MODE_REPEAT},
                                                          {"mirror", VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT},
                                                          {"border", VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER}};
  const auto found = modes.find(address);
  if (found == modes.end()) throw Error("buffer " + buffer + ": unknown address rule " + address);
  return found->second;
}

// Everything of one dispatch; what it makes lives until it goes.
class Run {
 public:
  Run(const Device& device, const Pack& pack, const Case& of, const Program& program)
      : device_(device), pack_(pack), case_(of), program_(program) {
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = device.queue_family();
    check(vkCreateCommandPool(device.handle(), &pool, nullptr, &pool_), "vkCreateCommandPool");
    cleanup_.add([this] { vkDestroyCommandPool(device_.handle(), pool_, nullptr); });
    VkCommandBufferAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocate.commandPool = pool_;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device.handle(), &allocate, &commands_), "vkAllocateCommandBuffers");
    begin_commands();
  }
  std::vector<Array> run(const Constants& constants) {
    prepare(constants);
    record_dispatch();
    record_read_back();
    submit();
    return read_outputs();
  }
  std::vector<double> time(const Constants& constants, double seconds) {
    prepare(constants);
    submit();
    std::vector<double> goes;
    const auto begin = std::chrono::steady_clock::now();
    // The first goes are not counted: a software device compiles the shader in them.
    for (int go = 0; go < 5 || std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < seconds; ++go) {
      begin_commands();
      record_dispatch();
      const auto start = std::chrono::steady_clock::now();
      submit();
      if (go >= 2) goes.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return goes;
  }

 private:
  void begin_commands() {
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
  }
  // Records the uploads, and makes what a dispatch takes.
  void prepare(const Constants& constants) {
    bind_uniforms();
    for (const std::string& name : program_.inputs) bind_input(name);
    for (const std::string& name : program_.outputs) bind_output(name);
    layout_ = make_descriptors(set_);
    pipeline_ = make_pipeline(layout_, constants);
  }
  struct Binding {
    VkDescriptorType type;
    VkDescriptorBufferInfo buffer{};
    VkDescriptorImageInfo image{};
  };
  struct Output {
    const Buffer* buffer;
    HostBuffer host;
    VkImage image = VK_NULL_HANDLE;
  };

  HostBuffer storage(std::size_t size) {
    const HostBuffer made = device_.host_buffer(size, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, cleanup_);
    std::memset(made.bytes, 0, size);
    bindings_.push_back({VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, {made.buffer, 0, size}, {}});
    return made;
  }
  void bind_uniforms() {
    const fs::path file = pack_.folder / case_.uniform_file;
    const std::vector<std::uint8_t> bytes = read_file(file);
    if (bytes.size() != case_.uniform_bytes) {
      throw FileError(file.string() + ": expected " + std::to_string(case_.uniform_bytes) + " bytes, found " +
                      std::to_string(bytes.size()));
    }
    const HostBuffer made = device_.host_buffer(bytes.size(), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, cleanup_);
    std::copy(bytes.begin(), bytes.end(), made.bytes);
    bindings_.push_back({VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, {made.buffer, 0, bytes.size()}, {}});
  }

  void transition(VkImage image, std::uint32_t levels, VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, levels, 0, 1};
    vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1,
                         &barrier);
  }
  void sample(const Buffer& b, const std::vector<std::vector<std::uint8_t>>& texels) {
    const auto levels = static_cast<std::uint32_t>(b.levels.size());
    VkFormatFeatureFlags features = VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_TRANSFER_DST_BIT;
    if (b.filter == "linear") features |= VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    device_.require(b.format.vulkan, features, b.levels[0].width, b.levels[0].height, case_.id + ", input " + b.name);
    const DeviceImage image = device_.image(b.format.vulkan, b.levels[0].width, b.levels[0].height, levels,
                                            VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, cleanup_);
    transition(image.image, levels, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    for (std::uint32_t i = 0; i < levels; ++i) {
      const HostBuffer staging = device_.host_buffer(texels[i].size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, cleanup_);
      std::copy(texels[i].begin(), texels[i].end(), staging.bytes);
      VkBufferImageCopy copy{};
      copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, i, 0, 1};
      copy.imageExtent = {b.levels[i].width, b.levels[i].height, 1};
      vkCmdCopyBufferToImage(commands_, staging.buffer, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    }
    transition(image.image, levels, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    bindings_.push_back(
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, {}, {sampler(b), image.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}});
  }
  VkSampler sampler(const Buffer& b) {
    VkSamplerCustomBorderColorCreateInfoEXT custom{};
    custom.sType = VK_STRUCTURE_TYPE_SAMPLER_CUSTOM_BORDER_COLOR_CREATE_INFO_EXT;
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = b.filter == "linear" ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    info.mipmapMode = b.mip_filter == "linear" ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = address_mode(b.address_u, b.name);
    info.addressModeV = address_mode(b.address_v, b.name);
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.maxLod = VK_LOD_CLAMP_NONE;
    info.borderColor = VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK;
    const std::vector<float>& border = b.border;
    if (std::any_of(border.begin(), border.end(), [](float x) { return x != 0; })) {
      if (border.size() != 4) throw Error("buffer " + b.name + ": a border has four channels");
      if (!device_.custom_border_colours()) throw Error("buffer " + b.name + ": " + device_.name() + " has no VK_EXT_custom_border_color");
      std::copy(border.begin(), border.end(), custom.customBorderColor.float32);
      info.borderColor = VK_BORDER_COLOR_FLOAT_CUSTOM_EXT;
      info.pNext = &custom;
    }
    VkSampler made = VK_NULL_HANDLE;
    check(vkCreateSampler(device_.handle(), &info, nullptr, &made), "vkCreateSampler");
    cleanup_.add([this, made] { vkDestroySampler(device_.handle(), made, nullptr); });
    return made;
  }
  void bind_input(const std::string& name) {
    const Buffer* b = find(case_.inputs, name);
    if (b != nullptr && b->is_records) {
      const std::vector<std::uint8_t> bytes = read_npy(pack_.folder / b->file, b->record_type, {b->count});
      if (bytes.size() != b->count * b->record_bytes) {
        throw FileError((pack_.folder / b->file).string() + ": " + std::to_string(bytes.size()) +
                        " bytes of records do not fill the shape");
      }
      const HostBuffer made = storage(std::max(bytes.size(), b->record_bytes));
      std::copy(bytes.begin(), bytes.end(), made.bytes);
      return;
    }
    if (b != nullptr) {
      std::vector<std::vector<std::uint8_t>> texels;
      for (const Level& level : b->levels) texels.push_back(load(pack_, *b, level));
      return sample(*b, texels);
    }
    if (std::find(program_.lists.begin(), program_.lists.end(), name) != program_.lists.end()) {
      constexpr std::size_t largest_record = 256;
      storage(largest_record);
      return;
    }
    Buffer absent;
    absent.name = name;
    absent.format = {VK_FORMAT_R32_SFLOAT, "'<f4'", 1, 4};
    absent.levels = {{1, 1, ""}};
    absent.address_u = absent.address_v = "clamp";
    sample(absent, {std::vector<std::uint8_t>(4)});
  }
  void bind_output(const std::string& name) {
    const Buffer* b = find(case_.outputs, name);
    if (b == nullptr) throw Error(case_.id + ": the pack expects no output " + name);
    if (b->is_records) {
      outputs_.push_back({b, storage(count_bytes + program_.capacity * b->record_bytes)});
      return;
    }
    const Level& size = b->levels[0];
    device_.require(b->format.vulkan, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT | VK_FORMAT_FEATURE_TRANSFER_SRC_BIT, size.width, size.height,
                    case_.id + ", output " + name);
    const DeviceImage image =
        device_.image(b->format.vulkan, size.width, size.height, 1,
                      VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, cleanup_);
    transition(image.image, 1, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
    // A texel that the shader leaves out must not look right by chance.
    const VkClearColorValue blank{};
    const VkImageSubresourceRange whole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(commands_, image.image, VK_IMAGE_LAYOUT_GENERAL, &blank, 1, &whole);
    transition(image.image, 1, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_GENERAL);
    bindings_.push_back({VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, {}, {VK_NULL_HANDLE, image.view, VK_IMAGE_LAYOUT_GENERAL}});
    const std::size_t bytes = std::size_t{size.width} * size.height * b->format.bytes_per_texel;
    outputs_.push_back({b, device_.host_buffer(bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, cleanup_), image.image});
  }

  // Sets the descriptors and returns the layout of the pipeline.
  VkPipelineLayout make_descriptors(VkDescriptorSet& set) {
    std::vector<VkDescriptorSetLayoutBinding> places;
    std::vector<VkDescriptorPoolSize> sizes;
    for (std::uint32_t i = 0; i < bindings_.size(); ++i) {
      places.push_back({i, bindings_[i].type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
      sizes.push_back({bindings_[i].type, 1});
    }
    VkDescriptorSetLayoutCreateInfo layout_info{};
    layout_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    layout_info.bindingCount = static_cast<std::uint32_t>(places.size());
    layout_info.pBindings = places.data();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(device_.handle(), &layout_info, nullptr, &layout), "vkCreateDescriptorSetLayout");
    cleanup_.add([this, layout] { vkDestroyDescriptorSetLayout(device_.handle(), layout, nullptr); });
    VkDescriptorPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool_info.maxSets = 1;
    pool_info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool_info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device_.handle(), &pool_info, nullptr, &pool), "vkCreateDescriptorPool");
    cleanup_.add([this, pool] { vkDestroyDescriptorPool(device_.handle(), pool, nullptr); });
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = pool;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &layout;
    check(vkAllocateDescriptorSets(device_.handle(), &allocate, &set), "vkAllocateDescriptorSets");
    for (std::uint32_t i = 0; i < bindings_.size(); ++i) {
      VkWriteDescriptorSet write{};
      write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
      write.dstSet = set;
      write.dstBinding = i;
      write.descriptorCount = 1;
      write.descriptorType = bindings_[i].type;
      write.pBufferInfo = &bindings_[i].buffer;
      write.pImageInfo = &bindings_[i].image;
      vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
    }
    VkPipelineLayoutCreateInfo pipeline_info{};
    pipeline_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    pipeline_info.setLayoutCount = 1;
    pipeline_info.pSetLayouts = &layout;
    VkPipelineLayout made = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(device_.handle(), &pipeline_info, nullptr, &made), "vkCreatePipelineLayout");
    cleanup_.add([this, made] { vkDestroyPipelineLayout(device_.handle(), made, nullptr); });
    return made;
  }
  VkPipeline make_pipeline(VkPipelineLayout layout, Constants constants) {
    for (const Fact& fact : program_.constants) constants.emplace(fact.id, value(fact, case_));
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<std::int32_t> values;
    for (const auto& [id, number] : constants) {
      entries.push_back({id, static_cast<std::uint32_t>(4 * values.size()), 4});
      values.push_back(number);
    }
    const VkSpecializationInfo specialization{static_cast<std::uint32_t>(entries.size()), entries.data(), 4 * values.size(), values.data()};
    const std::vector<std::uint8_t> bytes = read_file(program_.spirv);
    std::vector<std::uint32_t> code(bytes.size() / 4);
    std::memcpy(code.data(), bytes.data(), 4 * code.size());
    if (code.empty() || bytes.size() % 4 != 0 || code[0] != 0x07230203) throw FileError(program_.spirv.string() + ": expected SPIR-V");
    VkShaderModuleCreateInfo module_info{};
    module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module_info.codeSize = bytes.size();
    module_info.pCode = code.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device_.handle(), &module_info, nullptr, &module), "vkCreateShaderModule");
    cleanup_.add([this, module] { vkDestroyShaderModule(device_.handle(), module, nullptr); });
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &specialization;
    info.layout = layout;
    VkPipeline made = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(device_.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &made), "vkCreateComputePipelines");
    cleanup_.add([this, made] { vkDestroyPipeline(device_.handle(), made, nullptr); });
    return made;
  }
  void record_dispatch() {
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
    std::uint32_t columns = 1, rows = 1;
    const Buffer& first = *outputs_.at(0).buffer;
    if (!program_.one_group) {
      columns = (first.levels[0].width + program_.group[0] - 1) / program_.group[0];
      rows = (first.levels[0].height + program_.group[1] - 1) / program_.group[1];
    }
    vkCmdDispatch(commands_, columns, rows, 1);
  }
  void record_read_back() {
    for (const Output& out : outputs_) {
      if (out.buffer->is_records) continue;
      transition(out.image, 1, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
      VkBufferImageCopy copy{};
      copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
      copy.imageExtent = {out.buffer->levels[0].width, out.buffer->levels[0].height, 1};
      vkCmdCopyImageToBuffer(commands_, out.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, out.host.buffer, 1, &copy);
    }
    VkMemoryBarrier to_host{};
    to_host.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    to_host.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    to_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0, nullptr, 0, nullptr);
  }
  // And waits until the device has done it.
  void submit() {
    check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands_;
    check(vkQueueSubmit(device_.queue(), 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
    check(vkQueueWaitIdle(device_.queue()), "vkQueueWaitIdle");
  }
  std::vector<Array> read_outputs() const {
    std::vector<Array> arrays;
    for (const Output& out : outputs_) {
      const Buffer& b = *out.buffer;
      const std::uint8_t* from = out.host.bytes;
      if (!b.is_records) {
        arrays.push_back({b.format.type, shape_of(b, b.levels[0]), {from, from + out.host.size}});
        continue;
      }
      std::uint32_t count = 0;
      std::memcpy(&count, from, 4);
      if (count > program_.capacity) {
        throw Error(case_.id + ": the program counts " + std::to_string(count) + " records, there is room for " +
                    std::to_string(program_.capacity));
      }
      from += count_bytes;
      arrays.push_back({b.record_type, {count}, {from, from + count * b.record_bytes}});
    }
    return arrays;
  }

  const Device& device_;
  const Pack& pack_;
  const Case& case_;
  const Program& program_;
  Cleanup cleanup_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  std::vector<Binding> bindings_;
  std::vector<Output> outputs_;
};

}  // namespace

std::vector<Array> run_case(const Device& device, const Pack& pack, const Case& of, const Program& program, const Constants& extra) {
  Run run(device, pack, of, program);
  return run.run(extra);
}

std::vector<double> time_case(const Device& device, const Pack& pack, const Case& of, const Program& program, const Constants& extra,
                              double seconds) {
  Run run(device, pack, of, program);
  return run.time(extra, seconds);
}

}  // namespace port_runner
