#pragma once

#include "storage/impl/connections.hpp"
#include "storage/impl/programs/upload_repository.hpp"
#include "storage/programs/attachment_store.hpp"

namespace dripline::storage {

class AttachmentRepository final : public AttachmentStore {
 public:
  AttachmentRepository(Connections& connections, UploadRepository& uploads, const Clock& clock)
      : connections_(connections), uploads_(uploads), clock_(clock) {}

  Result<std::vector<Attachment>> list(const std::string& program,
                                       std::optional<std::uint64_t> revision) override;
  Result<Attachment> find(const AttachmentName& name) override;
  Result<Attachment> commit(const std::string& upload, const std::optional<Digest>& expected,
                            const Actor& who) override {
    return uploads_.commit_attachment(upload, expected, who);
  }
  Result<void> remove(const AttachmentName& name, const Actor& who) override;

 private:
  Connections& connections_;
  UploadRepository& uploads_;
  const Clock& clock_;
};

}  // namespace dripline::storage
