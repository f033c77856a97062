#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <nlohmann/json_fwd.hpp>

#include "clients/tools/offline/check_summary.hpp"
#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "server/machines/run_sources.hpp"

/// What every interpretation of a stored program needs.
namespace dripline::paths {

inline constexpr interpreter::OfflineLimits kLimits{.max_blocks = 100'000'000,
                                                    .max_repeated_blocks = 1'000'000};

/// One of the places that bound the work of all readers.
class Seat {
 public:
  static std::optional<Seat> take(const std::shared_ptr<std::atomic<int>>& readers, int limit) {
    if (readers->fetch_add(1) < limit) return Seat(readers);
    readers->fetch_sub(1);
    return std::nullopt;
  }
  Seat(Seat&&) noexcept = default;
  Seat& operator=(Seat&&) = delete;
  ~Seat() {
    if (readers_) readers_->fetch_sub(1);
  }

 private:
  explicit Seat(std::shared_ptr<std::atomic<int>> readers) : readers_(std::move(readers)) {}

  std::shared_ptr<std::atomic<int>> readers_;
};

/// The setup of the machine as it is stored; the control's defaults without a machine or a setup.
/// Errors: those of the stored setup for this control.
Result<interpreter::Setup> interpretation_setup(const machines::RunSources& sources,
                                                const std::string& machine,
                                                const interpreter::Dialect& dialect);

/// The run that the revision would be, for the programs it calls.
storage::Run interpreted_run(const machines::RunSources& sources, const storage::Revision& revision,
                             const std::string& machine);

/// Blocks that are interpreted between two looks at the time or at what was made.
inline constexpr std::uint64_t kStepBlocks = 2048;

/// By axis letter: the smallest and the largest coordinate, mm or degrees.
nlohmann::json extents_json(const interpreter::Summary& summary);

}  // namespace dripline::paths
