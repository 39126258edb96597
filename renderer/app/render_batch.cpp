#include "app/render_batch.h"

#include <fmt/format.h>

#include <iostream>
#include <iterator>
#include <map>

#include "app/command_line.h"
#include "app/render_work.h"
#include "base/error.h"
#include "base/file.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/time.h"

namespace crosslight {
namespace {

constexpr std::uint64_t kMostBatchBytes = std::uint64_t{1} << 28;  // a million items of 256 bytes

std::string textOf(const std::string& file) {
  if (file == "-") return {std::istreambuf_iterator<char>(std::cin), {}};
  const std::vector<std::byte> bytes = readFile(file, kMostBatchBytes);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// All that can be said before anything is drawn: a batch with a mistake in it draws nothing.
std::vector<RenderWork> checkedItems(const RenderOptions& options) {
  const std::string where = options.batch == "-" ? "standard input" : options.batch;
  std::vector<RenderWork> work;
  std::map<std::string, std::size_t> writers;
  for (const RenderOptions& item : batchItems(textOf(options.batch), where, options)) {
    const std::string place = fmt::format("{}: item {}", where, work.size() + 1);
    try {
      work.push_back(checkedWork(item));
    } catch (const UsageError& error) {
      throw InputError(place, error.what());
    }
    const auto [first, isNew] = writers.emplace(item.output, work.size());
    if (!isNew) throw InputError(place, fmt::format("writes '{}', as item {} does", item.output, first->second));
  }
  return work;
}

struct Failure {
  ExitCode code = ExitCode::ok;
  std::string text;
};

class Batch {
 public:
  Batch(const RenderOptions& options, const CommonOptions& common)
      : options_(options), common_(common), work_(checkedItems(options)), device_(options.device) {
    for (const RenderWork& work : work_) {
      if (work.frames.empty()) scenes_.expect(work.options);
    }
  }

  void run() {
    const Stopwatch total;
    for (std::size_t i = 0; i < work_.size(); ++i) {
      throwIfInterrupted();
      runItem(i);
      if (failed_ > 0 && options_.stopOnError) break;
    }
    if (!options_.json.empty()) writeRecord(options_.json, record(total.elapsedMs()));
    logInfo(fmt::format("{} of {} items drawn in {:.0f} ms", done_, work_.size(), total.elapsedMs()));
    if (failed_ == 0) return;
    throw Error(first_.code,
                fmt::format("{} of {} items failed, the first one: {}", failed_, work_.size(), first_.text));
  }

 private:
  void runItem(std::size_t index) {
    const RenderWork& work = work_[index];
    RenderContext context{device_, scenes_, common_, fmt::format("{}/{} ", index + 1, work_.size())};
    Json record;
    try {
      checkPlaces(work);
      record = runWork(work, context);
      if (!work.options.json.empty()) writeRecord(work.options.json, record);
      record["item"] = index + 1;
      record["exitCode"] = 0;
      ++done_;
    } catch (const Interrupted&) {
      throw;
    } catch (const Error& error) {
      record = failure(index, error.code(), error.what());
    } catch (const std::bad_alloc&) {
      record = failure(index, ExitCode::internal, "out of memory; a smaller resolution or scene needs less");
    } catch (const std::exception& error) {
      record = failure(index, ExitCode::internal, std::string("internal error: ") + error.what());
    }
    records_.push_back(std::move(record));
    release(work);
  }

  // Scenes are let go after their last item, on the host and on the device.
  void release(const RenderWork& work) {
    if (!work.frames.empty()) return;
    const std::shared_ptr<const Scene> scene = scenes_.loaded(work.options);
    const bool last = scenes_.release(work.options);
    if (last && scene != nullptr && device_.isOpen()) device_.session().forget(*scene);
  }

  Json failure(std::size_t index, ExitCode code, const std::string& what) {
    const std::string text = fmt::format("item {} ({}): {}", index + 1, work_[index].options.output, what);
    logError(text);
    if (failed_++ == 0) first_ = {code, text};
    return {{"item", index + 1},
            {"output", work_[index].options.output},
            {"exitCode", static_cast<int>(code)},
            {"error", what}};
  }

  Json record(double totalMs) {
    const gpu::DeviceInfo* info = device_.isOpen() ? &device_.get().info() : nullptr;
    Json record = newRecord({"render", common_.arguments, {}, info, {{"total", totalMs}}});
    record["batch"] = options_.batch;
    record["items"] = records_;
    record["summary"] = {{"items", work_.size()},
                         {"done", done_},
                         {"failed", failed_},
                         {"skipped", work_.size() - done_ - failed_},
                         {"exitCode", static_cast<int>(first_.code)}};
    return record;
  }

  const RenderOptions& options_;
  const CommonOptions& common_;
  std::vector<RenderWork> work_;
  LazyDevice device_;
  SceneStore scenes_;
  Json records_ = Json::array();
  std::size_t done_ = 0, failed_ = 0;
  Failure first_;
};

}  // namespace

void runBatch(const RenderOptions& options, const CommonOptions& common) {
  checkRecordPlace(options.json);
  Batch(options, common).run();
}

}  // namespace crosslight
