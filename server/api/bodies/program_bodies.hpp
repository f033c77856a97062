#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/digest.hpp"
#include "server/library/attachments.hpp"
#include "server/library/program_closure.hpp"
#include "server/library/programs.hpp"

/// The JSON bodies of requests about programs, decoded and checked. Pure. Errors: Syntax,
/// LimitExceeded; each names the member.
namespace dripline::api {

Result<library::UploadRequest> decode_upload(std::string_view body);

/// `{part?, operation?, material?, machine_group?, cam_file?, revision?}`; the program and who are
/// left empty.
Result<storage::Description> decode_description(std::string_view body);
/// `{name, revision?, comment?}`; the program is left empty.
Result<library::Attachments::Request> decode_attachment(std::string_view body);

struct CommitBody {
  std::optional<Digest> sha256;
  bool force = false;  ///< also replaces a protected program
};
/// An empty body is an empty object: all members are optional.
Result<CommitBody> decode_commit(std::string_view body);

struct CopyBody {
  std::string to;
  std::optional<std::uint64_t> revision;
};
Result<CopyBody> decode_copy(std::string_view body);
/// `{comment?}`, or nothing.
Result<std::string> decode_decision(std::string_view body);
struct ReleaseBody {
  std::string comment;
  bool has_closure = false;  ///< what the program calls is pinned, and released with it
  std::string machine;       ///< its newest setup binds codes to programs
  std::vector<library::ClosureRequest::Named> named;
};
/// `{comment?, closure?, machine?, with?}`, or nothing; the last two only with `closure`.
Result<ReleaseBody> decode_release(std::string_view body);
/// "NAME" or "NAME@REVISION".
Result<library::ClosureRequest::Named> parse_named_program(const std::string& text);
struct AcceptanceBody {
  std::string target;  ///< empty: as what it came
  std::string reason;
};
/// `{as?, comment?}`, or nothing.
Result<AcceptanceBody> decode_acceptance(std::string_view body);
/// `{reason}`.
Result<std::string> decode_rejection(std::string_view body);
/// The new name.
Result<std::string> decode_rename(std::string_view body);

}  // namespace dripline::api
