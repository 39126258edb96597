// Asks the device for single operations of the shading language and for single functions of the shaders.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "gpu/device.h"
#include "probe_functions.h"

namespace crosslight::study {

#define CL_PROBE_ROW(value, name, expression) name = value,
enum class Operation : std::uint32_t { CL_PROBE_OPERATIONS(CL_PROBE_ROW) };
#undef CL_PROBE_ROW
#define CL_PROBE_ROW(value, name) name = value,
enum class Function : std::uint32_t { CL_PROBE_FUNCTIONS(CL_PROBE_ROW) };
#undef CL_PROBE_ROW

using shared::ProbeAnswer;
using shared::ProbeArguments;

std::vector<float> askOperation(const gpu::Device& device, Operation operation,
                                const std::vector<glm::vec3>& arguments);

// `corners`: three per triangle, of Function::mesh.
std::vector<ProbeAnswer> askFunction(const gpu::Device& device, Function function,
                                     const std::vector<ProbeArguments>& arguments,
                                     const std::vector<glm::vec3>& corners = {});

}  // namespace crosslight::study
