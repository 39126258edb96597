// Built where CMake found no OSMesa.
#include "base/error.h"
#include "bench/osmesa_peer.h"

namespace crosslight::bench {
namespace {

[[noreturn]] void absent() { throw InternalError("this program was built without OSMesa"); }

}  // namespace

bool osmesaAvailable() { return false; }

struct OsmesaPeer::Impl {};
OsmesaPeer::OsmesaPeer(const GlScene&, std::uint32_t, std::uint32_t, GlPixels) { absent(); }
OsmesaPeer::~OsmesaPeer() = default;
std::string OsmesaPeer::renderer() const { absent(); }
double OsmesaPeer::frame(GlShading) { absent(); }
std::vector<glm::vec4> OsmesaPeer::pixels() const { absent(); }

}  // namespace crosslight::bench
