#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline::storage {

/// How far a reader has got in a journal of a machine.
struct RecordCursor {
  std::string machine;
  std::uint64_t epoch = 0;
  std::uint64_t number = 0;  ///< up to it the reader has all
};

/// A journal of which a reader does not have all.
struct UnreadRecords {
  RecordCursor cursor;
  std::uint64_t last = 0;  ///< stored
};

/// Readers of the records of all machines, each with its cursors. Promises of every store:
/// storage/store.hpp.
class RecordReaderStore {
 public:
  virtual ~RecordReaderStore() = default;

  /// A new reader begins after what is stored now; one that is known continues.
  virtual Result<void> begin(const std::string& reader, UtcTime now) = 0;
  /// By machine; of each the journal that still grows comes last. Nothing of a reader that has not
  /// begun.
  virtual Result<std::vector<UnreadRecords>> unread(const std::string& reader) = 0;
  /// Cursors only move forward. Survives a kill of the process; a power cut may take the last ones,
  /// and what they had passed is unread again. Errors: NotFound (reader, machine).
  virtual Result<void> advance(const std::string& reader,
                               const std::vector<RecordCursor>& cursors) = 0;
};

}  // namespace dripline::storage
