#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "storage/store.hpp"

namespace dripline::library {

/// A file name for every system: 1 to 200 bytes of UTF-8 without control characters, slashes and
/// what Windows refuses (`\ : * ? " < > |`), not beginning with a dot, a blank or a dash, not
/// ending with a dot or a blank, and none of its devices (CON, LPT1.txt ...). Errors: Syntax,
/// LimitExceeded.
Result<void> check_attachment_name(std::string_view name);

/// The value of a Content-Disposition header that has a browser save the file, never show it (RFC
/// 6266, RFC 8187).
std::string content_disposition(std::string_view name);

/// Files beside programs: setup sheets, drawings ... Their bytes come as those of programs do, in
/// pieces (`begin`, Programs::append, `commit`), and may be any. Any thread.
class Attachments {
 public:
  explicit Attachments(const storage::Store& store)
      : store_(store.attachments), uploads_(store.uploads) {}

  struct Request {
    storage::AttachmentName name;
    std::string comment;
  };
  /// Errors: those of check_attachment_name, NotFound (program, revision), LimitExceeded (comment).
  Result<storage::Upload> begin(const Request& request, const storage::Actor& who);
  /// Promises of all: storage::AttachmentStore.
  Result<storage::Attachment> commit(const std::string& upload,
                                     const std::optional<Digest>& expected,
                                     const storage::Actor& who);
  Result<std::vector<storage::Attachment>> list(const std::string& program,
                                                std::optional<std::uint64_t> revision) {
    return store_.list(program, revision);
  }
  Result<storage::Attachment> find(const storage::AttachmentName& name) {
    return store_.find(name);
  }
  Result<void> remove(const storage::AttachmentName& name, const storage::Actor& who);

  static constexpr std::size_t kMaxName = 200;  ///< bytes

 private:
  storage::AttachmentStore& store_;
  storage::UploadStore& uploads_;
};

}  // namespace dripline::library
