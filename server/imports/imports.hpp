#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "server/library/release_policy.hpp"
#include "server/paths/program_paths.hpp"
#include "storage/store.hpp"

namespace dripline::imports {

/// A revision from a machine beside what it would replace.
struct ComparedImport {
  storage::Import import;
  std::optional<storage::Revision> base;  ///< absent: there is none
  std::string comparison;                 ///< JSON of ProgramPaths::compare; empty: none
  bool by_motion = false;
  std::string fault;  ///< why there is no comparison, or none by motion
};

/// The import queue. Any thread; all of it must outlive the object.
class Imports {
 public:
  struct Parts {
    const storage::Store& store;
    paths::ProgramPaths& paths;
    const library::ReleasePolicy& policy;
    const Clock& clock;
    /// What came, was compared, or was decided. On any thread; must return soon.
    std::function<void(const storage::Import&)> on_change = {};
    /// What was kept from being compared is tried again after this.
    std::chrono::milliseconds retry = std::chrono::seconds(15);
  };
  explicit Imports(Parts parts) : parts_(std::move(parts)) {}
  ~Imports();
  Imports(const Imports&) = delete;
  Imports& operator=(const Imports&) = delete;

  /// Begins to compare: what waits since the last time, and what comes.
  void begin();
  /// A machine sent a revision. Never waits.
  void note(const storage::Revision& revision);

  Result<std::vector<storage::Import>> list(bool is_pending, storage::Page page) {
    return parts_.store.imports.list(is_pending, page);
  }
  Result<std::uint64_t> count_pending() { return parts_.store.imports.count_pending(); }
  /// With the comparison made now: of a pending one with the revision that it would replace, of an
  /// accepted one with the revision that it was compared with when it came. By text where motion
  /// cannot be compared. Waits, at most some 40 s. Errors: NotFound, those of the store.
  Result<ComparedImport> show(const std::string& program, std::uint64_t revision);
  /// Accepts, accepts as another program, or rejects. Returns what is in force now. Errors: those
  /// of ImportStore::decide, Syntax (a rejection without a reason), LimitExceeded (its length).
  Result<storage::Revision> decide(storage::ImportDecision decision);

  /// To `on_change`; nothing when it did not come from a machine.
  void publish(const std::string& program, std::uint64_t revision);

  static constexpr std::size_t kMaxReason = 1024;

 private:
  struct Compared {
    std::string text;  ///< JSON
    bool by_motion = false;
    std::string fault;
  };
  Result<std::optional<storage::Revision>> base_of(const std::string& program,
                                                   std::uint64_t number);
  Result<std::string> compare(const storage::Import& import, const storage::Revision& base,
                              paths::CompareBy by, const std::stop_token& stop);
  void work(const std::stop_token& stop);
  /// False: it is to be tried again.
  bool look_at(const storage::Import& import, const std::stop_token& stop);
  bool judge(const storage::Import& import, const storage::Revision& base, const std::string& text);
  bool keep(const storage::Import& import, storage::ImportClass found);

  Parts parts_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool is_woken_ = true;
  std::jthread worker_;  // last: it uses the others
};

}  // namespace dripline::imports
