#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/digest.hpp"
#include "server/library/attachments.hpp"
#include "server/library/job_queue.hpp"
#include "server/library/program_closure.hpp"
#include "server/library/programs.hpp"
#include "server/machines/machine_control.hpp"
#include "server/ports/port_control.hpp"

/// The JSON bodies of requests, decoded and checked. Pure. Errors: Syntax, LimitExceeded,
/// Unsupported (an unknown action); each names the member. PortControl checks the values of a
/// port's settings.
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

/// The author is left empty.
Result<machines::StartRequest> decode_start(std::string_view body);
struct JobBody {
  storage::Job job;  ///< its machine is left empty
  std::optional<std::uint64_t> place;
};
/// `{program, revision?, quantity?, parts_per_run?, comment?, place?}`.
Result<JobBody> decode_job(std::string_view body);
/// `{place}`.
Result<std::uint64_t> decode_job_move(std::string_view body);
/// `{job?}`, or nothing.
Result<std::optional<std::uint64_t>> decode_job_start(std::string_view body);

struct WebhookBody {
  std::string name, url;
  std::vector<std::string> kinds;
};
/// `{name, url, kinds?}`.
Result<WebhookBody> decode_webhook(std::string_view body);

/// Where a run is to continue: {"at"?}.
Result<std::string> decode_restart(std::string_view body);

/// The run is left empty. An override is 0 to kMaxOverride, 1 is 100 %.
Result<machines::CommandRequest> decode_command(std::string_view body);
/// The same for a machine's panel: switches and overrides. Unsupported: an action of a run.
Result<machines::CommandRequest> decode_machine_command(std::string_view body);
inline constexpr double kMaxOverride = 10;
inline constexpr double kMaxClicks = 1000;  ///< of a handwheel, in one command

/// `{machine, address, template?, settings?: {key: text, number or boolean}, rules?, enabled?}`.
/// `line` is the first of the settings, so that `baud` and the like override it.
Result<storage::Port> decode_port(const std::string& name, std::string_view body);

/// `{programs: [NAME or NAME@REVISION]}`.
Result<std::vector<ports::ProgramChoice>> decode_transfer(std::string_view body);

/// `{text}`: a control's text as it would be stored.
Result<std::string> decode_rules_text(std::string_view body);

inline constexpr std::size_t kMaxAddress = 255;
inline constexpr std::size_t kMaxSettingValue = 64;
inline constexpr std::size_t kMaxRulesText = 48 * 1024;

}  // namespace dripline::api
