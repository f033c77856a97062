#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "storage/migration/target_state.hpp"
#include "storage/postgresql_store.hpp"

/// The two databases of a migration, whichever engine each is. Both are this process's alone while
/// the object lives.
namespace dripline::migration {

class Source {
 public:
  virtual ~Source() = default;
  virtual Connections& connections() = 0;
  virtual const std::string& label() const = 0;
  /// Above that of every server that has used it; 0: its servers had none.
  virtual std::uint64_t term() const { return 0; }
  /// No server uses it: a migration had verified all of it.
  virtual bool is_left() const = 0;
  /// From now on no server does. `target`: for people.
  virtual Result<void> leave(const std::string& target) = 0;
};

class Target {
 public:
  virtual ~Target() = default;
  virtual Connections& connections() = 0;
  virtual const std::string& label() const = 0;
  virtual sql::Engine engine() const = 0;
  /// Everything is there, and only the last step is missing.
  virtual bool is_complete() const = 0;
  /// From now on a server may use it. The object is of no use afterwards.
  virtual Result<void> activate(const Layout& layout) = 0;
};

/// Errors of all: NotFound (nothing to migrate), Busy (a server uses it), and those of the stores.
Result<std::unique_ptr<Source>> leave_sqlite(const std::filesystem::path& file);
Result<std::unique_ptr<Source>> leave_postgresql(const storage::PostgresqlStoreOptions& options);

/// `source`: its identity. `may_begin`: false where only a migration that was begun is continued,
/// and nothing is made otherwise. Errors: also Conflict (it holds something, or another source's
/// begun migration), and NotFound (none was begun, and none may be).
Result<std::unique_ptr<Target>> enter_sqlite(const std::filesystem::path& file,
                                             const Layout& layout, const std::string& source,
                                             bool may_begin);
Result<std::unique_ptr<Target>> enter_postgresql(const storage::PostgresqlStoreOptions& options,
                                                 const Layout& layout, const std::string& source,
                                                 bool may_begin);

}  // namespace dripline::migration
