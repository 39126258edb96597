#include <fmt/format.h>

#include "base/error.h"
#include "gpu/pipeline.h"

namespace crosslight::gpu {

ShaderCode embeddedShader(std::string_view fileName) {
  for (const ShaderCode& code : embeddedShaders()) {
    if (code.name == fileName) return code;
  }
  throw InternalError(fmt::format("the shader '{}' is not compiled into this program", fileName));
}

}  // namespace crosslight::gpu
