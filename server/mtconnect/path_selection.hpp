#pragma once

#include <atomic>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "server/mtconnect/agent_request.hpp"
#include "server/mtconnect/device_model.hpp"
#include "server/mtconnect/observation_buffer.hpp"

namespace dripline::mtconnect {

/// The data items that an XPath (`path=`) selects: DataItem elements, and all that lie below
/// selected components. It is evaluated on each device by itself, as if it were the only one in the
/// Devices document, and without namespaces. What it selected of a device is kept until the device
/// changes. A hostile expression costs little: its length, the operations on one device, the time
/// for all devices and the number of evaluations at once are bounded. Any thread.
class PathSelection {
 public:
  static constexpr std::size_t kMaxKept = 256;                ///< expressions; the oldest goes
  static constexpr std::size_t kMaxAnswers = 16;              ///< of one expression, by device
  static constexpr std::uint64_t kOperations = 50'000;        ///< of libxml2, on one device
  static constexpr std::chrono::milliseconds kMaxTime{1000};  ///< of the processor, on all devices
  static constexpr int kMaxAtOnce = 2;                        ///< evaluations of new expressions

  /// Errors: INVALID_PATH (not an XPath, no node set, selects nothing, takes too long), and 503
  /// with INTERNAL_ERROR while too many are evaluated.
  Asked<std::shared_ptr<const ItemSet>> select(const Model& model, const Device* only,
                                               const std::string& path);

 private:
  struct Selected {
    std::uint64_t revision = 0;        ///< of the device; 0: not evaluated yet
    std::vector<std::uint32_t> items;  ///< in Model::items
  };
  struct Kept {
    std::mutex mutex;  ///< held while it is evaluated
    std::vector<Selected> devices;
    std::optional<AgentError> error;
    /// The last answers, by device (-1: all) and the model's revision.
    std::uint64_t revision = 0;
    std::map<std::int64_t, std::shared_ptr<const ItemSet>> answers;
  };
  std::shared_ptr<Kept> keep(const std::string& path);
  void evaluate(Kept& kept, const Model& model, const std::string& path);

  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Kept>> kept_;
  std::list<std::string> order_;  ///< oldest first
  std::atomic<int> evaluations_ = 0;
};

/// The data items of `device` that the path selects, in Model::items. Errors: INVALID_PATH.
Asked<std::vector<std::uint32_t>> select_items(const Model& model, const Device& device,
                                               const std::string& path);

}  // namespace dripline::mtconnect
