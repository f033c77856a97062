#pragma once

#include <functional>
#include <optional>
#include <type_traits>

#include "storage/sql/database.hpp"

namespace dripline::storage {

/// What a commit promises: Full survives a power cut; Normal a kill of the process, but a power cut
/// may take the last commits.
enum class Durability : std::uint8_t { Normal, Full };

/// How the repositories come to a connection; each engine has its own. Thread-safe.
class Connections {
 public:
  virtual ~Connections() = default;

  /// Asks no database. Errors: Io (what it is opened for is another's now, as far as is known).
  virtual Result<void> check_place() const { return {}; }

  /// `action(database)` in one transaction, committed when it succeeds, undone when it fails. One
  /// writes at a time. The action may be called again from its beginning, when the engine undid
  /// what it did: it changes nothing outside the database but what its own beginning sets.
  template <class Action>
  auto write(Action action, Durability durability = Durability::Full)
      -> std::invoke_result_t<Action, sql::Database&> {
    return outcome_of(action, [&](const Work& work) { return write_with(work, durability); });
  }

  /// `action(database)` on one consistent picture of the database. It may be called again, too.
  template <class Action>
  auto read(Action action) -> std::invoke_result_t<Action, sql::Database&> {
    return outcome_of(action, [&](const Work& work) { return read_with(work); });
  }

 protected:
  using Work = std::function<Result<void>(sql::Database&)>;

 private:
  virtual Result<void> write_with(const Work& work, Durability durability) = 0;
  virtual Result<void> read_with(const Work& work) = 0;

  template <class Action, class Run>
  static auto outcome_of(Action& action, Run run) -> std::invoke_result_t<Action, sql::Database&> {
    std::optional<std::invoke_result_t<Action, sql::Database&>> outcome;
    const Result<void> done = run([&](sql::Database& database) -> Result<void> {
      outcome.emplace(action(database));
      if (!*outcome) return fail(outcome->error());
      return {};
    });
    if (!done) return fail(done.error());
    return *std::move(outcome);
  }
};

}  // namespace dripline::storage
