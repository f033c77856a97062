#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "server/machines/machine_control.hpp"
#include "storage/store.hpp"

/// The JSON of the API's answers. Pure; absent values are null, times ISO 8601 UTC.
namespace dripline::api {

nlohmann::json upload_json(const storage::Upload& upload, std::uint64_t max_piece);
/// `title`: the name in the program's first block (library::program_title).
nlohmann::json revision_json(const storage::Revision& revision, const std::string& title);
/// Of a program.
nlohmann::json fields_json(const storage::ProgramFields& fields);
nlohmann::json program_json(const storage::ProgramSummary& program, const std::string& title);
/// JSON in one line. Written with every status, so no tree is made of it.
std::string machine_text(const machines::MachineView& view);
nlohmann::json machine_json(const machines::MachineView& view);  ///< the same, read
/// null: it is not held.
nlohmann::json hold_json(const std::optional<storage::MachineHold>& hold);
nlohmann::json hold_json(const std::optional<storage::JobHold>& hold);
nlohmann::json run_json(const storage::Run& run);
/// With what its gateway says of its beginning; empty: nothing.
nlohmann::json begun_json(const storage::Run& run, std::string_view notice);
/// Without the text.
nlohmann::json setup_json(const storage::SetupRevision& setup);
nlohmann::json loaded_setup_json(const storage::LoadedSetup& loaded);
nlohmann::json record_json(const storage::Record& record);
nlohmann::json report_json(const storage::Run& run);
nlohmann::json audit_json(const storage::AuditEntry& entry);

}  // namespace dripline::api
