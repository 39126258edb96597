# Writes OUTPUT, a C++ source with the SPIR-V of all FILES as word arrays (little endian, as SPIR-V files are here).
set(arrays "")
set(table "")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME_WLE)
  string(MAKE_C_IDENTIFIER ${name} identifier)
  file(READ ${file} hex HEX)
  string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
  string(APPEND arrays "constexpr std::uint32_t k_${identifier}[] = {${words}};\n")
  string(APPEND table "    ShaderCode{\"${name}\", k_${identifier}},\n")
endforeach()
list(LENGTH FILES count)
# std::array, because an array of no elements is ill-formed.
file(WRITE ${OUTPUT}.new
"// Made by ci/cmake/EmbedShaders.cmake.
#include <array>

#include \"gpu/pipeline.h\"

namespace crosslight::gpu {
namespace {
${arrays}
constexpr std::array<ShaderCode, ${count}> kShaders{
${table}};
}  // namespace
std::span<const ShaderCode> embeddedShaders() { return kShaders; }
}  // namespace crosslight::gpu
")
file(COPY_FILE ${OUTPUT}.new ${OUTPUT} ONLY_IF_DIFFERENT)
file(REMOVE ${OUTPUT}.new)
file(TOUCH ${OUTPUT})
