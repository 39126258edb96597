# Writes OUTPUT, see BuildInfo.cmake. Arguments: OUTPUT, SOURCE_DIR, VERSION, GIT.
set(commit)
if(GIT)
  execute_process(COMMAND ${GIT} rev-parse HEAD WORKING_DIRECTORY ${SOURCE_DIR}
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT commit)
  set(commit unknown)
endif()
file(WRITE ${OUTPUT}
"// Made by ci/cmake/WriteBuildInfo.cmake.
#include \"app/version.h\"

namespace crosslight {
const char* versionText() { return \"${VERSION}\"; }
const char* commitText() { return \"${commit}\"; }
}  // namespace crosslight
")
