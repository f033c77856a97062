#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "gateway/interpreter/core/jog_move.hpp"
#include "gateway/interpreter/core/position_setting.hpp"
#include "server/machines/machine_control.hpp"
#include "storage/job_store.hpp"

/// The JSON bodies of starts, commands and jobs, decoded and checked. Pure. Errors: Syntax,
/// LimitExceeded, Unsupported (an unknown action); each names the member.
namespace dripline::api {

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

/// Where a run is to continue: {"at"?}.
Result<std::string> decode_restart(std::string_view body);

/// Which setup is in a control: {"revision"?}; nothing: it is not known.
Result<std::optional<std::uint64_t>> decode_loaded_setup(std::string_view body);

/// The run is left empty. An override is 0 to kMaxOverride, 1 is 100 %.
Result<machines::CommandRequest> decode_command(std::string_view body);
/// The text that is keyed in: its lines, each with its end. Errors: Syntax (none, a control
/// character), LimitExceeded (its length).
Result<std::string> decode_mdi(std::string_view body);
/// For a machine's panel: switches and overrides, and the end of a jog. Unsupported: an action of a
/// run.
Result<machines::CommandRequest> decode_machine_command(std::string_view body);
/// {"axis", "value", "unit"?, "offset"?} of a datum; of a touch-off also "tool". A value of a
/// linear axis other than 0 needs its unit, mm or in; that of a rotary one is in degrees.
Result<interpreter::PositionSetting> decode_position_setting(std::string_view body, bool is_tool);
/// {"axis", "distance", "unit", "feed"?}; the unit of a rotary axis may be left out: deg.
Result<interpreter::JogMove> decode_jog(std::string_view body);
/// The word by which a jog is held.
Result<std::string> decode_jog_keep(std::string_view body);
inline constexpr double kMaxOverride = 10;
inline constexpr double kMaxClicks = 1000;  ///< of a handwheel, in one command

}  // namespace dripline::api
