#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "server/library/audit_trail.hpp"

namespace dripline::identity {

/// Notes what was refused in the log and the audit trail. The first refusal of a kind is written
/// at once; those that follow within `interval` become one entry with their number, so that neither
/// a stranger nor a script in a loop fills the disk. Any thread; never waits for storage.
class RefusalLog {
 public:
  struct Options {
    std::chrono::seconds interval{60};
    std::size_t kinds = 256;  ///< distinguished within an interval; the rest are counted together
  };
  struct Refusal {
    storage::Actor who;
    std::string action;   ///< access.refused, sign-in.refused
    std::string subject;  ///< the route, or the user
    std::string detail;
  };

  RefusalLog(library::AuditTrail& audit, const Options& options);
  RefusalLog(const RefusalLog&) = delete;
  RefusalLog& operator=(const RefusalLog&) = delete;
  /// Writes what was counted.
  ~RefusalLog();

  void note(Refusal refusal);
  /// Waits until what was noted so far is written, counted ones included.
  void flush();

 private:
  using Kind = std::tuple<std::string, std::string, std::string, std::string>;
  struct Counted {
    Refusal refusal;
    std::uint64_t more = 0;
  };
  void write(const std::stop_token& stop);
  void take_counted();

  library::AuditTrail& audit_;
  const Options options_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::condition_variable written_;
  std::map<Kind, Counted> kinds_;
  std::vector<Refusal> ready_;
  bool is_flushing_ = false, is_writing_ = false;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace dripline::identity
