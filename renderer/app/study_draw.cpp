#include "app/study_draw.h"

#include "base/log.h"

namespace crosslight {
namespace {

class Silence {
 public:
  Silence() : level_(logLevel()) { setLogLevel(LogLevel::quiet); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  ~Silence() { setLogLevel(level_); }

 private:
  LogLevel level_;
};

}  // namespace

study::Draw drawBy(RenderSession& session) {
  return [&session](const Scene& scene, const RenderSettings& settings) {
    const Silence silence;
    RenderRequest request{std::make_shared<const Scene>(scene), settings};
    request.settings.allowNonfinite = true;
    RenderResult result = session.render(request);
    session.forget(*request.scene);
    return study::Shot{std::move(result.image), result.report.nonfinite};
  };
}

}  // namespace crosslight
