#pragma once

#include "storage/impl/connections.hpp"
#include "storage/record_reader_store.hpp"

namespace dripline::storage {

class RecordReaderRepository final : public RecordReaderStore {
 public:
  explicit RecordReaderRepository(Connections& connections) : connections_(connections) {}

  Result<void> begin(const std::string& reader, UtcTime now) override;
  Result<std::vector<UnreadRecords>> unread(const std::string& reader) override;
  Result<void> advance(const std::string& reader,
                       const std::vector<RecordCursor>& cursors) override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
