#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"
#include "storage/actor.hpp"
#include "storage/page.hpp"

namespace dripline::storage {

/// What a machine's control knows before a program starts: tools, offsets, variables, parameters.
struct SetupRevision {
  std::string machine;
  std::uint64_t number = 0;  ///< 1, 2, 3 ... per machine
  std::string text;          ///< TOML
  Digest sha256;             ///< of the text
  std::uint64_t size = 0;    ///< of the text, bytes
  std::string comment, author;
  UtcTime created;
};
inline constexpr std::size_t kMaxSetup = 64 * 1024;

/// Which setup is in a control that gets none with a start, by the word of who loaded it there.
struct LoadedSetup {
  std::string machine;
  std::optional<std::uint64_t> number;  ///< nothing: not known
  std::string who;
  UtcTime time;
};

/// The setups of machines, every version of them. Promises of every store: storage/store.hpp.
class SetupStore {
 public:
  virtual ~SetupStore() = default;

  /// Makes `text` the machine's newest setup, or returns the newest when it has that text already.
  /// `number`, `sha256`, `size` and `created` are the store's own. `base`: the number that must
  /// still be the newest for a new text to be kept, 0 for none at all. Errors: Syntax and
  /// LimitExceeded (the machine's name, kMaxSetup), Conflict (another is the newest by now).
  virtual Result<SetupRevision> save(const SetupRevision& setup,
                                     std::optional<std::uint64_t> base) = 0;
  /// Newest first, without their texts.
  virtual Result<std::vector<SetupRevision>> list(const std::string& machine, Page page) = 0;
  /// The newest, or the one with that number. Errors: NotFound.
  virtual Result<SetupRevision> find(const std::string& machine,
                                     std::optional<std::uint64_t> number) = 0;

  /// From now on this one is in the control; in force for runs that are created later, and in the
  /// audit trail (setup.loaded). `number` nothing: it is not known. Errors: Syntax (the machine's
  /// name), NotFound (no such setup, or none at all).
  virtual Result<LoadedSetup> note_loaded(const std::string& machine,
                                          std::optional<std::uint64_t> number,
                                          const Actor& who) = 0;
  /// Nothing: it was never stated.
  virtual Result<std::optional<LoadedSetup>> loaded(const std::string& machine) = 0;
};

}  // namespace dripline::storage
