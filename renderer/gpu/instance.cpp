#include "gpu/instance.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/error.h"

namespace crosslight::gpu {
namespace {

constexpr const char* kLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL collectMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  auto& log = *static_cast<ValidationLog*>(user);
  const std::scoped_lock lock(log.mutex);
  log.messages.emplace_back(data->pMessage);
  return VK_FALSE;
}

// Messages of type "general" come from the loader, "performance" ones are advice: neither says that a rule is broken.
vk::DebugUtilsMessengerCreateInfoEXT messengerInfo(ValidationLog& log) {
  using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
  return vk::DebugUtilsMessengerCreateInfoEXT()
      .setMessageSeverity(Severity::eWarning | Severity::eError)
      .setMessageType(vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation)
      .setPfnUserCallback(collectMessage)
      .setPUserData(&log);
}

void requireLayer(const vk::raii::Context& context) {
  for (const vk::LayerProperties& layer : context.enumerateInstanceLayerProperties()) {
    if (std::strcmp(layer.layerName, kLayer) == 0) return;
  }
  throw DeviceError(
      std::string("validation is asked for, but the layer ") + kLayer +
      " is missing; install it (Debian and Ubuntu: package vulkan-validationlayers) or leave validation off");
}

}  // namespace

bool createInstance(DeviceImpl& device) {
  const auto application = vk::ApplicationInfo().setPApplicationName("crosslight").setApiVersion(VK_API_VERSION_1_3);
  auto info = vk::InstanceCreateInfo().setPApplicationInfo(&application);

  auto messenger = messengerInfo(*device.log);
  const std::array enabled{vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
  const auto features = vk::ValidationFeaturesEXT().setEnabledValidationFeatures(enabled).setPNext(&messenger);
  const std::array layers{kLayer};
  const std::array extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
  if (device.validation) {
    requireLayer(device.context);
    info.setPEnabledLayerNames(layers).setPEnabledExtensionNames(extensions).setPNext(&features);
  }
  try {
    device.instance = vk::raii::Instance(device.context, info);
  } catch (const vk::IncompatibleDriverError&) {
    return false;  // the loader's way to say that it found no driver
  }
  if (device.validation) {
    device.messenger = vk::raii::DebugUtilsMessengerEXT(device.instance, messenger);
  }
  return true;
}

}  // namespace crosslight::gpu
